// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/frame_data.h>
#include <caisson_mpm/output/visualization.h>
#include <caisson_mpm/output/vtu_file.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <regex>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    const char *const by_penetration = "_by_penetration.pvd";
    constexpr double  no_penetration = std::numeric_limits<double>::quiet_NaN();

    std::string
    numbered(const std::string &name, const unsigned int number)
    {
      char buffer[16];
      std::snprintf(buffer, sizeof(buffer), "_%04u", number);
      return name + buffer;
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
      const std::string                           text = read_text(path);
      const std::regex element(R"rx(timestep="([^"]+)".*file="([^"]+)")rx");
      for (std::sregex_iterator i(text.begin(), text.end(), element), end;
           i != end;
           ++i)
        frames.emplace_back(std::strtod(i->str(1).c_str(), nullptr), i->str(2));
      return frames;
    }

    // a piece takes some hundred bytes of memory for each point
    constexpr unsigned long long points_per_piece = 100000;
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
        const std::string             path = directory + "/" + series.name;
        std::map<std::string, double> penetrations;
        for (const auto &[depth, file] : read_series(path + by_penetration))
          penetrations[file] = depth;
        series.frames.clear();
        for (const auto &[at, file] : read_series(path + ".pvd"))
          if (!before(time, at))
            series.frames.push_back({at,
                                     file,
                                     penetrations.count(file) > 0 ?
                                       penetrations[file] :
                                       no_penetration});
      }
  }

  double
  Visualization::fingerprint() const
  {
    Fingerprint result;
    for (const Series &series : all_series)
      for (const Frame &frame : series.frames) // as in the file
        result.add(to_text(frame.time, 10) + " " + frame.file + "\n");
    return result.number();
  }

  void
  Visualization::write_frame(const BackgroundGrid &grid,
                             const MaterialPoints &points,
                             const RigidBody      &body,
                             const Soil           &soil,
                             const PoreWater      &water,
                             const double          time)
  {
    // after a restart the frame of this time may be there already
    drop_frames_from(time);
    const unsigned int number       = next_number();
    const MPI_Comm     communicator = grid.communicator();
    const FrameData    data(grid, points, soil, water);
    const double       penetration =
      body.shape().exists() ? body.penetration() : no_penetration;
    std::array<Frame, 3> frames;
    const auto           write =
      [&](const unsigned int i, const unsigned int n, const auto &make) {
        const std::string file = numbered(all_series[i].name, number) + ".vtu";
        write_vtu_file(directory + "/" + file, communicator, time, n, make);
        frames[i] = {time, file, penetration};
      };
    const unsigned int own      = points.n_points() / points_per_piece + 1,
                       n_pieces = Utilities::MPI::max(own, communicator);
    write(0, n_pieces, [&](const unsigned int i) {
      return data.of_points(i * points_per_piece, (i + 1) * points_per_piece);
    });
    write(1, 1, [&](const unsigned int) { return data.of_cells(); });
    // the first rank knows all of the body
    const VtuPiece section = data.of_body(body);
    if (section.n_cells() > 0)
      write(2, 1, [&](const unsigned int) {
        return grid.is_first_rank() ? section : VtuPiece();
      });
    // a frame is listed when all of its files are complete
    for (unsigned int i = 0; i < frames.size(); ++i)
      if (!frames[i].file.empty())
        all_series[i].frames.push_back(frames[i]);
    if (grid.is_first_rank())
      for (const Series &series : all_series)
        write_series(series);
  }

  void
  Visualization::drop_frames_from(const double time)
  {
    for (Series &series : all_series)
      while (!series.frames.empty() && !before(series.frames.back().time, time))
        series.frames.pop_back();
  }

  unsigned int
  Visualization::next_number() const
  {
    unsigned int next = 0;
    for (const Series &series : all_series)
      for (const Frame &frame : series.frames)
        {
          const auto digits = frame.file.find('_') + 1;
          const auto number = std::strtoul(&frame.file[digits], nullptr, 10);
          next              = std::max<unsigned int>(next, number + 1);
        }
    return next;
  }

  void
  Visualization::write_series(const Series &series) const
  {
    if (series.frames.empty())
      return;
    std::vector<std::pair<double, std::string>> by_time, by_depth;
    for (const Frame &frame : series.frames)
      {
        by_time.emplace_back(frame.time, frame.file);
        if (!std::isnan(frame.penetration))
          by_depth.emplace_back(frame.penetration, frame.file);
      }
    const auto write = [&](const std::string &ending, const auto &frames) {
      std::ostringstream text;
      DataOutBase::write_pvd_record(text, frames);
      write_atomically(directory + "/" + series.name + ending, text.str());
    };
    write(".pvd", by_time);
    if (!by_depth.empty())
      write(by_penetration, by_depth);
  }
} // namespace CaissonMPM
