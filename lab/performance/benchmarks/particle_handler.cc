// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What deal.II's Particles::ParticleHandler takes for what the program does
// with its own code outside the loop over points: inserting, sorting after a
// motion, telling neighbors, changing the parts of the ranks, checkpoints. The
// points are those of a scene, in the mesh of the scene. Of every section the
// fastest of some repetitions is printed, as the time of the slowest rank, and
// whether the points of a cell keep their order.
//
//   mpirun -n RANKS particle_handler prm/jack.prm [TRAVEL]
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/domain/point_generator.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <deal.II/grid/filtered_iterator.h>
#include <deal.II/grid/grid_tools.h>

#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

using namespace CaissonMPM;
using dealii::Point;

namespace
{
  constexpr unsigned int n_repetitions = 9;
  // all fields and the material
  constexpr unsigned int n_properties = n_point_fields + 1;

  using Handler       = dealii::Particles::ParticleHandler<2>;
  using Triangulation = BackgroundGrid::Triangulation;
  using IdsByCell     = std::map<unsigned int, std::vector<double>>;

  /** The domain of a scene, without what moves it. */
  struct Scene
  {
    explicit Scene(const std::string &file, const double travel)
      : grid(lines, MPI_COMM_WORLD)
      , points(grid)
    {
      auto &prm = dealii::ParameterAcceptor::prm;
      prm.parse_input(file, "", true);
      dealii::ParameterAcceptor::parse_all_parameters(prm);
      lines.place(body.shape(), soil, travel);
      grid.create_mesh();
    }

    GridLines      lines;
    Soil           soil;
    RigidBody      body;
    PointGenerator generator;
    BackgroundGrid grid;
    MaterialPoints points;
  };

  /** Return the seconds of the slowest rank, the least of the repetitions;
   * @p prepare is not counted. */
  double
  seconds(const std::function<void()> &prepare,
          const std::function<void()> &action)
  {
    double least = 1e300;
    for (unsigned int i = 0; i < n_repetitions; ++i)
      {
        prepare();
        MPI_Barrier(MPI_COMM_WORLD);
        const double begin = MPI_Wtime();
        action();
        least = std::min(least,
                         dealii::Utilities::MPI::max(MPI_Wtime() - begin,
                                                     MPI_COMM_WORLD));
      }
    return least;
  }

