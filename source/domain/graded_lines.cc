// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/graded_lines.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    constexpr unsigned int n_samples = 4000;

    /** The integral of 1 / size from a to sample i, by the rule of midpoints.
     * [n_samples + 1] */
    std::vector<double>
    integral(const double                         a,
             const double                         b,
             const std::function<double(double)> &size)
    {
      const double        dx = (b - a) / n_samples;
      std::vector<double> count(n_samples + 1, 0.);
      for (unsigned int i = 0; i < n_samples; ++i)
        count[i + 1] = count[i] + dx / size(a + (i + .5) * dx);
      return count;
    }

    double
    rounded_up(const double count)
    {
      return std::max(1., std::ceil(count - 1e-6));
    }

    /** Add the lines within (a, b]; a is there already. */
    void
    add_segment(const double                         a,
                const double                         b,
                const std::function<double(double)> &size,
                std::vector<double>                 &lines)
    {
      const double       dx      = (b - a) / n_samples;
      const auto         count   = integral(a, b, size);
      const unsigned int n_cells = rounded_up(count.back());
      for (unsigned int k = 1; k < n_cells; ++k)
        {
          const double       wanted = count.back() * k / n_cells;
          const unsigned int i =
            std::upper_bound(count.begin(), count.end(), wanted) -
            count.begin() - 1;
          lines.push_back(
            a + dx * (i + (wanted - count[i]) / (count[i + 1] - count[i])));
        }
      lines.push_back(b);
    }

    // fixed lines closer than this are one
    constexpr double round_off = 1e-9;
  } // namespace

  double
  number_of_cells(const double                         a,
                  const double                         b,
                  const std::function<double(double)> &size)
  {
    return b > a + round_off ? rounded_up(integral(a, b, size).back()) : 0.;
  }

  std::vector<double>
  graded_lines(std::vector<double>                  fixed,
               const std::function<double(double)> &size)
  {
    std::sort(fixed.begin(), fixed.end());
    std::vector<double> lines = {fixed.front()};
    for (const double x : fixed)
      if (x > lines.back() + round_off)
        add_segment(lines.back(), x, size, lines);
    return lines;
  }
} // namespace CaissonMPM
