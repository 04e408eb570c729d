// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The errors that a check can ask for.
//
// With the computed values v and the exact ones e at all points:
//   max:       max |v - e| / max |e|,
//   pointwise: max (|v - e| / |e|),
//   mean:      |<v> - <e>| / |<e>|,  <.> the mean weighted with the volume,
//   rms:       sqrt(<(v - e)^2>) / max |e|,
//   spread:    (max v - min v) / |<v>|.
// With the computed series v and the exact one e at all records:
//   trace:     max |v - e| / max |e|,
//   final:     |v - e| / |e| at the last record,
//   average:   |<v> - <e>| / |<e>|,  <.> the mean over the records,
//   drift:     max |v - v(first)| / max |v|,
//   below, above, between: by how much the last v is outside its bounds.
// Where the number that would be divided by is 0 the error is absolute.
#ifndef caisson_mpm_checks_comparisons_h
#define caisson_mpm_checks_comparisons_h

#include <map>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The two values that are compared, and their relative difference. */
  struct Comparison
  {
    double computed = 0.;
    double exact    = 0.;
    double error    = 0.;
  };

  /** The values at all points, with their volumes, or at all records. For
   * between, exact and upper are the bounds. */
  struct Samples
  {
    std::vector<double> computed, exact, volume, upper;
  };

  /** What a check with this mode says behind its first colon. */
  enum class CheckForm
  {
    exact,     // an exact solution, and a tolerance
    tolerance, // a tolerance alone
    bound,     // the lower or the upper bound
    bounds     // the lower and the upper bound
  };

  /** A way to compare points or records. */
  struct CheckMode
  {
    Comparison (*compare)(const Samples &);
    CheckForm   form;
    bool        of_points;
    const char *scale = "the exact value"; // that the error is divided by
  };

  /** All of them by name. */
  const std::map<std::string, CheckMode> &
  check_modes();
} // namespace CaissonMPM

#endif
