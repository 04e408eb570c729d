// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/shown_unit.h>
#include <caisson_mpm/base/text.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace CaissonMPM
{
  namespace
  {
    /** As std::sprintf, into a string. */
    std::string
    format(const char *const pattern, ...)
      __attribute__((format(printf, 1, 2)));

    std::string
    format(const char *const pattern, ...)
    {
      char         buffer[256];
      std::va_list arguments;
      va_start(arguments, pattern);
      std::vsnprintf(buffer, sizeof(buffer), pattern, arguments);
      va_end(arguments);
      return buffer;
    }

    /** Round-off of a zero must not differ between two machines. */
    double
    without_noise(const double x)
    {
      return std::abs(x) < 1e-12 ? 0. : x;
    }

    std::string
    clock_time(const double seconds)
    {
      if (!(seconds >= 0. && seconds < 1e7))
        return "--:--:--";
      const long int s = std::lround(seconds);
      return format("%02ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
    }

    double
    number(const RecordLine &line, const std::string &column)
    {
      return number_named(column, line.row).value_or(0.);
    }

    std::string
    plain_record(const RecordLine &line)
    {
      const auto shown = [&line](const std::string &column) {
        return without_noise(number(line, column));
      };
      const auto force = [&line](const std::string &column) {
        return without_noise(1e-3 * number(line, column));
      };
      const std::string done =
        format(" | %.6g %%\n", 100. * line.fraction_done);
      if (!number_named("tip_force_N", line.row))
        return format("time %.6g s | kinetic energy %.6g J | "
                      "max speed %.6g m/s",
                      number(line, "time_s"),
                      shown("kinetic_energy_J"),
                      shown("max_speed_m_s")) +
               done;
      return format("pen %.6g m | tip %.6g inner %.6g outer %.6g "
                    "total %.6g kN",
                    number(line, "penetration_m"),
                    force("tip_force_N"),
                    force("inner_friction_N"),
                    force("outer_friction_N"),
                    force("total_force_N")) +
             (number_named("total_force_with_water_N", line.row) ?
                format(", with water %.6g kN",
                       force("total_force_with_water_N")) :
                "") +
             done;
    }

    /** What the full line says of the water, where there is any. */
    std::string
    water_in_full(const RecordLine &line, const ShownUnit &force)
    {
      std::string text;
      if (const auto total = number_named("total_force_with_water_N", line.row))
        text +=
          format(", with water %7.1f ", force.factor * *total) + force.name;
      if (const auto suction = number_named("suction_Pa", line.row))
        {
          const ShownUnit unit = unit_of_stresses(std::abs(*suction));
          text +=
            format(" | suction %5.1f ", unit.factor * *suction) + unit.name;
        }
      if (const auto critical = number_named("critical_gradient", line.row))
        {
          const double gradient = std::max(number(line, "exit_gradient_wall"),
                                           number(line, "exit_gradient_axis"));
          text += format(", gradient %3.0f %% of critical",
                         *critical > 0. ? 100. * gradient / *critical : 0.);
        }
      return text;
    }

    std::string
    full_record(const RecordLine &line)
    {
      std::string rest = format(" | %5.1f %%", 100. * line.fraction_done);
      if (std::isfinite(line.eta_seconds))
        rest += " | ETA " + clock_time(line.eta_seconds);
      rest += "\n";
      if (!number_named("tip_force_N", line.row))
        return format("time %8.4f s | kinetic energy %9.3e J | "
                      "max speed %9.3e m/s",
                      number(line, "time_s"),
                      number(line, "kinetic_energy_J"),
                      number(line, "max_speed_m_s")) +
               rest;
      const double total     = number(line, "total_force_N"),
                   tip       = number(line, "tip_force_N"),
                   water     = number(line, "total_force_with_water_N");
      const ShownUnit length = unit_of_lengths(line.length),
                      force  = unit_of_forces(std::max(
                        {std::abs(total), std::abs(tip), std::abs(water)}));
      return format("pen %6.*f %s | tip %7.1f inner %7.1f outer %7.1f "
                    "total %7.1f ",
                    length.factor > 1. ? 1 : 3,
                    length.factor * number(line, "penetration_m"),
                    length.name.c_str(),
                    force.factor * tip,
                    force.factor * number(line, "inner_friction_N"),
                    force.factor * number(line, "outer_friction_N"),
                    force.factor * total) +
             force.name + water_in_full(line, force) + rest;
    }

    /** Of the longest key in the summary of a scene, "material points", so that
     * the values in the header stand above those of the summary. */
    constexpr std::size_t width_of_scene = 15;

    /** Lines with their values below each other. */
    std::string
    aligned(const Console::Lines &lines, const std::size_t smallest_width = 0)
    {
      std::size_t width = smallest_width;
      for (const auto &line : lines)
        width = std::max(width, line.first.size());
      std::string result;
      for (const auto &[key, value] : lines)
        result +=
          key + std::string(width - key.size(), ' ') + "  " + value + "\n";
      return result;
    }
  } // namespace

  Console::Console(const Verbosity verbosity, std::ostream &out)
    : verbosity(verbosity)
    , out(out)
  {}

  void
  Console::header(const Lines &lines)
  {
    if (verbosity == Verbosity::full)
      print(aligned(lines, width_of_scene));
  }

  void
  Console::summary(const Lines &lines)
  {
    print(aligned(lines));
  }

  void
  Console::record(const RecordLine &line)
  {
    print(verbosity == Verbosity::full ? full_record(line) :
                                         plain_record(line));
  }

  void
  Console::message(const std::string &text)
  {
    print(text + "\n");
  }

  void
  Console::warning(const std::string &text, const WarningRank rank)
  {
    warnings_.push_back({text, rank});
    print("warning: " + text + "\n");
  }

  void
  Console::print(const std::string &text)
  {
    if (verbosity != Verbosity::silent)
      out << printable(text) << std::flush;
  }

  void
  finish_list(std::ostream &out)
  {
    const bool prints = out.rdbuf() != nullptr;
    if (prints && !out.flush())
      throw RunFailure("standard output takes no more text: is it closed, or a "
                       "disk full?");
  }
} // namespace CaissonMPM
