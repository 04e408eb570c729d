// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/checks/comparisons.h>

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

    // ---------------------------------------------------------- of points

    Comparison
    max(const Samples &s)
    {
      const double scale = largest_magnitude(s.exact);
      return worst_of(s.computed, s.exact, [scale](const std::size_t) {
        return scale;
      });
    }

    Comparison
    pointwise(const Samples &s)
    {
      return worst_of(s.computed, s.exact, [&s](const std::size_t i) {
        return s.exact[i];
      });
    }

    Comparison
    mean(const Samples &s)
    {
      return compare(mean_of(s.computed, s.volume), mean_of(s.exact, s.volume));
    }

    Comparison
    rms(const Samples &s)
    {
      Values squares;
      for (std::size_t i = 0; i < s.computed.size(); ++i)
        squares.push_back(std::pow(s.computed[i] - s.exact[i], 2));
      const double error = std::sqrt(mean_of(squares, s.volume));
      return {error, 0., over(largest_magnitude(s.exact), error)};
    }

    Comparison
    spread(const Samples &s)
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
    drift(const Samples &s)
    {
      const Values start(s.computed.size(), s.computed.front());
      Comparison   worst =
        worst_of(s.computed, start, [](const std::size_t) { return 0.; });
      worst.error = over(largest_magnitude(s.computed), worst.error);
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
  } // namespace

  const std::map<std::string, CheckMode> &
  check_modes()
  {
    using S                        = const Samples &;
    constexpr double      infinity = std::numeric_limits<double>::infinity();
    constexpr const char *largest  = "the largest exact value",
                         *of_mean  = "the mean exact value";
    static const std::map<std::string, CheckMode> modes = {
      {"max", {max, CheckForm::exact, true, largest}},
      {"pointwise", {pointwise, CheckForm::exact, true}},
      {"mean", {mean, CheckForm::exact, true, of_mean}},
      {"rms", {rms, CheckForm::exact, true, largest}},
      {"spread", {spread, CheckForm::tolerance, true, "the mean"}},
      {"trace", {max, CheckForm::exact, false, largest}},
      {"final",
       {[](S s) { return compare(s.computed.back(), s.exact.back()); },
        CheckForm::exact,
        false}},
      {"average", {mean, CheckForm::exact, false, of_mean}},
      {"drift", {drift, CheckForm::tolerance, false, "the largest value"}},
      {"below",
       {[](S s) {
          return outside(s.computed.back(), -infinity, s.exact.back());
        },
        CheckForm::bound,
        false}},
      {"above",
       {[](S s) {
          return outside(s.computed.back(), s.exact.back(), infinity);
        },
        CheckForm::bound,
        false}},
      {"between",
       {[](S s) {
          return outside(s.computed.back(), s.exact.back(), s.upper.back());
        },
        CheckForm::bounds,
        false}}};
    return modes;
  }
} // namespace CaissonMPM
