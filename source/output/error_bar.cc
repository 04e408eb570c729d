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

  ErrorBar::ErrorBar()
    : ParameterAcceptor("/Output")
  {
    add_parameter(
      "Error bar",
      file,
      "The file with the relative errors of the forces, as "
      "scripts/caisson study makes it, lies at this path relative to "
      "the scene's file, and leads to history_error.csv; without a "
      "path there is none. Units: none.");
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
                     "...\". Make it with scripts/caisson study, or leave the "
                     "entry empty.");
    if (text.compare(at + mark.size(), fingerprint.size(), fingerprint) != 0)
      return "the error bar of " + path +
             " was computed for other parameters: history_error.csv is not "
             "written (this scene: " +
             fingerprint + ")";
    try
      {
        const Table table(text);
        for (const auto &row : table.rows)
          rows.push_back({table.value(row, "penetration_m"),
                          table.value(row, "tip_error"),
                          table.value(row, "total_error")});
      }
    catch (const std::exception &)
      {
        throw BadInput("Output/Error bar = " + file + ": " + path +
                       " must have the columns penetration_m, tip_error and "
                       "total_error, with numbers. Make it with "
                       "scripts/caisson study.");
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
    return {penetration,
            a.tip + x * (b.tip - a.tip),
            a.total + x * (b.total - a.total)};
  }

  void
  ErrorBar::write(const std::string &directory) const
  {
    if (rows.empty())
      return;
    const std::vector<std::string> names = {"penetration_m",
                                            "tip_force_N",
                                            "total_force_N"};
    const Table history(read_text(directory + "/history.csv"));
    if (!history.has(names))
      throw RunFailure(directory + "/history.csv has lost its columns: "
                                   "history_error.csv is not written.");
    std::string text = "penetration_m,tip_force_N,tip_force_low_N,"
                       "tip_force_high_N,total_force_N,total_force_low_N,"
                       "total_force_high_N\n";
    for (const auto &row : history.rows)
      {
        const double depth = history.value(row, names[0]);
        if (depth < rows.front().penetration - 1e-9 ||
            depth > rows.back().penetration + 1e-9)
          continue;
        const Row error = at(depth);
        text += to_text(depth, 10);
        for (const auto &[name, half_width] :
             {std::make_pair(names[1], error.tip),
              std::make_pair(names[2], error.total)})
          for (const double factor : {1., 1. - half_width, 1. + half_width})
            text += "," + to_text(factor * history.value(row, name), 10);
        text += "\n";
      }
    write_atomically(directory + "/history_error.csv", text);
  }
} // namespace CaissonMPM
