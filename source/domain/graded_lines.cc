// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/graded_lines.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  namespace
  {
    /** The lines within (a, b], where a is there already. */
    void
    add_segment(const double                         a,
                const double                         b,
                const std::function<double(double)> &size,
                std::vector<double>                 &lines)
    {
      constexpr unsigned int n_samples = 4000;
      const double           dx        = (b - a) / n_samples;
      std::vector<double>    count(n_samples + 1, 0.);
      for (unsigned int i = 0; i < n_samples; ++i)
        count[i + 1] = count[i] + dx / size(a + (i + .5) * dx);
      const unsigned int n_cells = std::max(1., std::ceil(count.back() - 1e-6));
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
  } // namespace

  std::vector<double>
  graded_lines(std::vector<double>                  fixed,
               const std::function<double(double)> &size)
  {
    std::sort(fixed.begin(), fixed.end());
    std::vector<double> lines = {fixed.front()};
    for (const double x : fixed)
      if (x > lines.back() + 1e-9)
        add_segment(lines.back(), x, size, lines);
    return lines;
  }
} // namespace CaissonMPM