  bool
  is_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  /** Return the memory of all ranks. Units: MB. */
  double
  memory()
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    return dealii::Utilities::MPI::sum<double>(stats.VmRSS, MPI_COMM_WORLD) /
           1024.;
  }

  void
  print(const char *what, const double ours, const double theirs)
  {
    if (is_first_rank())
      std::printf("%-34s %10.2f %10.2f %8.1f\n",
                  what,
                  1e3 * ours,
                  1e3 * theirs,
                  theirs / ours);
  }

  void
  say(const char *what, const bool yes)
  {
    if (dealii::Utilities::MPI::min(yes ? 1 : 0, MPI_COMM_WORLD) == 0)
      {
        if (is_first_rank())
          std::printf("%s: no\n", what);
      }
    else if (is_first_rank())
      std::printf("%s: yes\n", what);
  }

  std::vector<double>
  properties_of(const MaterialPoint &point)
  {
    std::vector<double> values;
    for_each_value(point, [&](const PointField &, const double x) {
      values.push_back(x);
    });
    values.push_back(point.material);
    return values;
  }

  void
  insert(Scene &scene, const Triangulation &mesh, Handler &handler)
  {
    handler.initialize(mesh, scene.grid.mapping(), n_properties);
    scene.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
      const auto values = properties_of(p);
      handler.insert_particle(
        p.position,
        to_reference(scene.grid.geometry(cell), p.position),
        p.id,
        {&mesh, 0, int(index_of(scene.grid.global_number(cell)))},
        dealii::ArrayView<const double>(values.data(), values.size()));
    });
    handler.update_cached_numbers();
  }

  /** Return the points of a handler, as the program holds them. */
  std::vector<TravelingPoint>
  points_of(const Handler &handler, const Triangulation &mesh)
  {
    std::vector<TravelingPoint> result;
    for (const auto &particle : handler)
      {
        TravelingPoint p;
        p.cell = GlobalCell(particle.get_surrounding_cell(mesh)->index());
        unsigned int i      = 0;
        const auto   values = particle.get_properties();
        for_each_value(p.point,
                       [&](const PointField &, double &x) { x = values[i++]; });
        p.point.material = values[i];
        result.push_back(p);
      }
    return result;
  }

  /** Return the numbers of the points in each cell, in their order. */
  IdsByCell
  ids_of(const std::vector<TravelingPoint> &points)
  {
    IdsByCell ids;
    for (const TravelingPoint &p : points)
      ids[index_of(p.cell)].push_back(p.point.id);
    return ids;
  }

  /** Create the mesh of the scene again, for a handler of its own. */
  void
  copy_mesh(const GridLines &lines, Triangulation &mesh)
  {
    const unsigned int    n = lines.n_columns() + 1;
    std::vector<Point<2>> places;
    for (unsigned int j = 0; j <= lines.n_rows(); ++j)
      for (unsigned int i = 0; i < n; ++i)
        places.push_back(lines.node_start(i, j));
    std::vector<dealii::CellData<2>> cells(lines.n_cells());
    for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const unsigned int corner =
          lines.row_of(GlobalCell(c)) * n + lines.column_of(GlobalCell(c));
        cells[c].vertices = {corner, corner + 1, corner + n, corner + n + 1};
      }
    mesh.create_triangulation(places, cells, dealii::SubCellData());
  }

  // ------------------------------------------------------------ sections

  void
  compare_insertion(Scene &scene, const Triangulation &mesh)
  {
    const double before = memory();
    Handler      handler;
    insert(scene, mesh, handler);
    const double of_handler = memory() - before;
    if (is_first_rank())
      std::printf("memory of the handler: %.0f bytes per point\n",
                  of_handler * 1048576. / handler.n_global_particles());

    std::vector<TravelingPoint> all;
    const auto                  take = [&]() { all = scene.points.take_all(); };
    const double                ours =
      seconds(take, [&]() { scene.points.redistribute(all); });
    const double theirs = seconds([]() {},
                                  [&]() {
                                    Handler other;
                                    insert(scene, mesh, other);
                                  });
    print("insert, cells known", ours, theirs);

    std::vector<Point<2>>            places;
    std::vector<std::vector<double>> values;
    for (const auto &particle : handler)
      {
        places.push_back(particle.get_location());
        const auto p = particle.get_properties();
        values.emplace_back(p.begin(), p.end());
      }
    const auto boxes = dealii::Utilities::MPI::all_gather(
      MPI_COMM_WORLD,
      dealii::GridTools::compute_mesh_predicate_bounding_box(
        mesh, dealii::IteratorFilters::LocallyOwnedCell()));
    Handler      found;
    const double begin = MPI_Wtime();
    found.initialize(mesh, scene.grid.mapping(), n_properties);
    found.insert_global_particles(places, boxes, values);
    print("insert, cells to be found",
          ours,
          dealii::Utilities::MPI::max(MPI_Wtime() - begin, MPI_COMM_WORLD));

    const double to_blocks =
      seconds([&]() { scene.points.take_all(); },
              [&]() { scene.points.redistribute(points_of(handler, mesh)); });
    print("from a handler to blocks", ours, to_blocks);
  }

  /** Return how far to move a point of a cell, to and fro: not at the ends of
   * the mesh. Units: m. */
  double
  shift(const BackgroundGrid &grid, const unsigned int cell, const double id)
  {
    return grid.at_side(cell, 2) || grid.at_side(cell, 3) ?
             0. :
             .3 * (std::fmod(id * .6180339887498949, 1.) - .5) *
               grid.geometry(cell).height_left;
  }

  void
  list_leaving(Scene &scene)
  {
    auto &result     = scene.points.update_result();
    auto  view       = scene.points.view();
    result.n_leaving = 0;
    for (unsigned int i = 0; i < view.n_active_cells; ++i)
      {
        const unsigned int cell = view.active_cells[i];
        const auto        &g    = scene.grid.geometry(cell);
        for (int b = view.first_block[cell]; b >= 0; b = view.headers[b].next)
          for (int lane = 0; lane < view.headers[b].count; ++lane)
            {
              const auto x = to_reference(g,
                                          Point<2>(view.blocks[b].r[lane],
                                                   view.blocks[b].z[lane]));
              if (x[0] < 0. || x[0] > 1. || x[1] < 0. || x[1] > 1.)
                result.leaving[result.n_leaving++] = {cell, b, lane};
            }
      }
  }

  void
  compare_sorting(Scene &scene, const Triangulation &mesh)
  {
    double     sign = 1.;
    const auto move = [&]() {
      auto view = scene.points.view();
      for (unsigned int i = 0; i < view.n_active_cells; ++i)
        {
          const unsigned int cell = view.active_cells[i];
          for (int b = view.first_block[cell]; b >= 0; b = view.headers[b].next)
            for (int lane = 0; lane < view.headers[b].count; ++lane)
              view.blocks[b].z[lane] +=
                sign * shift(scene.grid, cell, view.histories[b].id[lane]);
        }
      list_leaving(scene);
      sign = -sign;
    };
    Handler handler;
    insert(scene, mesh, handler);
    const double ours = seconds(move, [&]() { scene.points.relocate(); });

    double     back      = 1.;
    const auto move_them = [&]() {
      for (auto &particle : handler)
        {
          const unsigned int local = scene.grid.local_number(
            GlobalCell(particle.get_surrounding_cell(mesh)->index()));
          auto place = particle.get_location();
          place[1] += back * shift(scene.grid, local, particle.get_id());
          particle.set_location(place);
        }
      back = -back;
    };
    const double theirs = seconds(move_them, [&]() {
      handler.sort_particles_into_subdomains_and_cells();
    });
    print("sort after a motion", ours, theirs);
    move();
    const double n_left = dealii::Utilities::MPI::sum<double>(
      scene.points.update_result().n_leaving, MPI_COMM_WORLD);
    scene.points.relocate();
    if (is_first_rank())
      std::printf("points that changed their cell: %.1f %%\n",
                  100. * n_left / handler.n_global_particles());
    if (scene.grid.n_ranks() == 1)
      return;
    handler.exchange_ghost_particles(true);
    const double tell =
      seconds([&]() { scene.points.update_result().n_leaving = 0; },
              [&]() { scene.points.relocate(); });
    print("tell neighbors of a step",
          tell,
          seconds([]() {}, [&]() { handler.update_ghost_particles(); }));
  }

  /** Return costs that move the border between the ranks. */
  std::vector<unsigned int>
  other_costs(const Scene &scene, const unsigned int variant)
  {
    auto costs = scene.points.cell_costs();
    for (unsigned int c = 0; c < costs.size(); ++c)
      if ((scene.lines.row_of(GlobalCell(c)) < scene.lines.n_rows() / 2) ==
          (variant % 2 == 0))
        costs[c] *= 4;
    return costs;
  }

  using Costs = std::vector<unsigned int>;

  /** Return the seconds of action() while the mesh takes its parts by costs. */
  double
  seconds_with(Triangulation               &mesh,
               const Costs                 &costs,
               const std::function<void()> &action)
  {
    const auto weight = mesh.signals.weight.connect(
      [&](const auto &cell, const auto) { return costs[cell->index()]; });
    MPI_Barrier(MPI_COMM_WORLD);
    const double begin = MPI_Wtime();
    action();
    const double time = MPI_Wtime() - begin;
    weight.disconnect();
    return dealii::Utilities::MPI::max(time, MPI_COMM_WORLD);
  }

  /** Return the seconds that our points take when the parts change. */
  double
  seconds_of_points(Scene &scene, const Costs &costs)
  {
    double     begin = MPI_Wtime();
    const auto all   = scene.points.take_all();
    double     time  = MPI_Wtime() - begin;
    scene.grid.repartition(costs);
    MPI_Barrier(MPI_COMM_WORLD);
    begin = MPI_Wtime();
    scene.points.redistribute(all);
    time += MPI_Wtime() - begin;
    return dealii::Utilities::MPI::max(time, MPI_COMM_WORLD);
  }

  /** See whether cells that stayed on their rank have their points, in the same
   * order. */
  void
  compare_cells(const IdsByCell &before, const IdsByCell &after)
  {
    bool in_order = true, all_are_there = true;
    for (const auto &[cell, ids] : after)
      if (before.count(cell) > 0)
        {
          auto now = ids, old = before.at(cell);
          in_order = in_order && now == old;
          std::sort(now.begin(), now.end());
          std::sort(old.begin(), old.end());
          all_are_there = all_are_there && now == old;
        }
    say("handler keeps the points of a cell", all_are_there);
    say("handler keeps their order", in_order);
  }

  void
  compare_repartition(Scene &scene, Triangulation &mesh)
  {
    Handler handler;
    insert(scene, mesh, handler);
    const auto    before = ids_of(points_of(handler, mesh));
    Triangulation empty(MPI_COMM_WORLD);
    copy_mesh(scene.lines, empty);
    std::array<Costs, 2> costs;
    for (const unsigned int variant : {0, 1})
      {
        costs[variant] = other_costs(scene, variant);
        dealii::Utilities::MPI::max(costs[variant],
                                    MPI_COMM_WORLD,
                                    costs[variant]);
      }
    double ours = 1e300, theirs = 1e300, of_mesh = 1e300;
    for (unsigned int i = 0; i < n_repetitions; ++i)
      {
        const Costs &now = costs[i % 2];
        theirs           = std::min(theirs, seconds_with(mesh, now, [&]() {
                            handler.prepare_for_coarsening_and_refinement();
                            mesh.repartition();
                            handler.unpack_after_coarsening_and_refinement();
                          }));
        of_mesh =
          std::min(of_mesh,
                   seconds_with(empty, now, [&]() { empty.repartition(); }));
        ours = std::min(ours, seconds_of_points(scene, now));
      }
    print("change the parts, points only", ours, theirs - of_mesh);
    compare_cells(before, ids_of(points_of(handler, mesh)));
  }

  void
  compare_checkpoints(Scene &scene, Triangulation &mesh)
  {
    const std::string name = "/tmp/particle_handler_benchmark";
    const auto        all =
      dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD,
                                         scene.points.n_points());
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned long n = std::accumulate(all.begin(), all.end(), 0ul),
                        row =
                          std::accumulate(all.begin(), all.begin() + rank, 0ul);
    const double write =
      seconds([]() {},
              [&]() {
                std::vector<TravelingPoint> points;
                scene.points.for_each(
                  [&](const MaterialPoint &p, const unsigned int cell) {
                    points.push_back({scene.grid.global_number(cell), p});
                  });
                PointFile file(name + ".h5",
                               PointFile::Access::create,
                               n,
                               MPI_COMM_WORLD);
                file.write(row, points);
                file.close();
              });
    const double read = seconds([]() {},
                                [&]() {
                                  PointFile file(name + ".h5",
                                                 PointFile::Access::read,
                                                 n,
                                                 MPI_COMM_WORLD);
                                  file.read(row, scene.points.n_points());
                                  file.close();
                                });
    Handler      handler;
    insert(scene, mesh, handler);
    const double save = seconds([]() {},
                                [&]() {
                                  handler.prepare_for_serialization();
                                  mesh.save(name);
                                });
    print("write a checkpoint", write, save);
    Triangulation loaded(MPI_COMM_WORLD);
    copy_mesh(scene.lines, loaded);
    Handler      other(loaded, scene.grid.mapping(), n_properties);
    const double begin = MPI_Wtime();
    loaded.load(name);
    other.deserialize();
    print("read a checkpoint",
          read,
          dealii::Utilities::MPI::max(MPI_Wtime() - begin, MPI_COMM_WORLD));
    say("handler reads all points",
        other.n_global_particles() == handler.n_global_particles());
    say("handler reads them in their order",
        ids_of(points_of(other, loaded)) == ids_of(points_of(handler, mesh)));
  }
} // namespace

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 2)
    {
      std::printf("usage: particle_handler SCENE.prm [TRAVEL]\n");
      return 1;
    }
  Scene        scene(argv[1], argc > 2 ? std::atof(argv[2]) : 6.);
  const double before = memory();
  const double begin  = MPI_Wtime();
  scene.generator.generate(scene.grid,
                           scene.body.shape(),
                           scene.soil,
                           scene.points);
  const double time = MPI_Wtime() - begin, used = memory() - before;
  scene.grid.write_vertices();
  const auto n =
    dealii::Utilities::MPI::sum<unsigned long>(scene.points.n_points(),
                                               MPI_COMM_WORLD);
  if (is_first_rank())
    {
      std::printf("%lu points, %u cells, %u ranks; generated in %.1f ms\n",
                  n,
                  scene.lines.n_cells(),
                  scene.grid.n_ranks(),
                  1e3 * time);
      std::printf("memory of the blocks: %.0f bytes per point\n",
                  used * 1048576. / n);
      std::printf(
        "%-34s %10s %10s %8s\n", "milliseconds", "blocks", "handler", "ratio");
    }
  Triangulation mesh(MPI_COMM_WORLD);
  copy_mesh(scene.lines, mesh);
  compare_insertion(scene, mesh);
  compare_sorting(scene, mesh);
  compare_checkpoints(scene, mesh);
  if (scene.grid.n_ranks() > 1)
    compare_repartition(scene, mesh);
}
