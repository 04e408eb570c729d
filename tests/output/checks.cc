// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The errors of output/comparisons.h on numbers that can be worked out by hand,
// and the messages about what cannot be understood.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/checks/comparisons.h>
#include <caisson_mpm/checks/verification.h>

#include <cmath>
#include <cstdio>

using namespace CaissonMPM;

void
show(const std::string &mode, const Comparison &c)
{
  std::printf("%s: computed %.6f, exact %.6f, error %.6f\n",
              mode.c_str(),
              c.computed,
              c.exact,
              c.error);
}

/** Two points; that of volume 3 is wrong by 1, the other by -0.2. */
void
compare_points()
{
  const Samples samples = {{5., 0.8}, {4., 1.}, {3., 1.}, {}};
  for (const auto &[name, mode] : check_modes())
    if (mode.of_points)
      show(name, mode.compare(samples));
  std::printf("where the exact value is 0\n");
  const Samples zero = {{.5, -.25}, {0., 0.}, {1., 1.}, {}};
  for (const auto &[name, mode] : check_modes())
    if (mode.of_points)
      show(name, mode.compare(zero));
  std::printf("not a number\n");
  const Samples none = {{std::nan(""), 1.}, {1., 1.}, {1., 1.}, {}};
  for (const auto &[name, mode] : check_modes())
    if (mode.of_points)
      std::printf("%s passes: %s\n",
                  name.c_str(),
                  mode.compare(none).error <= 1e9 ? "yes" : "no");
}

void
compare_series()
{
  const Samples samples = {{1., 2.5, 4.}, {1., 2., 5.}, {}, {1., 2., 6.}};
  for (const char *name :
       {"trace", "final", "average", "drift", "below", "above", "between"})
    show(name, check_modes().at(name).compare(samples));
  std::printf("within the bounds\n");
  const Samples inside = {{5.5}, {5.}, {}, {6.}};
  for (const char *name : {"above", "between"})
    show(name, check_modes().at(name).compare(inside));
  const Samples less = {{4.5}, {5.}, {}, {6.}};
  show("below", check_modes().at("below").compare(less));
}

/** Set the entry of section Verification, and print the beginning of what the
 * program has to say. */
void
refuse(const std::string &entry, const std::string &text)
{
  // not while objects that registered themselves are alive
  dealii::ParameterAcceptor::clear();
  Observations observations;
  Verification verification;
  auto        &prm = dealii::ParameterAcceptor::prm;
  prm.enter_subsection("Verification");
  prm.set(entry, text);
  prm.leave_subsection();
  dealii::ParameterAcceptor::parse_all_parameters(prm);
  try
    {
      observations.initialize(Records::names({}, {}, {}));
      verification.check_parameters(
        Records::names({}, {}, observations.names()));
      std::printf("accepted: %s\n", text.c_str());
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
  for (const char *text : {"maxx speed : 0 : 1",
                           "max sped : 0 : 1",
                           "final force : 0 : 1",
                           "max speed",
                           "max : 0 : 1",
                           "max speed : 0",
                           "between step : 0",
                           "max speed : 0 : 0",
                           "max speed : 0 : x",
                           "max speed in r > 1 : 1 : 1",
                           "final step where r > 1 : 1 : 1",
                           "final step from x : 1 : 1",
                           "max speed where r > 1 : r > 2 ? 1 : 2 : 0.1",
                           "average step from 1 to 2 : t : 0.1",
                           "drift step : 0.1; spread density : 0.1; below step "
                           ": 3; between step : 1 : 2"})
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
  std::printf("points\n");
  compare_points();
  std::printf("series\n");
  compare_series();
  return 0;
}
