// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/error_bar.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** A table of numbers with named columns; lines with # are left out. */
    struct Table
    {
      std::map<std::string, unsigned int> columns;
      std::vector<std::vector<double>>    rows;

      /** Throws what deal.II throws where a field is not a number. */
      explicit Table(const std::string &text)
      {
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);)
          {
            if (line.empty() || line[0] == '#')
              continue;
            const auto fields = Utilities::split_string_list(line, ',');
            if (columns.empty())
              for (unsigned int i = 0; i < fields.size(); ++i)
                columns[fields[i]] = i;
            else
              rows.push_back(Utilities::string_to_double(fields));
          }
      }

      bool
      has(const std::vector<std::string> &names) const
      {
        return std::all_of(names.begin(), names.end(), [this](const auto &n) {
          return columns.count(n) > 0;
        });
      }

      double
      value(const std::vector<double> &row, const std::string &name) const
      {
        return row.at(columns.at(name));
      }
    };
  } // namespace

  struct ErrorBar::Quantity
  {
    std::string name, unit, name_in_file;
    bool        is_relative, is_required;

    /** Its column in history.csv, or that of a bound such as "low". */
    std::string
    column(const std::string &bound = "") const
    {
      return name + (bound.empty() ? "" : "_" + bound) +
             (unit.empty() ? "" : "_" + unit);
    }

    /** The column of the file with this part of the error. */
    std::string
    column_in_file(const std::string &part) const
    {
      return name_in_file + "_" + part +
             (is_relative || unit.empty() ? "" : "_" + unit);
    }

    /** A value that is larger by this error. */
    double
    changed(const double value, const double error) const
    {
      return is_relative ? (1. + error) * value : value + error;
    }
  };

  // Forces have relative errors. The required suction crosses zero where the
  // weight no longer suffices, so that it and what follows from it have
  // absolute ones.
  const std::vector<ErrorBar::Quantity> ErrorBar::known_quantities = {
    {"tip_force", "N", "tip", true, true},
    {"total_force", "N", "total", true, true},
    {"required_suction", "Pa", "required_suction", false, false},
    {"exit_gradient_axis", "", "exit_gradient_axis", false, false},
    {"plug_heave", "m", "plug_heave", false, false}};

  ErrorBar::ErrorBar()
    : ParameterAcceptor("/Output")
  {
    add_parameter(
      "Error bar",
      file,
      "The file with the errors of the forces, and of the suction where there "
      "is one, as scripts/caisson error-bar writes it, has this path relative "
      "to the scene's file; history_error.csv is written from it. With an "
      "empty path there is none. Units: none.");
  }

  std::string
  ErrorBar::read(const std::string &scene_file, const std::string &fingerprint)
  {
    rows.clear();
    if (file.empty())
      return "";
    const std::string path =
      (std::filesystem::path(scene_file).parent_path() / file).string();
    const std::string text = read_text(path);
    const std::string mark = "# fingerprint: ";
    const auto        at   = text.find(mark);
    if (at == std::string::npos)
      throw BadInput("Output/Error bar = " + file + ": " + path +
                     " cannot be read, or has no line \"" + mark +
                     "...\". Create it with scripts/caisson error-bar, or "
                     "leave the entry empty.");
    if (text.compare(at + mark.size(), fingerprint.size(), fingerprint) != 0)
      return "the error bar of " + path +
             " was computed for other parameters: history_error.csv is not "
             "written (this scene: " +
             fingerprint + ")";
    try
      {
        const Table table(text);
        quantities.clear();
        for (const Quantity &q : known_quantities)
          if (q.is_required || table.has({q.column_in_file("below")}))
            quantities.push_back(&q);
        has_limit = table.has({quantities.front()->column_in_file("shift")});
        for (const auto &row : table.rows)
          {
            rows.push_back({table.value(row, "penetration_m"), {}});
            for (const Quantity *q : quantities)
              {
                const auto part = [&](const std::string &name) {
                  return table.value(row, q->column_in_file(name));
                };
                rows.back().errors.push_back({part("below"),
                                              part("above"),
                                              has_limit ? part("shift") : 0.});
              }
          }
      }
    catch (const std::exception &)
      {
        throw BadInput("Output/Error bar = " + file + ": " + path +
                       " must have the columns penetration_m, tip_below, "
                       "tip_above, total_below and total_above, with numbers. "
                       "Create it with scripts/caisson error-bar.");
      }
    return "";
  }

  ErrorBar::Row
  ErrorBar::at(const double penetration) const
  {
    auto above = std::upper_bound(rows.begin(),
                                  rows.end() - 1,
                                  penetration,
                                  [](const double x, const Row &row) {
                                    return x < row.penetration;
                                  });
    if (above == rows.begin())
      return *above;
    const Row   &a = *(above - 1), &b = *above;
    const double x =
      std::min(1.,
               (penetration - a.penetration) / (b.penetration - a.penetration));
    const auto mean = [x](const double from, const double to) {
      return from + x * (to - from);
    };
    Row between{penetration, {}};
    for (unsigned int i = 0; i < quantities.size(); ++i)
      {
        const Error &p = a.errors[i], &q = b.errors[i];
        between.errors.push_back({mean(p.below, q.below),
                                  mean(p.above, q.above),
                                  mean(p.shift, q.shift)});
      }
    return between;
  }

  bool
  ErrorBar::covers(const double penetration) const
  {
    constexpr double rounding = 1e-9; // m
    return !rows.empty() &&
           penetration >= rows.front().penetration - rounding &&
           penetration <= rows.back().penetration + rounding;
  }

  std::optional<ErrorBar::Error>
  ErrorBar::of_total_force(const double penetration) const
  {
    if (!covers(penetration))
      return {};
    const auto i =
      std::find_if(quantities.begin(),
                   quantities.end(),
                   [](const Quantity *q) { return q->name == "total_force"; }) -
      quantities.begin();
    return at(penetration).errors[i];
  }

  NamedNumbers
  ErrorBar::bounds(const std::string &column,
                   const double       penetration,
                   const double       value) const
  {
    if (!covers(penetration))
      return {};
    for (std::size_t i = 0; i < quantities.size(); ++i)
      if (const Quantity &q = *quantities[i]; q.column() == column)
        {
          const Error error = at(penetration).errors[i];
          return {{q.column("low"), q.changed(value, -error.below)},
                  {q.column("high"), q.changed(value, error.above)}};
        }
    return {};
  }

  void
  ErrorBar::write(const std::string &directory) const
  {
    if (rows.empty())
      return;
    const Table              history(read_text(directory + "/history.csv"));
    std::vector<std::string> names = {"penetration_m"};
    std::string              text  = names.front();
    for (const Quantity *q : quantities)
      {
        names.push_back(q->column());
        for (const std::string bound : {"", "low", "high"})
          text += "," + q->column(bound);
        if (has_limit)
          text += "," + q->column("limit");
      }
    text += "\n";
    if (!history.has(names))
      throw RunFailure(directory + "/history.csv has lost its columns: "
                                   "history_error.csv is not written.");
    for (const auto &row : history.rows)
      {
        const double depth = history.value(row, names.front());
        if (!covers(depth))
          continue;
        const Row error = at(depth);
        text += to_text(depth, 10);
        for (unsigned int i = 0; i < quantities.size(); ++i)
          {
            const double        value   = history.value(row, names[i + 1]);
            const Error        &e       = error.errors[i];
            std::vector<double> changes = {0., -e.below, e.above};
            if (has_limit)
              changes.push_back(e.shift);
            for (const double change : changes)
              text += "," + to_text(quantities[i]->changed(value, change), 10);
          }
        text += "\n";
      }
    write_atomically(directory + "/history_error.csv", text);
  }
} // namespace CaissonMPM
