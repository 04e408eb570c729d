// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/frame_text.h>
#include <caisson_mpm/output/visualization.h>
#include <caisson_mpm/output/vtu_file.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    std::string
    numbered(const std::string &name, const unsigned int number)
    {
      char buffer[16];
      std::snprintf(buffer, sizeof(buffer), "_%04u", number);
      return name + buffer;
    }

    /** The value of name="..." in an element, or nothing. */
    std::string
    attribute(const std::string &element, const std::string &name)
    {
      const std::string begin = " " + name + "=\"";
      const auto        start = element.find(begin);
      if (start == std::string::npos)
        return "";
      const auto value = start + begin.size();
      return element.substr(value, element.find('"', value) - value);
    }

    /** Times differ by rounding where they come from a file. */
    bool
    before(const double a, const double b)
    {
      return a < b - 1e-9 * std::abs(b);
    }

    /** The frames that a .pvd file lists. */
    std::vector<std::pair<double, std::string>>
    read_series(const std::string &path)
    {
      std::vector<std::pair<double, std::string>> frames;
      std::istringstream                          lines(read_text(path));
      for (std::string line; std::getline(lines, line);)
        {
          const std::string file = attribute(line, "file");
          const std::string time = attribute(line, "timestep");
          if (!file.empty() && !time.empty())
            frames.emplace_back(std::strtod(time.c_str(), nullptr), file);
        }
      return frames;
    }

    // deal.II takes about a kilobyte for each point that it writes
    constexpr unsigned long long points_per_piece = 100000;

    /** The largest number of pieces that a rank needs for its points.
     * Collective. */
    unsigned int
    n_pieces(const MaterialPoints &points, const MPI_Comm communicator)
    {
      const unsigned int own = points.n_points() / points_per_piece + 1;
      return Utilities::MPI::max(own, communicator);
    }
  } // namespace

  Visualization::Visualization(const std::string &directory)
    : directory(directory)
    , all_series{{{"points", {}}, {"grid", {}}, {"body", {}}}}
  {}

  void
  Visualization::resume(const double time)
  {
    for (Series &series : all_series)
      {
        series.frames = read_series(directory + "/" + series.name + ".pvd");
        while (!series.frames.empty() &&
               before(time, series.frames.back().first))
          series.frames.pop_back();
      }
  }

  double
  Visualization::fingerprint() const
  {
    Fingerprint result;
    for (const Series &series : all_series)
      for (const auto &[time, file] : series.frames)
        result.add(to_text(time, 10) + " " + file + "\n"); // as in the file
    return result.number();
  }

  void
  Visualization::write_frame(BackgroundGrid       &grid,
                             const MaterialPoints &points,
                             const RigidBody      &body,
                             const Soil           &soil,
                             const bool            with_pore_pressure,
                             const double          time)
  {
    grid.write_vertices();
    // after a restart the frame of this time may be there already
    drop_frames_from(time);
    const unsigned int number       = next_number();
    const MPI_Comm     communicator = grid.communicator();
    const FrameText    text(grid, points, soil, with_pore_pressure, time);
    const auto         write =
      [&](const Series &series, const unsigned int n, const auto &make) {
        const std::string file = numbered(series.name, number) + ".vtu";
        write_vtu_file(directory + "/" + file, communicator, n, make);
        return file;
      };

    auto &[of_points, of_grid, of_body] = all_series;
    const std::string point_file =
      write(of_points, n_pieces(points, communicator), [&](const auto i) {
        return text.of_points(i * points_per_piece, (i + 1) * points_per_piece);
      });
    const std::string grid_file =
      write(of_grid, 1, [&](const unsigned int) { return text.of_cells(); });
    // the first rank knows all of the body
    const std::string body_text = text.of_body(body);
    const std::string body_file =
      body_text.empty() ? "" : write(of_body, 1, [&](const unsigned int) {
        return grid.is_first_rank() ? body_text : "";
      });

    of_points.frames.emplace_back(time, point_file);
    of_grid.frames.emplace_back(time, grid_file);
    if (!body_file.empty())
      of_body.frames.emplace_back(time, body_file);
    if (grid.is_first_rank())
      for (const Series &series : all_series)
        write_series(series);
  }

  void
  Visualization::drop_frames_from(const double time)
  {
    for (Series &series : all_series)
      while (!series.frames.empty() &&
             !before(series.frames.back().first, time))
        series.frames.pop_back();
  }

  unsigned int
  Visualization::next_number() const
  {
    unsigned int next = 0;
    for (const Series &series : all_series)
      for (const auto &frame : series.frames)
        {
          const auto digits = frame.second.find('_') + 1;
          const auto number = std::strtoul(&frame.second[digits], nullptr, 10);
          next              = std::max<unsigned int>(next, number + 1);
        }
    return next;
  }

  void
  Visualization::write_series(const Series &series) const
  {
    if (series.frames.empty())
      return;
    std::ostringstream text;
    DataOutBase::write_pvd_record(text, series.frames);
    write_atomically(directory + "/" + series.name + ".pvd", text.str());
  }
} // namespace CaissonMPM
