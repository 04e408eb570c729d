// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/checks/comparisons.h>
#include <caisson_mpm/checks/verification.h>
#include <caisson_mpm/output/check_text.h>
#include <caisson_mpm/output/json.h>
#include <caisson_mpm/output/point_quantities.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    const std::string name_of_entry = "Verification/Checks";

    const char *const how_to_write =
      "a check is written as mode quantity : exact solution : tolerance, for "
      "instance max displacement_z : -0.01*z : 1e-3.";

    struct Check
    {
      std::string head; // what stands before the first colon
      std::string mode, name;
      CheckMode   how = {};
      std::string region;       // an expression, or empty
      std::string exact, upper; // expressions; upper: of between only
      double      begin = 0.;   // of the records
      double      end   = std::numeric_limits<double>::infinity();
      std::string until;          // a series, or empty
      double      reached   = 0.; // its value where the records end
      double      tolerance = 0.;
    };

    std::string
    place_of(const std::string &text)
    {
      return name_of_entry + ": \"" + text + "\": ";
    }

    // ---------------------------------------------------------- reading

    /** Mode, name, and where REGION or from T to T. */
    void
    parse_head(const std::string              &place,
               Check                          &check,
               const std::vector<std::string> &series)
    {
      std::istringstream in(check.head);
      in >> check.mode >> check.name;
      if (check.name.empty())
        throw BadInput(place + "expected a mode and a quantity or a series "
                               "before the first colon, for instance max "
                               "displacement_z.");
      check_known(check.mode, names_of(check_modes()), place, "mode");
      check.how = check_modes().at(check.mode);
      if (check.how.of_points)
        point_quantity(check.name, place);
      else
        check_known(check.name,
                    series,
                    place,
                    "observation or column of history.csv");
      for (std::string word; in >> word;)
        {
          std::string value;
          if (check.how.of_points && word == "where")
            {
              std::getline(in, check.region);
              check.region = Utilities::trim(check.region);
              if (Expression(check.region, place + "the region").is_zero())
                throw BadInput(place +
                               "the region is 0, which no point belongs "
                               "to. Write an expression that is not 0 "
                               "in it.");
            }
          else if (!check.how.of_points && (word == "from" || word == "to"))
            {
              in >> value;
              (word == "from" ? check.begin : check.end) =
                parse_number(value, place, "time");
            }
          else if (!check.how.of_points && word == "until")
            {
              in >> check.until >> value;
              check_known(check.until, series, place, "series");
              check.reached = parse_number(value, place, "value");
            }
          else
            throw BadInput(place + "\"" + word +
                           "\" is not understood; only \"where REGION\" may "
                           "follow a quantity, and only \"from T\", \"to "
                           "T\" and \"until SERIES VALUE\" a series.");
        }
      if (check.begin > check.end)
        throw BadInput(place + "from " + to_text(check.begin) + " to " +
                       to_text(check.end) +
                       " has no record: write the earlier time first.");
    }

    /** What stands behind the first colon. */
    void
    parse_values(const std::string &place,
                 const std::string &text,
                 Check             &check)
    {
      // an expression may contain colons: (z < -1 ? 0 : 1)
      const auto        colon = text.rfind(':');
      const bool        two   = colon != std::string::npos;
      const std::string last =
        Utilities::trim(text.substr(two ? colon + 1 : 0));
      const bool has_two = check.how.form == CheckForm::exact ||
                           check.how.form == CheckForm::bounds;
      if (has_two && !two)
        throw BadInput(place +
                       (check.how.form == CheckForm::bounds ?
                          "it is written as between series : lower : upper." :
                          how_to_write));
      if (has_two)
        check.exact = Utilities::trim(text.substr(0, colon));
      else
        check.exact =
          check.how.form == CheckForm::bound ? Utilities::trim(text) : "0";
      check.upper = check.how.form == CheckForm::bounds ? last : "0";
      Expression(check.exact, place + "the exact solution");
      Expression(check.upper, place + "the upper bound");
      if (check.how.form == CheckForm::bound ||
          check.how.form == CheckForm::bounds)
        return;
      check.tolerance = parse_number(last, place, "tolerance");
      if (!(check.tolerance > 0.))
        throw BadInput(place + "the tolerance \"" + last +
                       "\" must be a positive number.");
    }

    Check
    parse_check(const std::string &text, const std::vector<std::string> &series)
    {
      const std::string place = place_of(text);
      const auto        colon = text.find(':');
      if (colon == std::string::npos)
        throw BadInput(place + how_to_write);
      Check check;
      check.head = Utilities::trim(text.substr(0, colon));
      parse_head(place, check, series);
      parse_values(place, text.substr(colon + 1), check);
      return check;
    }

    std::vector<std::string>
    texts_of(const std::string &entry)
    {
      std::vector<std::string> result;
      for (const auto &text : Utilities::split_string_list(entry, ';'))
        if (!text.empty())
          result.push_back(text);
      return result;
    }

    // ---------------------------------------------------------- comparing

    [[noreturn]] void
    report_nothing(const Check &check, const std::string &what)
    {
      throw RunFailure(place_of(check.head) + "there is no " + what +
                       " to compare. Choose another one.");
    }

    Samples
    sample_points(const Check     &check,
                  const AllPoints &points,
                  const double     time)
    {
      const std::string place = place_of(check.head);
      const Expression  exact(check.exact, place);
      const Expression region(check.region.empty() ? "1" : check.region, place);
      const PointQuantity value = point_quantity(check.name, "");
      Samples             samples;
      points.for_each([&](const MaterialPoint &p) {
        if (value.is_missing(p) || region(p.initial_position, time) == 0.)
          return;
        samples.computed.push_back(value(p));
        samples.exact.push_back(exact(p.initial_position, time));
        samples.volume.push_back(p.volume);
      });
      if (samples.computed.empty())
        report_nothing(check,
                       "material point with this quantity in the region");
      return samples;
    }

    /** End a series between the records where another one, @p limit, first
     * reaches its value. */
    void
    cut(const Check &check, const std::vector<double> &limit, Series &series)
    {
      std::size_t end = 1;
      while (end < limit.size() && limit[end] < check.reached)
        ++end;
      if (end >= limit.size())
        report_nothing(check,
                       "record with " + check.until + " = " +
                         to_text(check.reached));
      const double share =
        (check.reached - limit[end - 1]) / (limit[end] - limit[end - 1]);
      for (std::vector<double> *const v : {&series.time, &series.value})
        {
          v->resize(end + 1);
          v->back() = (*v)[end - 1] + share * (v->back() - (*v)[end - 1]);
        }
    }

    Samples
    sample_records(const Check &check, const Records &records)
    {
      const std::string place = place_of(check.head);
      const Expression  exact(check.exact, place);
      const Expression  upper(check.upper, place);
      Series series = records.series(check.name, check.begin, check.end);
      if (!check.until.empty())
        cut(check,
            records.series(check.until, check.begin, check.end).value,
            series);
      Samples samples;
      samples.computed = series.value;
      for (const double time : series.time)
        {
          samples.exact.push_back(exact(Point<2>(), time));
          samples.upper.push_back(upper(Point<2>(), time));
        }
      if (samples.exact.empty())
        report_nothing(check, "record between these times");
      return samples;
    }

    /** What the error of a check is divided by; nothing where that is 0. */
    std::string
    reference_of(const Check &check, const Comparison &c)
    {
      if (check.how.form == CheckForm::bound ||
          check.how.form == CheckForm::bounds ||
          c.error == std::abs(c.computed - c.exact))
        return "";
      return std::string(" of ") + check.how.scale;
    }

    std::string
    demand_of(const Check &check)
    {
      if (check.how.form == CheckForm::bounds)
        return " " + check.exact + " and " + check.upper;
      if (check.how.form == CheckForm::bound)
        return " " + check.exact;
      return ": within " + to_text(check.tolerance, 6);
    }

    /** What of a check is the same on all machines; with @p values also the
     * rest. */
    std::string
    line_of(const Check      &check,
            const Comparison &c,
            const bool        pass,
            const bool        values)
    {
      std::string line = check.head + demand_of(check) +
                         (values ? reference_of(check, c) : "") + ": " +
                         (pass ? "yes" : "no");
      if (values)
        line += " (computed " + to_text(c.computed, 8) + ", exact " +
                to_text(c.exact, 8) + ", error " + to_text(c.error, 3) + ")";
      return line;
    }

    Json
    json_of(const Check &check, const Comparison &c, const bool pass)
    {
      return {{"check", check.head},
              {"mode", check.mode},
              {"quantity", check.name},
              {"computed", c.computed},
              {"exact", c.exact},
              {"relative_error", c.error},
              {"tolerance", check.tolerance},
              {"pass", pass}};
    }
  } // namespace

  Verification::Verification()
    : Section("/Verification", Influence::none)
  {
    add_parameter(
      "Checks",
      entry,
      "SI",
      "The checks, separated by semicolons, compare results with exact "
      "solutions at the end of the run. A check of the material points is "
      "written as mode quantity : exact solution : tolerance, with the modes "
      "max (the largest error over the largest exact value), pointwise (the "
      "largest relative error), mean (of the means over the volume) and rms "
      "(of the error, over the largest exact value), or as spread quantity : "
      "tolerance (the largest difference over the mean); where REGION may "
      "follow the quantity. A check of a series, which is an observation or a "
      "column of history.csv, is written as mode series : exact solution : "
      "tolerance, with the modes trace (the largest error over the largest "
      "exact value), final (of the last record) and average (over the "
      "records), as drift series : "
      "tolerance (the largest change since the start over the largest value), "
      "or, for the last record, as below series : bound, above series : bound "
      "or between series : lower : upper; from T, to T and until SERIES VALUE "
      "(where this series first reaches the value) may follow the series. "
      "Errors are relative except where the exact value is 0. " +
        point_quantities_text() +
        " The exact solution and the region are expressions in the initial "
        "coordinates r and z, the time t, and pi.",
      Patterns::Anything());
  }

  void
  Verification::check_parameters(const std::vector<std::string> &series) const
  {
    for (const std::string &text : texts_of(entry))
      parse_check(text, series);
  }

  bool
  Verification::empty() const
  {
    return texts_of(entry).empty();
  }

  bool
  Verification::run(const AllPoints   &points,
                    const Records     &records,
                    const double       time,
                    const std::string &directory,
                    Console           &console) const
  {
    const bool   full     = console.get_verbosity() == Console::Verbosity::full;
    unsigned int n_failed = 0;
    Json         items    = Json::array();
    for (const std::string &text : texts_of(entry))
      {
        const Check      check = parse_check(text, records.names());
        const Comparison c     = check.how.compare(
          check.how.of_points ? sample_points(check, points, time) :
                                sample_records(check, records));
        const bool pass = c.error <= check.tolerance;
        n_failed += !pass;
        items.push_back(json_of(check, c, pass));
        console.message(line_of(check, c, pass, full));
      }
    write_atomically(directory + "/verification.json", text_of(items));
    if (n_failed > 0)
      console.failure(to_text(n_failed) + " of " + to_text(items.size()) +
                      " checks failed");
    return n_failed == 0;
  }
} // namespace CaissonMPM
