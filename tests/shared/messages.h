// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the tests of the base floor print: titles, and the messages of errors.
#ifndef caisson_mpm_tests_messages_h
#define caisson_mpm_tests_messages_h

#include <caisson_mpm/base/exceptions.h>

#include <deal.II/base/utilities.h>

#include <functional>
#include <iostream>
#include <string>

inline void
title(const std::string &text)
{
  std::cout << "\n=== " << text << '\n';
}



/** Print what is tried, and the message with which it is refused. */
inline void
print_error(const std::string &what, const std::function<void()> &action)
{
  std::cout << "--- " << dealii::Utilities::trim(what) << '\n';
  try
    {
      action();
      std::cout << "accepted\n";
    }
  catch (const CaissonMPM::BadInput &error)
    {
      std::cout << error.what() << '\n';
    }
}

#endif
