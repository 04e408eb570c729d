// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/observations.h>
#include <caisson_mpm/output/point_quantities.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  /** What the points of an observation have: [n_points] each. */
  struct PointSamples
  {
    std::vector<double> value, volume, mass, shape;
  };

  /** A way to make one number of the points. */
  struct ObservationKind
  {
    /** What its text says besides the quantity. */
    enum class Operand
    {
      none,
      place,
      share,
      shape
    };

    /** Null where one point is asked for instead of all. */
    double (*value)(const Observation &, const PointSamples &);
    Operand operand;
  };

  namespace
  {
    using Operand = ObservationKind::Operand;

    /** sum w v / sum w. */
    double
    weighted_mean_of(const std::vector<double> &values,
                     const std::vector<double> &weight)
    {
      double sum = 0., total = 0.;
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          sum += weight[i] * values[i];
          total += weight[i];
        }
      return sum / total;
    }

    double
    mean(const Observation &, const PointSamples &s)
    {
      return weighted_mean_of(s.value, s.volume);
    }

    double
    rms(const Observation &, const PointSamples &s)
    {
      std::vector<double> squares;
      for (const double value : s.value)
        squares.push_back(value * value);
      return std::sqrt(weighted_mean_of(squares, s.volume));
    }

    double
    smallest(const Observation &, const PointSamples &s)
    {
      return *std::min_element(s.value.begin(), s.value.end());
    }

    double
    largest(const Observation &, const PointSamples &s)
    {
      return *std::max_element(s.value.begin(), s.value.end());
    }

    double
    quantile(const Observation &o, const PointSamples &s)
    {
      std::vector<std::pair<double, double>> sorted;
      double                                 total = 0.;
      for (std::size_t i = 0; i < s.value.size(); ++i)
        {
          sorted.emplace_back(s.value[i], s.mass[i]);
          total += s.mass[i];
        }
      std::sort(sorted.begin(), sorted.end());
      double sum = 0.;
      for (const auto &[value, mass] : sorted)
        {
          sum += mass;
          if (sum >= o.share * total * (1. - 1e-12))
            return value;
        }
      return sorted.back().first;
    }

    double
    projection(const Observation &, const PointSamples &s)
    {
      double product = 0., square = 0.;
      for (std::size_t i = 0; i < s.value.size(); ++i)
        {
          product += s.mass[i] * s.value[i] * s.shape[i];
          square += s.mass[i] * s.shape[i] * s.shape[i];
        }
      return product / square;
    }

    double
    at_point(const Observation &o, const AllPoints &points)
    {
      // Of two points at the same distance take the first. Initial positions
      // change only where points split or merge: then another one may be the
      // nearest from then on.
      MaterialPoint nearest;
      double        distance = std::numeric_limits<double>::infinity();
      points.for_each([&](const MaterialPoint &p) {
        const double d = p.initial_position.distance(o.place);
        if (d < distance || (d == distance && p.id < nearest.id))
          {
            nearest  = p;
            distance = d;
          }
      });
      return o.quantity(nearest);
    }

    PointSamples
    sample(const Observation &o, const AllPoints &points, const double time)
    {
      PointSamples samples;
      points.for_each([&](const MaterialPoint &p) {
        if (o.quantity.is_missing(p) ||
            (!o.region.empty() && o.region(p.initial_position, time) == 0.))
          return;
        samples.value.push_back(o.quantity(p));
        samples.volume.push_back(p.volume);
        samples.mass.push_back(p.mass);
        if (!o.shape.empty())
          samples.shape.push_back(o.shape(p.initial_position, time));
      });
      if (samples.value.empty())
        throw RunFailure("Verification/Observations: " + o.name +
                         ": no material point is in its region at the start, "
                         "or none there has the quantity. Choose others.");
      return samples;
    }

    const std::map<std::string, ObservationKind> kinds = {
      {"point", {nullptr, Operand::place}},
      {"mean", {mean, Operand::none}},
      {"rms", {rms, Operand::none}},
      {"min", {smallest, Operand::none}},
      {"max", {largest, Operand::none}},
      {"quantile", {quantile, Operand::share}},
      {"projection", {projection, Operand::shape}}};

    // ---------------------------------------------------------- reading

    /** The text behind the word @p word, cut off; empty where it is absent. */
    std::string
    cut_behind(std::string &text, const std::string &word)
    {
      const auto begin = text.find(" " + word + " ");
      if (begin == std::string::npos)
        return "";
      const std::string rest = text.substr(begin + word.size() + 2);
      text.resize(begin);
      return Utilities::trim(rest);
    }

    void
    check_name(const std::string              &name,
               const std::vector<std::string> &taken,
               const std::string              &place)
    {
      bool good = !name.empty() && !std::isdigit(name[0]);
      for (const unsigned char c : name)
        good = good && (std::isalnum(c) || c == '_');
      if (!good)
        throw BadInput(place +
                       "an observation is written as name = kind quantity, for "
                       "instance top = point displacement_z at 0.01 -0.005; "
                       "its name has letters, digits and _ only.");
      if (std::count(taken.begin(), taken.end(), name) > 0)
        throw BadInput(place + "the name \"" + name +
                       "\" is already used by another observation or a column "
                       "of history.csv. Choose another one.");
    }

    double
    parse_number(const std::string &text,
                 const std::string &place,
                 const std::string &what)
    {
      const auto value = number_in(text);
      if (!value || !std::isfinite(*value))
        throw BadInput(place + "the " + what + " \"" + text +
                       "\" must be a number.");
      return *value;
    }

    Point<2>
    parse_place(const std::string &text, const std::string &place)
    {
      std::string        r, z, rest;
      std::istringstream in(text);
      in >> r >> z >> rest;
      if (z.empty() || !rest.empty())
        throw BadInput(place + "expected two numbers after \"at\", the "
                               "initial position r z in m.");
      return {parse_number(r, place, "initial r"),
              parse_number(z, place, "initial z")};
    }

    /** The kind, its number and the quantity. */
    void
    parse_words(const std::string &text,
                const std::string &place,
                Observation       &o)
    {
      std::string        quantity, rest;
      std::istringstream in(text);
      std::string        kind;
      in >> kind;
      check_known(kind, names_of(kinds), place, "kind");
      o.kind = &kinds.at(kind);
      if (o.kind->operand == Operand::share)
        {
          std::string share;
          in >> share;
          o.share = parse_number(share, place, "share of the mass");
          if (o.share < 0. || o.share > 1.)
            throw BadInput(place + "the share of the mass must lie between 0 "
                                   "and 1, for instance quantile 0.99 "
                                   "position_r.");
        }
      in >> quantity >> rest;
      o.quantity = point_quantity(quantity, place);
      if (!rest.empty())
        throw BadInput(place + "\"" + rest +
                       "\" is not understood; after the quantity, expected "
                       "\"at R Z\" (kind point), \"on SHAPE\" (kind "
                       "projection) or \"where REGION\".");
    }

    Observation
    parse(const std::string &text, const std::vector<std::string> &taken)
    {
      const std::string place = "Verification/Observations: \"" + text + "\": ";
      const auto        equal = text.find('=');
      Observation       o;
      o.name =
        Utilities::trim(text.substr(0, equal == std::string::npos ? 0 : equal));
      check_name(o.name, taken, place);
      std::string       words  = text.substr(equal + 1);
      const std::string region = cut_behind(words, "where");
      const std::string shape  = cut_behind(words, "on");
      const std::string at     = cut_behind(words, "at");
      parse_words(words, place, o);
      const bool is_point = o.kind->operand == Operand::place;
      if (is_point != !at.empty() ||
          (o.kind->operand == Operand::shape) != !shape.empty() ||
          (is_point && !region.empty()))
        throw BadInput(place + "kind point needs \"at R Z\" and no more, kind "
                               "projection needs \"on SHAPE\", and no other "
                               "kind has them.");
      if (!at.empty())
        o.place = parse_place(at, place);
      if (!shape.empty())
        o.shape = Expression(shape, place + "the shape");
      if (!region.empty())
        o.region = Expression(region, place + "the region");
      return o;
    }

    /** The quantities of the checks whose mode compares points. */
    std::vector<std::string>
    quantities_in(const std::string &checks)
    {
      const std::set<std::string> modes = {
        "max", "pointwise", "mean", "rms", "spread"};
      std::set<std::string> found;
      for (const auto &text : Utilities::split_string_list(checks, ';'))
        {
          std::istringstream in(text.substr(0, text.find(':')));
          std::string        mode, name;
          in >> mode >> name;
          if (modes.count(mode) == 0)
            continue;
          point_quantity(name, "Verification/Checks: \"" + text + "\": ");
          found.insert(name);
        }
      return {found.begin(), found.end()};
    }
  } // namespace

  Observations::Observations()
    : Section("/Verification", Influence::none)
  {
    add_parameter(
      "Observations",
      entry,
      "SI",
      "The observations, separated by semicolons, are numbers that are read "
      "from the material points at every record and written to "
      "observations.csv. Each is written as name = kind quantity. The kinds "
      "are: point quantity at R Z (of the point whose initial position is the "
      "nearest); mean, rms, min, max quantity (over the volume); quantile F "
      "quantity (not exceeded by the share F of the mass); projection quantity "
      "on SHAPE (sum m q f / sum m f^2). All kinds but point may end with "
      "where REGION. Shape and region are expressions in the initial "
      "coordinates r and z, the time t, and pi; a point belongs to the region "
      "where the expression is not 0. The entry Checks names the quantities.",
      Patterns::Anything());
    add_parameter(
      "Checks",
      checks,
      "SI",
      "The checks, separated by semicolons, state the exact solution of a scene "
      "for the laboratory (scripts/lab checks), which compares results with it. "
      "For those of material points, written as mode quantity : exact solution "
      ": tolerance with the modes max, pointwise, mean and rms, or as spread "
      "quantity : tolerance, the program writes the quantities of all points "
      "to points.csv at the end. " +
        point_quantities_text(),
      Patterns::Anything());
  }

  void
  Observations::initialize(const std::vector<std::string> &taken)
  {
    std::vector<std::string> names = taken;
    observations.clear();
    for (const auto &text : Utilities::split_string_list(entry, ';'))
      if (!text.empty())
        {
          observations.push_back(parse(text, names));
          names.push_back(observations.back().name);
        }
    quantities = quantities_in(checks);
  }

  std::vector<std::string>
  Observations::names() const
  {
    std::vector<std::string> result;
    for (const Observation &o : observations)
      result.push_back(o.name);
    return result;
  }

  std::vector<double>
  Observations::values(const AllPoints &points, const double time) const
  {
    std::vector<double> result;
    for (const Observation &o : observations)
      result.push_back(o.kind->value == nullptr ?
                         at_point(o, points) :
                         o.kind->value(o, sample(o, points, time)));
    return result;
  }

  void
  Observations::write_points(const std::string &path,
                             const AllPoints   &points,
                             const double       time) const
  {
    std::vector<std::string> names = {"initial_position_r",
                                      "initial_position_z",
                                      "volume"};
    names.insert(names.end(), quantities.begin(), quantities.end());
    std::vector<PointQuantity> values;
    std::string                text = "time_s";
    for (const std::string &name : names)
      {
        values.push_back(point_quantity(name, ""));
        text += "," + name;
      }
    points.for_each([&](const MaterialPoint &p) {
      text += "\n" + to_text(time, 17);
      for (const PointQuantity &value : values)
        text += "," + to_text(value(p), 17);
    });
    write_atomically(path, text + "\n");
  }
} // namespace CaissonMPM
