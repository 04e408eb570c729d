// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/output/history.h>
#include <caisson_mpm/output/text_file.h>

#include <deal.II/base/exceptions.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    constexpr int digits = 10;

    // others' scripts read these names: add new columns at the end
    const std::string header =
      "time_s,penetration_m,tip_force_N,inner_friction_N,outer_friction_N,"
      "total_force_N,top_force_N,kinetic_energy_J,external_work_J,"
      "added_mass_kg,max_speed_m_s,time_step_s,limiter_count,"
      "held_back_count,points_in_body,contact_nodes,sticking_nodes,step\n";

    std::string
    line_of(const HistoryRow &row)
    {
      std::string line;
      for (const double value : {row.time,
                                 row.penetration,
                                 row.tip,
                                 row.inner,
                                 row.outer,
                                 row.total,
                                 row.top,
                                 row.kinetic_energy,
                                 row.external_work,
                                 row.added_mass,
                                 row.max_speed,
                                 row.time_step})
        line += to_text(value, digits) + ",";
      for (const unsigned long count : {row.limiter_count,
                                        row.held_back,
                                        0ul + row.points_in_body,
                                        0ul + row.contact_nodes,
                                        0ul + row.sticking_nodes})
        line += std::to_string(count) + ",";
      return line + std::to_string(row.step) + "\n";
    }



    /** The header and the complete rows of @p text up to this time. */
    std::string
    rows_until(const std::string &text, const double time)
    {
      const auto   n_commas  = std::count(header.begin(), header.end(), ',');
      const double tolerance = 1e-9 * std::abs(time); // times are rounded
      std::string  kept      = header;
      std::istringstream lines(text.substr(header.size()));
      for (std::string line; std::getline(lines, line) && !lines.eof();)
        if (std::count(line.begin(), line.end(), ',') == n_commas &&
            std::strtod(line.c_str(), nullptr) <= time + tolerance)
          kept += line + "\n";
      return kept;
    }
  } // namespace



  HistoryFile::HistoryFile(const std::string &path)
    : path(path)
  {}



  void
  HistoryFile::create()
  {
    start_with(header);
  }



  void
  HistoryFile::resume(const double time)
  {
    const std::string text = read_text(path);
    if (text.empty())
      return create();
    if (text.compare(0, header.size(), header) != 0)
      throw BadInput(path + " has other columns than this version writes, so "
                            "that the run cannot go on in it. Move the file "
                            "away and try again.");
    start_with(rows_until(text, time));
  }



  void
  HistoryFile::append(const HistoryRow &row)
  {
    Assert(file != nullptr, dealii::ExcMessage("call create() or resume()"));
    const std::string line = line_of(row);
    if (std::fwrite(line.data(), 1, line.size(), file.get()) != line.size())
      {
        const int error = errno;
        // a part of the row may be in the file
        const bool shortened = ftruncate(fileno(file.get()), size) == 0;
        report_unwritable(path,
                          error,
                          shortened ? "the rows so far are kept" :
                                      "its last row is incomplete");
      }
    size += line.size();
  }



  void
  HistoryFile::start_with(const std::string &text)
  {
    file.reset();
    write_atomically(path, text);
    file.reset(std::fopen(path.c_str(), "ab"));
    if (file == nullptr)
      report_unwritable(path, errno);
    // a row that was taken back must not be written again when closing
    std::setvbuf(file.get(), nullptr, _IONBF, 0);
    size = text.size();
  }
} // namespace CaissonMPM
