// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/compat.h>
#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/point_quantities.h>
#include <caisson_mpm/output/visualization.h>

#include <deal.II/base/mpi.h>

#include <deal.II/numerics/data_out.h>

#include <deal.II/particles/data_out.h>
#include <deal.II/particles/particle_handler.h>

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
    /** The values of a point that are written: the quantities that are drawn,
     * and two that the scene decides. */
    class WrittenFields
    {
    public:
      WrittenFields(const Soil  &soil,
                    const double circumference,
                    const bool   with_pore_pressure)
        : soil(soil)
        , circumference(circumference)
      {
        for (const NamedQuantity &quantity : all_point_quantities())
          if (quantity.about.in_frames == InFrames::drawn ||
              (with_pore_pressure && quantity.about.name() == "pore_pressure"))
            {
              quantities.push_back(quantity.value);
              add_name(quantity.about);
            }
        names.insert(names.end(), {"void_ratio", "whole_volume"});
        interpretation.resize(names.size(),
                              Interpretation::component_is_scalar);
      }

      std::vector<double>
      of(const MaterialPoint &p) const
      {
        std::vector<double> values;
        for (const PointQuantity &quantity : quantities)
          values.push_back(quantity(p));
        values.push_back(p.void_ratio(soil.layer(p.material).void_ratio()));
        values.push_back(circumference * p.volume);
        return values;
      }

      std::vector<double>
      of(const BodyPoint &p, const RigidBody &body) const
      {
        MaterialPoint moved;
        moved.initial_position = p.position;
        moved.position = body.shape().moved(p.position, body.motion().travel());
        const Vector2 velocity =
          body.motion().velocity() * body.shape().direction();
        for (unsigned int d = 0; d < 2; ++d)
          moved.velocity[d] = velocity[d];
        std::vector<double> values;
        for (std::size_t i = 0; i < quantities.size(); ++i)
          values.push_back(names[i] == "material" ? -1. : quantities[i](moved));
        values.insert(values.end(), {0., p.volume});
        return values;
      }

      using Interpretation =
        DataComponentInterpretation::DataComponentInterpretation;
      std::vector<std::string>    names;
      std::vector<Interpretation> interpretation;

    private:
      /** The components r and z of a vector share its name. */
      void
      add_name(const PointField &field)
      {
        const std::string component = field.component;
        const bool        of_vector = component == "r" || component == "z";
        names.push_back(of_vector ? field.owner : field.name());
        interpretation.push_back(of_vector ?
                                   Interpretation::component_is_part_of_vector :
                                   Interpretation::component_is_scalar);
      }

      const Soil                &soil;
      const double               circumference;
      std::vector<PointQuantity> quantities;
    };

    /** A particle handler with everything that is to be written. */
    class PointCloud
    {
    public:
      PointCloud(const BackgroundGrid &grid, const WrittenFields &fields)
        : grid(grid)
        , fields(fields)
        , handler(grid.triangulation(), grid.mapping(), fields.names.size())
      {}

      /** Add the points of this rank from number begin to end. */
      void
      add_soil(const MaterialPoints    &points,
               const unsigned long long begin,
               const unsigned long long end)
      {
        unsigned long long i = 0;
        points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
          if (i >= begin && i < end)
            add(p.position, fields.of(p), cell);
          ++i;
        });
      }

      void
      add_body(const std::vector<BodyPoint> &points, const RigidBody &body)
      {
        for (const BodyPoint &p : points)
          add(body.shape().moved(p.position, body.motion().travel()),
              fields.of(p, body),
              p.cell);
      }

      Particles::DataOut<2>
      build()
      {
        handler.update_cached_numbers();
        Particles::DataOut<2> data_out;
        data_out.build_patches(handler, fields.names, fields.interpretation);
        return data_out;
      }

    private:
      void
      add(const Point<2>            &position,
          const std::vector<double> &values,
          const unsigned int         cell)
      {
        // the place in the reference cell is not written
        handler.insert_particle(position,
                                Point<2>(),
                                n_points++,
                                grid.cell_iterator(cell),
                                ArrayView<const double>(values.data(),
                                                        values.size()));
      }

      const BackgroundGrid         &grid;
      const WrittenFields          &fields;
      Particles::ParticleHandler<2> handler;
      types::particle_index         n_points = 0; // numbers are not written
    };

    /** The cells with their data; the vertices must have been written. */
    class CellFields
    {
    public:
      CellFields(const BackgroundGrid &grid, const MaterialPoints &points)
        : material_id(grid.triangulation().n_active_cells())
        , zone(material_id.size())
        , material_points(material_id.size())
      {
        for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
          {
            const auto i   = index(grid, cell);
            material_id[i] = grid.is_rigid(cell) ? 1. : 0.;
            zone[i]        = static_cast<unsigned int>(grid.zone(cell));
          }
        points.for_each([&](const MaterialPoint &, const unsigned int cell) {
          material_points[index(grid, cell)] += 1.;
        });
      }

      DataOut<2>
      patches(const BackgroundGrid &grid) const
      {
        DataOut<2> data_out;
        const auto cells = DataOut<2>::DataVectorType::type_cell_data;
        data_out.attach_triangulation(grid.triangulation());
        data_out.add_data_vector(material_id, "material_id", cells);
        data_out.add_data_vector(zone, "zone", cells);
        data_out.add_data_vector(material_points, "material_points", cells);
        data_out.build_patches(grid.mapping());
        return data_out;
      }

    private:
      static unsigned int
      index(const BackgroundGrid &grid, const unsigned int cell)
      {
        return grid.cell_iterator(cell)->active_cell_index();
      }

      Vector<double> material_id, zone, material_points;
    };

    /**
     * Write "<name>.vtu", or several pieces and "<name>.pvtu" where there are
     * several ranks or pieces of a rank, and return the name of what the series
     * shall list. make(i) gives the i-th piece of this rank, of @p n_pieces on
     * each; one at a time is in memory. All ranks throw if one cannot write.
     */
    template <typename MakePiece>
    std::string
    write_vtu(const std::string &directory,
              const std::string &name,
              const double       time,
              const MPI_Comm     communicator,
              const unsigned int n_pieces,
              const MakePiece   &make)
    {
      const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
      const unsigned int n =
        n_pieces * Utilities::MPI::n_mpi_processes(communicator);
      const auto file = [&](const unsigned int i) {
        return name + (n > 1 ? "." + to_text(i) : "") + ".vtu";
      };
      int error = 0;
      for (unsigned int i = 0; i < n_pieces; ++i)
        {
          auto               piece = make(i);
          std::ostringstream text;
          piece.set_flags(Compat::vtk_flags(time));
          piece.write_vtu(text);
          if (error == 0)
            error = try_to_write(directory + "/" + file(rank * n_pieces + i),
                                 text.str());
          if (n > 1 && rank == 0 && i == 0 && error == 0)
            {
              std::vector<std::string> pieces;
              for (unsigned int k = 0; k < n; ++k)
                pieces.push_back(file(k));
              std::ostringstream record;
              piece.write_pvtu_record(record, pieces);
              error =
                try_to_write(directory + "/" + name + ".pvtu", record.str());
            }
        }
      error = Utilities::MPI::max(error, communicator);
      if (error != 0)
        report_unwritable(directory + "/" + file(rank * n_pieces),
                          error,
                          "the frames so far are kept");
      return n > 1 ? name + ".pvtu" : file(0);
    }



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
  } // namespace



  Visualization::Visualization(const std::string &directory)
    : directory(directory)
  {}



  void
  Visualization::resume(const double time)
  {
    point_frames = read_series(directory + "/points.pvd");
    grid_frames  = read_series(directory + "/grid.pvd");
    for (Frames *frames : {&point_frames, &grid_frames})
      while (!frames->empty() && before(time, frames->back().first))
        frames->pop_back();
  }



  double
  Visualization::fingerprint() const
  {
    Fingerprint result;
    for (const Frames *frames : {&point_frames, &grid_frames})
      for (const auto &[time, file] : *frames)
        result.add(to_text(time, 10) + " " + file + "\n"); // as in the file
    return result.number();
  }



  void
  Visualization::write_frame(BackgroundGrid               &grid,
                             const MaterialPoints         &points,
                             const RigidBody              &body,
                             const Soil                   &soil,
                             const std::vector<BodyPoint> &body_points,
                             const bool                    with_pore_pressure,
                             const double                  time)
  {
    grid.write_vertices();
    // after a restart the frame of this time may be there already
    drop_frames_from(time);
    const unsigned int number       = next_number();
    const MPI_Comm     communicator = grid.communicator();

    // deal.II takes about a kilobyte for each point that it writes
    constexpr unsigned long long points_per_piece = 100000;
    const unsigned int           n_pieces =
      Utilities::MPI::max(static_cast<unsigned int>(
                            points.n_points() / points_per_piece + 1),
                          communicator);
    const WrittenFields fields(soil, grid.circumference(), with_pore_pressure);
    const std::string   point_file =
      write_vtu(directory,
                numbered("points", number),
                time,
                communicator,
                n_pieces,
                [&](const unsigned int i) {
                  PointCloud cloud(grid, fields);
                  cloud.add_soil(points,
                                 i * points_per_piece,
                                 (i + 1) * points_per_piece);
                  if (i == 0)
                    cloud.add_body(body_points, body);
                  return cloud.build();
                });

    const CellFields  cells(grid, points);
    const std::string grid_file =
      write_vtu(directory,
                numbered("grid", number),
                time,
                communicator,
                1,
                [&](const unsigned int) { return cells.patches(grid); });

    point_frames.emplace_back(time, point_file);
    grid_frames.emplace_back(time, grid_file);
    if (grid.is_first_rank())
      {
        write_series("points.pvd", point_frames);
        write_series("grid.pvd", grid_frames);
      }
  }



  void
  Visualization::drop_frames_from(const double time)
  {
    for (Frames *frames : {&point_frames, &grid_frames})
      while (!frames->empty() && !before(frames->back().first, time))
        frames->pop_back();
  }



  unsigned int
  Visualization::next_number() const
  {
    unsigned int next = 0;
    for (const Frames *frames : {&point_frames, &grid_frames})
      for (const auto &frame : *frames)
        {
          const auto digits = frame.second.find('_') + 1;
          const auto number = std::strtoul(&frame.second[digits], nullptr, 10);
          next              = std::max<unsigned int>(next, number + 1);
        }
    return next;
  }



  void
  Visualization::write_series(const std::string &name,
                              const Frames      &frames) const
  {
    std::ostringstream text;
    DataOutBase::write_pvd_record(text, frames);
    write_atomically(directory + "/" + name, text.str());
  }
} // namespace CaissonMPM
