// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The exceptions that reach the user, and the exit statuses of the program.
#ifndef caisson_mpm_base_exceptions_h
#define caisson_mpm_base_exceptions_h

#include <stdexcept>
#include <string>

namespace CaissonMPM
{
  /** The exit status of the program; scripts rely on the numbers. */
  enum class ExitStatus : int
  {
    success   = 0,
    bad_input = 1,
    failure   = 2,
    stopped   = 3
  };

  /**
   * The user's input cannot be used. The text says what is wrong, the value
   * found and what to do. It names entries by their paths: the program adds
   * where they were set (ParameterOrigins).
   */
  class BadInput : public std::runtime_error
  {
  public:
    explicit BadInput(const std::string &what)
      : std::runtime_error(what)
    {}
  };

  /**
   * The run cannot go on: a state that is not finite, a material point that
   * left the mesh, a file that cannot be written. The text names the first
   * offender and the likely cause.
   */
  class RunFailure : public std::runtime_error
  {
  public:
    explicit RunFailure(const std::string &what)
      : std::runtime_error(what)
    {}
  };
} // namespace CaissonMPM

#endif
