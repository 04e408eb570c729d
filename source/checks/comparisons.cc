// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/checks/comparisons.h>
#include <caisson_mpm/checks/damped_wave.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  namespace
  {
    using Values = std::vector<double>;

    /** The difference over the scale, or itself where the scale is 0. */
    double
    over(const double scale, const double difference)
    {
      return scale == 0. ? difference : difference / std::abs(scale);
    }

    Comparison
    compare(const double computed, const double exact)
    {
      return {computed, exact, over(exact, std::abs(computed - exact))};
    }

    double
    largest_magnitude(const Values &values)
    {
      double result = 0.;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    }

    /** sum w v / sum w; all weights 1 where there are none. */
    double
    mean_of(const Values &values, const Values &weights = {})
    {
      double sum = 0., total = 0.;
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          const double weight = weights.empty() ? 1. : weights[i];
          sum += weight * values[i];
          total += weight;
        }
      return sum / total;
    }

    /** The values with the largest error; one that is not a number is the
     * worst. @p scale_at(i) is what the error of value i is divided by. */
    template <typename Scale>
    Comparison
    worst_of(const Values &computed, const Values &exact, const Scale &scale_at)
    {
      Comparison worst;
      worst.error = -1.;
      for (std::size_t i = 0; i < computed.size(); ++i)
        {
          const double error =
            over(scale_at(i), std::abs(computed[i] - exact[i]));
          if (!(error <= worst.error))
            worst = {computed[i], exact[i], error};
          if (std::isnan(error))
            break;
        }
      return worst;
    }

    Comparison
    worst_over_largest(const Values &computed, const Values &exact)
    {
      const double scale = largest_magnitude(exact);
      return worst_of(computed, exact, [scale](const std::size_t) {
        return scale;
      });
    }

    // ---------------------------------------------------------- of points

    Comparison
    max(const PointSamples &s)
    {
      return worst_over_largest(s.computed, s.exact);
    }

    Comparison
    pointwise(const PointSamples &s)
    {
      return worst_of(s.computed, s.exact, [&s](const std::size_t i) {
        return s.exact[i];
      });
    }

    Comparison
    mean(const PointSamples &s)
    {
      return compare(mean_of(s.computed, s.volume), mean_of(s.exact, s.volume));
    }

    Comparison
    rms(const PointSamples &s)
    {
      Values squares;
      for (std::size_t i = 0; i < s.computed.size(); ++i)
        squares.push_back(std::pow(s.computed[i] - s.exact[i], 2));
      const double error = std::sqrt(mean_of(squares, s.volume));
      return {error, 0., over(largest_magnitude(s.exact), error)};
    }

    Comparison
    spread(const PointSamples &s)
    {
      const auto [least, most] =
        std::minmax_element(s.computed.begin(), s.computed.end());
      double width = *most - *least;
      for (const double value : s.computed)
        width = std::isnan(value) ? value : width;
      return {width, 0., over(mean_of(s.computed, s.volume), width)};
    }

    // ---------------------------------------------------------- of series

    Comparison
    trace(const SeriesSamples &s)
    {
      return worst_over_largest(s.computed.value, s.exact);
    }

    Comparison
    final(const SeriesSamples &s)
    {
      return compare(s.computed.value.back(), s.exact.back());
    }

    Comparison
    average(const SeriesSamples &s)
    {
      return compare(mean_of(s.computed.value), mean_of(s.exact));
    }

    Comparison
    frequency(const SeriesSamples &s)
    {
      return compare(fit_damped_wave(s.computed).frequency, s.exact.back());
    }

    Comparison
    amplitude(const SeriesSamples &s)
    {
      return compare(fit_damped_wave(s.computed).left_after_two_periods(),
                     s.exact.back());
    }

    Comparison
    drift(const SeriesSamples &s)
    {
      const Values start(s.computed.value.size(), s.computed.value.front());
      Comparison   worst =
        worst_of(s.computed.value, start, [](const std::size_t) { return 0.; });
      worst.error = over(largest_magnitude(s.computed.value), worst.error);
      return worst;
    }

    /** How far @p value lies outside; 0 inside. */
    Comparison
    outside(const double value, const double lower, const double upper)
    {
      const double bound =
        std::abs(value - lower) < std::abs(value - upper) ? lower : upper;
      if (value >= lower && value <= upper)
        return {value, bound, 0.};
      return compare(value, bound);
    }

    constexpr double infinity = std::numeric_limits<double>::infinity();

    Comparison
    below(const SeriesSamples &s)
    {
      return outside(s.computed.value.back(), -infinity, s.exact.back());
    }

    Comparison
    above(const SeriesSamples &s)
    {
      return outside(s.computed.value.back(), s.exact.back(), infinity);
    }

    Comparison
    between(const SeriesSamples &s)
    {
      return outside(s.computed.value.back(), s.exact.back(), s.upper.back());
    }
  } // namespace

  const PointModes &
  point_modes()
  {
    static const PointModes modes = {
      {"max", {max, CheckForm::exact}},
      {"pointwise", {pointwise, CheckForm::exact}},
      {"mean", {mean, CheckForm::exact}},
      {"rms", {rms, CheckForm::exact}},
      {"spread", {spread, CheckForm::tolerance}}};
    return modes;
  }

  const SeriesModes &
  series_modes()
  {
    static const SeriesModes modes = {
      {"trace", {trace, CheckForm::exact}},
      {"final", {final, CheckForm::exact}},
      {"average", {average, CheckForm::exact}},
      {"frequency", {frequency, CheckForm::exact}},
      {"amplitude", {amplitude, CheckForm::exact}},
      {"drift", {drift, CheckForm::tolerance}},
      {"below", {below, CheckForm::bound}},
      {"above", {above, CheckForm::bound}},
      {"between", {between, CheckForm::bounds}}};
    return modes;
  }
} // namespace CaissonMPM
