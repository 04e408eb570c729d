// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/checks/damped_wave.h>

#include <deal.II/base/tensor.h>

#include <cmath>
#include <limits>

namespace CaissonMPM
{
  namespace
  {
    using Vector3 = dealii::Tensor<1, 3>;

    /** 1, exp(-g t) cos(w t), exp(-g t) sin(w t). */
    Vector3
    basis(const DampedWave &wave, const double t)
    {
      const double decay = std::exp(-wave.damping * t);
      return Vector3({1.,
                      decay * std::cos(wave.frequency * t),
                      decay * std::sin(wave.frequency * t)});
    }

    /** The sum of squares that is left with the best c, a and b. */
    double
    misfit(const DampedWave &wave, const Series &s)
    {
      dealii::Tensor<2, 3> matrix;
      Vector3              right;
      for (std::size_t k = 0; k < s.time.size(); ++k)
        {
          const Vector3 f = basis(wave, s.time[k] - s.time[0]);
          right += s.value[k] * f;
          matrix += outer_product(f, f);
        }
      const Vector3 x   = invert(matrix) * right;
      double        sum = 0.;
      for (std::size_t k = 0; k < s.time.size(); ++k)
        sum += std::pow(s.value[k] - x * basis(wave, s.time[k] - s.time[0]), 2);
      return sum;
    }

    /** Return the number of times that the series crosses its mean. */
    unsigned int
    n_crossings(const Series &s)
    {
      double mean = 0.;
      for (const double value : s.value)
        mean += value / s.value.size();
      unsigned int n = 0;
      for (std::size_t k = 1; k < s.value.size(); ++k)
        n += (s.value[k] > mean) != (s.value[k - 1] > mean);
      return n;
    }

    /** Without damping, the best of frequencies about that of the crossings. */
    DampedWave
    first_guess(const Series &s, const unsigned int crossings)
    {
      const double length = s.time.back() - s.time.front();
      const double about  = pi * crossings / length;
      DampedWave   best   = {about, 0.};
      double       least  = std::numeric_limits<double>::infinity();
      for (double w = .3 * about; w < 1.5 * about; w += pi / (8. * length))
        if (const double m = misfit({w, 0.}, s); m < least)
          {
            least = m;
            best  = {w, 0.};
          }
      return best;
    }
  } // namespace

  double
  DampedWave::left_after_two_periods() const
  {
    return std::exp(-damping * 4. * pi / frequency);
  }

  DampedWave
  fit_damped_wave(const Series &series)
  {
    const unsigned int crossings = n_crossings(series);
    if (series.time.size() < 8 || crossings < 2)
      return {std::nan(""), std::nan("")};
    DampedWave best  = first_guess(series, crossings);
    double     least = misfit(best, series);
    // a search by pattern: w and g up and down by a step that is halved where
    // none of the four is better
    const double length = series.time.back() - series.time.front();
    for (double step = .1 / length; step > 1e-9 * best.frequency;)
      {
        const DampedWave around = best;
        for (const double sign : {-1., 1.})
          for (const DampedWave &next :
               {DampedWave{around.frequency + sign * step, around.damping},
                DampedWave{around.frequency, around.damping + sign * step}})
            if (const double m = misfit(next, series); m < least)
              {
                least = m;
                best  = next;
              }
        if (best.frequency == around.frequency &&
            best.damping == around.damping)
          step /= 2.;
      }
    return best;
  }
} // namespace CaissonMPM
