// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/output/json.h>
#include <caisson_mpm/output/text_file.h>
#include <caisson_mpm/output/verification.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <vector>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    using Quantity = double (*)(const MaterialPoint &);

    const std::map<std::string, Quantity> quantities = {
      {"displacement_r",
       [](const MaterialPoint &p) {
         return p.position[0] - p.initial_position[0];
       }},
      {"displacement_z",
       [](const MaterialPoint &p) {
         return p.position[1] - p.initial_position[1];
       }},
      {"velocity_r", [](const MaterialPoint &p) { return p.velocity[0]; }},
      {"velocity_z", [](const MaterialPoint &p) { return p.velocity[1]; }},
      {"speed",
       [](const MaterialPoint &p) {
         return std::hypot(p.velocity[0], p.velocity[1]);
       }},
      {"stress_rr", [](const MaterialPoint &p) { return p.stress[rr]; }},
      {"stress_zz", [](const MaterialPoint &p) { return p.stress[zz]; }},
      {"stress_tt", [](const MaterialPoint &p) { return p.stress[tt]; }},
      {"stress_rz", [](const MaterialPoint &p) { return p.stress[rz]; }},
      {"stress_ratio",
       [](const MaterialPoint &p) { return p.stress[rr] / p.stress[zz]; }},
      {"plastic_strain",
       [](const MaterialPoint &p) { return p.plastic_deviatoric; }},
      {"volume_ratio",
       [](const MaterialPoint &p) { return p.volume / p.initial_volume; }}};

    /** The two values of a quantity that are compared, and their difference. */
    struct Comparison
    {
      double computed = 0.;
      double exact    = 0.;
      double error    = 0.;
    };

    /** What all points have: [n_points] each. */
    struct Samples
    {
      std::vector<double> computed, exact, volume;
    };

    /** |v - e| over the scale, or itself where the scale is 0. */
    double
    error_over(const double scale, const double computed, const double exact)
    {
      const double difference = std::abs(computed - exact);
      return scale == 0. ? difference : difference / std::abs(scale);
    }

    /** The point with the largest error; one that is not a number is the
     * worst. @p scale_at(i) is what the error of point i is divided by. */
    template <typename Scale>
    Comparison
    worst_of(const Samples &s, const Scale &scale_at)
    {
      Comparison worst;
      worst.error = -1.;
      for (std::size_t i = 0; i < s.computed.size(); ++i)
        {
          const double error =
            error_over(scale_at(i), s.computed[i], s.exact[i]);
          if (!(error <= worst.error))
            worst = {s.computed[i], s.exact[i], error};
          if (std::isnan(error))
            break;
        }
      return worst;
    }

    Comparison
    compare_max(const Samples &s)
    {
      double scale = 0.;
      for (const double exact : s.exact)
        scale = std::max(scale, std::abs(exact));
      return worst_of(s, [scale](const std::size_t) { return scale; });
    }

    Comparison
    compare_pointwise(const Samples &s)
    {
      return worst_of(s, [&s](const std::size_t i) { return s.exact[i]; });
    }

    Comparison
    compare_mean(const Samples &s)
    {
      double computed = 0., exact = 0., volume = 0.;
      for (std::size_t i = 0; i < s.volume.size(); ++i)
        {
          computed += s.volume[i] * s.computed[i];
          exact += s.volume[i] * s.exact[i];
          volume += s.volume[i];
        }
      computed /= volume;
      exact /= volume;
      return {computed, exact, error_over(exact, computed, exact)};
    }

    using Mode = Comparison (*)(const Samples &);

    const std::map<std::string, Mode> modes = {{"max", compare_max},
                                               {"pointwise", compare_pointwise},
                                               {"mean", compare_mean}};

    struct Check
    {
      std::string mode, quantity, expression;
      double      tolerance = 0.;
    };



    // ---------------------------------------------------------- reading

    [[noreturn]] void
    refuse(const std::string &text, const std::string &reason)
    {
      throw BadInput("Verification/Checks: \"" + text + "\": " + reason);
    }

    template <typename Value>
    void
    check_name(const std::string                  &text,
               const std::string                  &kind,
               const std::string                  &name,
               const std::map<std::string, Value> &known)
    {
      if (known.count(name) > 0)
        return;
      std::vector<std::string> names;
      std::string              list;
      for (const auto &entry : known)
        {
          names.push_back(entry.first);
          list += (list.empty() ? "" : ", ") + entry.first;
        }
      refuse(text,
             "there is no " + kind + " \"" + name + "\", only " + list + "." +
               did_you_mean(nearest_names(name, names)));
    }

    /** The exact solution of the check @p text. */
    Expression
    parse_expression(const std::string &text, const std::string &expression)
    {
      return Expression(expression,
                        "Verification/Checks: \"" + text +
                          "\": the exact solution");
    }

    double
    parse_tolerance(const std::string &text, const std::string &number)
    {
      char        *end   = nullptr;
      const double value = std::strtod(number.c_str(), &end);
      if (number.empty() || *end != '\0' || !(value > 0.) ||
          !std::isfinite(value))
        refuse(text,
               "the tolerance \"" + number + "\" must be a positive number.");
      return value;
    }

    Check
    parse_check(const std::string &text)
    {
      // an expression may contain colons: (z < -1 ? 0 : 1)
      const auto first = text.find(':'), last = text.rfind(':');
      if (first == last)
        refuse(text,
               "a check is written as mode quantity : exact solution : "
               "tolerance, for instance max displacement_z : -0.01*z : 1e-3.");
      Check              check;
      std::string        rest;
      std::istringstream names(text.substr(0, first));
      names >> check.mode >> check.quantity >> rest;
      if (check.quantity.empty() || !rest.empty())
        refuse(text,
               "before the first colon stand a mode and a quantity, for "
               "instance max displacement_z.");
      check_name(text, "mode", check.mode, modes);
      check_name(text, "quantity", check.quantity, quantities);
      check.expression =
        Utilities::trim(text.substr(first + 1, last - first - 1));
      parse_expression(text, check.expression);
      check.tolerance =
        parse_tolerance(text, Utilities::trim(text.substr(last + 1)));
      return check;
    }

    std::vector<Check>
    parse_checks(const std::string &texts)
    {
      std::vector<Check> result;
      for (const auto &text : Utilities::split_string_list(texts, ';'))
        if (!text.empty())
          result.push_back(parse_check(text));
      return result;
    }



    // ---------------------------------------------------------- comparing

    Samples
    sample(const Check &check, const MaterialPoints &points, const double time)
    {
      const Expression exact(check.expression, "the exact solution");
      const Quantity   value = quantities.at(check.quantity);
      Samples          samples;
      points.for_each([&](const MaterialPoint &p, const unsigned int) {
        samples.computed.push_back(value(p));
        samples.exact.push_back(exact(p.initial_position, time));
        samples.volume.push_back(p.volume);
      });
      return samples;
    }

    /** What of a check is the same on all machines; with @p values also the
     * rest. */
    std::string
    line_of(const Check      &check,
            const Comparison &c,
            const bool        pass,
            const bool        values)
    {
      std::string line = check.mode + " " + check.quantity + ": within " +
                         to_text(check.tolerance, 6) + ": " +
                         (pass ? "yes" : "no");
      if (values)
        line += " (computed " + to_text(c.computed, 8) + ", exact " +
                to_text(c.exact, 8) + ", error " + to_text(c.error, 3) + ")";
      return line;
    }
  } // namespace



  Verification::Verification()
    : ParameterAcceptor("/Verification")
  {
    add_parameter("Checks",
                  checks,
                  "Comparisons with an exact solution at the end of the run, "
                  "separated by semicolons. Each is written as mode quantity : "
                  "exact solution : tolerance. Modes: max (largest error over "
                  "largest exact value), pointwise (largest relative error), "
                  "mean (of the means over the volume). Quantities: "
                  "displacement_r, displacement_z, velocity_r, velocity_z, "
                  "speed, stress_rr, stress_zz, stress_tt, stress_rz, "
                  "stress_ratio (rr over zz), plastic_strain, volume_ratio. "
                  "The exact solution is an expression in the initial "
                  "coordinates r and z, the time t, and pi. Units: SI.",
                  prm,
                  Patterns::Anything());
  }



  void
  Verification::check_parameters() const
  {
    parse_checks(checks);
  }



  bool
  Verification::empty() const
  {
    return parse_checks(checks).empty();
  }



  bool
  Verification::run(const MaterialPoints &points,
                    const double          time,
                    const std::string    &directory,
                    Console              &console) const
  {
    const bool full     = console.get_verbosity() == Console::Verbosity::full;
    bool       all_pass = true;
    std::vector<std::string> items;
    for (const Check &check : parse_checks(checks))
      {
        const Comparison c = modes.at(check.mode)(sample(check, points, time));
        const bool       pass = c.error <= check.tolerance;
        all_pass              = all_pass && pass;
        items.push_back(
          Json::flat_object({{"mode", Json::text(check.mode)},
                             {"quantity", Json::text(check.quantity)},
                             {"computed", Json::number(c.computed)},
                             {"exact", Json::number(c.exact)},
                             {"relative_error", Json::number(c.error)},
                             {"tolerance", Json::number(check.tolerance)},
                             {"pass", Json::boolean(pass)}}));
        console.message(line_of(check, c, pass, full));
      }
    write_atomically(directory + "/verification.json",
                     Json::list(items) + "\n");
    return all_pass;
  }
} // namespace CaissonMPM
