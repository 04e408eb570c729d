// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The messages about observations that cannot be understood, and which
// quantities checks ask for.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/output/observations.h>

#include <cstdio>

using namespace CaissonMPM;

/** Set the entry of section Verification, and print the beginning of what the
 * program has to say. */
void
refuse(const std::string &entry, const std::string &text)
{
  // not while objects that registered themselves are alive
  dealii::ParameterAcceptor::clear();
  Observations observations;
  auto        &prm = dealii::ParameterAcceptor::prm;
  prm.enter_subsection("Verification");
  prm.set(entry, text);
  prm.leave_subsection();
  dealii::ParameterAcceptor::parse_all_parameters(prm);
  try
    {
      observations.initialize({"step"});
      std::printf("accepted: %s\n", text.c_str());
      for (const std::string &name : observations.checked_quantities())
        std::printf("  of points: %s\n", name.c_str());
    }
  catch (const BadInput &error)
    {
      std::string what = error.what();
      what.resize(std::min(what.find('\n'), what.size()));
      if (what.size() > 160)
        what = what.substr(0, 120) + " ...";
      std::printf("%s\n", what.c_str());
    }
}

int
main(int, char **)
{
  for (const char *text :
       {"max sped : 0 : 1",
        "max : 0 : 1",
        "final force : 0 : 1; drift step : 0.1",
        "max speed where r > 1 : r > 2 ? 1 : 2 : 0.1; spread density : 0.1; "
        "rms speed : 0 : 1"})
    refuse("Checks", text);
  for (const char *text : {"mean speed",
                           "a = mean speed; a = max speed",
                           "step = mean speed",
                           "2a = mean speed",
                           "a = quantil 0.5 speed",
                           "a = mean sped",
                           "a = quantile 99 speed",
                           "a = point speed",
                           "a = point speed at 1",
                           "a = mean speed at 1 1",
                           "a = projection speed",
                           "a = mean speed over r",
                           "a = projection speed on sin(r) where z < -1 | r == "
                           "2; b = quantile 0.1 deviator; c = point density at "
                           "0 -1"})
    refuse("Observations", text);
  return 0;
}
