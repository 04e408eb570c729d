// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/output/check_text.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace CaissonMPM
{
  double
  parse_number(const std::string &text,
               const std::string &place,
               const std::string &what)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      throw BadInput(place + "the " + what + " \"" + text +
                     "\" must be a number.");
    return value;
  }

  void
  check_known(const std::string              &name,
              const std::vector<std::string> &known,
              const std::string              &place,
              const std::string              &kind)
  {
    if (std::find(known.begin(), known.end(), name) != known.end())
      return;
    throw BadInput(place + "there is no " + kind + " \"" + name + "\", only " +
                   boost::algorithm::join(known, ", ") + "." +
                   did_you_mean(nearest_names(name, known)));
  }
} // namespace CaissonMPM
