// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From the parameters of a scene, or a checkpoint, to the first step; and the
// parts of the ranks.
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/intervals.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/simulation/physics_text.h>
#include <caisson_mpm/simulation/scene_review.h>
#include <caisson_mpm/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace CaissonMPM
{
  using namespace dealii;

  void
  Simulation::register_totals()
  {
    totals.keep("time", clock.time);
    totals.keep("step", clock.step);
    totals.carry("force_on_body", force_on_body);
    totals.carry("since_adaptation", since_adaptation);
    totals.count("limiter_count", n_limited);
    totals.count("soil_into_body_m3", inflow);
    points.register_totals(totals);
    energy.register_totals(totals);
    schedule.register_totals(totals);
    time_step.register_totals(totals);
    recorder.register_totals(totals);
  }

  void
  Simulation::find_beginning()
  {
    if (is_restart)
      {
        const Checkpoint checkpoint(recorder.output_directory());
        checkpoint.check_fingerprint(physics() + soil.checksums_of_libraries());
        const auto number = [&](const std::string &name) {
          return number_named(name, checkpoint.info.state).value_or(0.);
        };
        begin_at({number("travel_at_start"),
                  number("velocity_at_start"),
                  number("load_at_start")},
                 checkpoint.info.state);
      }
    else if (installation.is_given())
      {
        installation.open(recorder.output_directory(),
                          physics() + soil.checksums_of_libraries());
        begin_at(installation.end_of_motion(),
                 installation.checkpoint().info.state);
      }
  }

  void
  Simulation::begin_at(const BodyMotion::InitialMotion &start,
                       const NamedNumbers              &state)
  {
    body.motion().begin_at(start);
    travel_of_mesh.emplace(-number_named("mesh_uplift", state).value_or(0.),
                           number_named("mesh_travel", state).value_or(0.));
  }

  void
  Simulation::check_parameters()
  {
    soil.check_parameters();
    body.shape().refine(lines.number_to_divide_by());
    // undrained sand keeps its volume, and fails like clay
    body.shape().enter_soil(soil.has_layer_with_friction() &&
                            water->traits().bulk_modulus == 0.);
    body.check_parameters();
    lines.check_parameters();
    generator.check_parameters();
    boundary_conditions.check_parameters(lines);
    water->check_parameters();
    for (const auto &force : nodal_forces)
      force->check_parameters();
    nodal_motion.choose_stress_update(time_step.has_inertia_tolerance());
    time_step.set_strain_from_new_velocities(
      !nodal_motion.settings().uses_musl());
    nodal_motion.settings().check_parameters();
    check_inertia_tolerance();
    const WaterTraits &traits = water->traits();
    if (traits.uses_permeability && body.motion().largest_mach_number())
      throw BadInput(
        "Rigid body/Largest Mach number slows the motion down, but "
        "Water/Level lets water flow, which takes its own time. "
        "Set it to unlimited, and reduce Rigid body/Velocity and "
        "Time/Mass scaling.");
    const bool strains_water = traits.follows_soil || traits.bulk_modulus > 0.;
    if (strains_water && !nodal_motion.settings().uses_mean_volume())
      throw BadInput("Water/Level is coupled or undrained, but Method/Mean "
                     "volume change is false: the points of a cell are "
                     "strained with the volume change that the pressure sees. "
                     "Set it to true.");
    schedule.check_parameters();
    stop_request.check_parameters();
    if (Kernels::select_kernels(instruction_set.c_str()) == nullptr)
      throw BadInput("Method/Instruction set = " + instruction_set +
                     ": this CPU does not have it. Set auto.");
    place_lines();
    nodal_motion.choose_flip_fraction(!soil.is_elastic_until_it_yields() ||
                                      strains_water ||
                                      body.motion().traits.follows_loads);
    if (body.shape().expands() && soil.has_walls())
      throw BadInput(
        "the expanding cylinder takes its friction from Rigid body/"
        "Friction angle of the outer wall. Remove the entries on "
        "walls from the layers in Soil.");
    recorder.check_parameters();
    kernels = Kernels::select_kernels(instruction_set.c_str());
  }

  void
  Simulation::check_inertia_tolerance() const
  {
    if (!time_step.has_inertia_tolerance())
      return;
    if (soil.mass_scaling() > 1.)
      throw BadInput("Time/Inertia tolerance chooses the mass scaling of each "
                     "cell. Remove Time/Mass scaling, or set the tolerance to "
                     "none.");
    if (body.shape().expands() || body.motion().usual_velocity() == 0.)
      throw BadInput(
        "Time/Inertia tolerance refers to the speed of a body that "
        "is pushed into the soil with a given velocity. Set it to "
        "none, and choose Time/Mass scaling.");
  }

  void
  Simulation::place_lines()
  {
    auto [up, down] = schedule.travel_to_hold();
    if (travel_of_mesh)
      {
        const auto &[mesh_up, mesh_down] = *travel_of_mesh;
        if (mesh_up == mesh_down && up != down)
          throw BadInput(
            "the body rested in the run that wrote the checkpoint, and its mesh "
            "has no row that ends at Grid/Moving zone below tip: it cannot move "
            "with the body. Begin without the checkpoint, with a Rigid body/"
            "Velocity table that rests at first.");
        up   = std::min(up, mesh_up);
        down = std::max(down, mesh_down);
      }
    lines.place(body.shape(), soil, down, -up);
    soil.divide(lines.row_lines());
  }

  void
  Simulation::make_mesh()
  {
    materials = soil.kernel_materials(water->traits().bulk_modulus);
    slow_body_down();
    body.motion().register_totals(totals);
    body.motion().start();
    grid.create_mesh();
    body.compute_weight(grid.mass_of_body(body.density), soil);
    recorder.register_walls(totals);
    grid.move_to(body.motion().travel());
    points.keep_user_state(soil.n_user_state(), soil.user_materials());
    for (const auto &force : nodal_forces)
      force->initialize(soil.mass_scaling());
  }

  void
  Simulation::slow_body_down()
  {
    const auto mach_number = body.motion().largest_mach_number();
    if (!mach_number)
      return;
    double slowest_wave = slowest_and_fastest_wave().first;
    if (time_step.has_inertia_tolerance())
      slowest_wave /= std::sqrt(time_step.inertia_for(
        stress_over_inertia_at_tip(body.motion().beginning().travel)));
    const double factor =
      body.motion().usual_velocity() / (*mach_number * slowest_wave);
    if (factor > 1.)
      body.motion().slow_down(factor);
  }

  RunCost
  Simulation::estimate_cost()
  {
    constexpr double       enough_seconds = .3;
    constexpr unsigned int few_steps = 4, enough_steps = 20;
    RunCost                cost;
    cost.grid      = lines.description();
    cost.n_points  = Utilities::MPI::sum<unsigned long>(points.n_points(),
                                                       grid.communicator());
    cost.n_frames  = schedule.n_frames();
    cost.splits    = generator.splits_and_merges() && body.shape().exists();
    cost.step_size = time_step.step_size();
    cost.end   = schedule.end_description() + ", by " + schedule.entry_of_end();
    cost.limit = time_step.reason();
    cost.n_steps = number_of_steps();

    unsigned int n     = 0;
    double       first = 0.;
    // of the processor: others who work beside do not count. dealii::Timer has
    // user time only, which Linux counts in ticks: 0 in a short process
    std::clock_t start   = std::clock();
    const auto   seconds = [&]() {
      return Utilities::MPI::sum(static_cast<double>(std::clock() - start),
                                 grid.communicator()) /
             CLOCKS_PER_SEC / grid.n_ranks();
    };
    try
      {
        while (n < enough_steps && !schedule.is_finished() &&
               (n < few_steps || seconds() < enough_seconds))
          {
            advance();
            if (++n > 1)
              continue;
            first = seconds(); // longer than others: nothing is in the cache
            start = std::clock();
          }
        cost.seconds_per_step = n > 1 ? seconds() / (n - 1) : first;
      }
    catch (const RunFailure &error)
      {
        cost.failure =
          "the first steps of the run fail: " + std::string(error.what());
        // the library is input; no other cause than its own failure
        if (soil.n_user_state() > 0 && soil.cause_in_user_materials().empty())
          throw BadInput(cost.failure);
      }
    cost.n_ranks = grid.n_ranks();
    cost.peak_bytes =
      Utilities::MPI::sum(peak_memory_bytes(), grid.communicator());
    constexpr double long_run = 60.; // s
    if (cost.seconds().second > long_run)
      cost.savings = ways_to_save(cost.n_points);
    return cost;
  }

  std::vector<std::string>
  Simulation::ways_to_save(const double n_points) const
  {
    constexpr double         usual_scaling = 100., far_fewer = .8;
    std::vector<std::string> result;
    if (body.shape().exists() && !generator.splits_and_merges())
      if (const double n = generator.n_points_that_split(lines, body.shape());
          n < far_fewer * n_points)
        result.push_back("Material points/Split and merge = true begins with " +
                         to_text(n, 8) + " points instead of " +
                         to_text(n_points, 8) +
                         ", and makes more where they are needed");
    const double scaling = soil.mass_scaling();
    const auto   cells   = body.shape().cells_across_wall();
    if (body.shape().exists() && !body.motion().traits.follows_loads &&
        !water->traits().follows_soil && scaling < usual_scaling &&
        !time_step.has_inertia_tolerance())
      result.push_back("Time/Mass scaling = " + to_text(usual_scaling) +
                       " takes " +
                       to_text(std::sqrt(scaling / usual_scaling), 2) +
                       " times as many steps as " + to_text(scaling));
    if (cells > 0 && lines.tree().root_size() == 1)
      result.push_back("Grid/Refinement levels = 1 halves cells only at the "
                       "tip, as in prm/jack_refined.prm");
    if (cells > 2)
      result.push_back("Rigid body/Cells across the wall = 2 instead of " +
                       to_text(cells) +
                       " makes the steps longer; the error grows");
    return result;
  }

  void
  Simulation::name_unused_entries(ParameterOrigins &origins) const
  {
    body.name_unused_entries(origins);
    lines.name_unused_entries(origins);
    soil.name_unused_entries(origins);
    generator.name_unused_entries(origins);
    boundary_conditions.name_unused_entries(origins);
    water->name_unused_entries(origins);
    nodal_motion.settings().name_unused_entries(origins);
    schedule.name_unused_entries(origins);
  }

  void
  Simulation::set_up(const CommandLine      &command_line,
                     const ParameterOrigins &origins)
  {
    is_restart = command_line.restart;
    overwrites = command_line.overwrite;
    recorder.set_output_directory(command_line.output_directory);
    soil.load_libraries(origins);
    find_beginning();
    check_parameters();
    recorder.describe(command_line.parameter_file,
                      command_line.text,
                      fingerprint_of(changed_physics()),
                      installation.directory(),
                      *kernels);
    recorder.report_progress("the mesh of " + lines.description());
    make_mesh();
    recorder.report_progress(is_restart || installation.is_given() ?
                               "the material points of the checkpoint" :
                               "the material points");
    if (is_restart)
      resume();
    else
      start();
    time_step.initialize(*kernels, grid, points, soil, materials);
    check_initial_speed();
    recorder.try_observations();
    check_number_of_steps();
    clock.step_size = schedule.shorten(time_step.step_size());
  }

  void
  Simulation::check_initial_speed() const
  {
    const double fastest_wave  = slowest_and_fastest_wave().second;
    double       fastest_point = 0.;
    points.for_each_motion([&](const Point<2> &,
                               const Vector2 &velocity,
                               const double,
                               const unsigned int,
                               const unsigned int) {
      fastest_point = std::max(fastest_point, velocity.norm());
    });
    fastest_point = Utilities::MPI::max(fastest_point, grid.communicator());
    if (!is_restart && fastest_point > fastest_wave)
      throw BadInput("Soil/Initial velocity reaches " +
                     to_text(fastest_point, 4) +
                     " m/s, more than the wave speed of the soil, " +
                     to_text(fastest_wave, 4) +
                     " m/s: in a step, points would pass whole cells. Reduce "
                     "it.");
  }

  void
  Simulation::check_number_of_steps() const
  {
    constexpr double largest = 1e14; // a step then still changes the time
    if (std::isfinite(schedule.end_time()) && number_of_steps() > largest)
      throw BadInput("the run would take " + to_text(number_of_steps(), 2) +
                     " steps of " + to_text(time_step.step_size(), 3) +
                     " s, and never end. The step is limited by " +
                     time_step.reason() +
                     ". Check Time/Time step, and the stiffness and density of "
                     "the soil." +
                     soil.cause_in_user_materials());
  }

  double
  Simulation::number_of_steps() const
  {
    const double left = schedule.steps_left(time_step.step_size());
    if (!body.shape().exists() || !std::isfinite(left))
      return left;
    // the inertia grows with the stress at the tip, and so may the stiffness
    constexpr unsigned int n_parts = 200;
    const bool             grows   = time_step.has_inertia_tolerance();
    const double           start   = body.motion().travel(),
                 way               = schedule.travel_to_hold().second - start,
                 speed = wave_speed(soil.material_at(-body.penetration()));
    double sum         = 0.;
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        const double travel = start + (part + .5) / n_parts * way;
        sum +=
          1. / time_step.growth_of_step(grows ?
                                          stress_over_inertia_at_tip(travel) :
                                          0.,
                                        wave_speed_under_tip(travel) / speed);
      }
    return std::ceil(left * sum / n_parts);
  }

  double
  Simulation::wave_speed_under_tip(const double travel) const
  {
    // What soil bears under a tip over what it bears far from it: 40 in loose
    // and 120 in dense sand; the modulus follows its root.
    constexpr double concentration = 80.;
    const double     tip =
      std::min(body.motion().travel() - travel - body.penetration(), 0.);
    const unsigned int i     = soil.material_at(tip);
    const double       known = wave_speed(i);
    if (!soil.material(i).stiffness_varies())
      return known;
    Stress stress = soil.initial_stress(Point<2>(0., tip));
    for (double &s : stress)
      s *= concentration;
    const double modulus = soil.material(i).modulus_to_come(
      p_wave_modulus(materials[i], stress, soil.material(i).void_ratio()));
    return std::max(known, std::sqrt(modulus / soil.inertial_density(i)));
  }

  double
  Simulation::wave_speed(const unsigned int material) const
  {
    return std::sqrt(materials[material].p_wave_modulus /
                     soil.inertial_density(material));
  }

  std::pair<double, double>
  Simulation::slowest_and_fastest_wave() const
  {
    std::vector<double> speeds;
    for (unsigned int i = 0; i < soil.n_materials(); ++i)
      speeds.push_back(wave_speed(i));
    const auto found = std::minmax_element(speeds.begin(), speeds.end());
    return {*found.first, *found.second};
  }

  FaceStrength
  Simulation::strength_of_face(const ContactFace &face) const
  {
    FaceStrength strength = strength_of(body.surface(), face);
    if (face.surface != inner_wall && face.surface != outer_wall)
      return strength;
    const double z = .5 * (grid.z_of(face.nodes[0]) + grid.z_of(face.nodes[1]));
    const SoilMaterial &m = soil.material(soil.material_at(z));
    if (m.wall_friction_angle)
      strength.friction = std::tan(radians(*m.wall_friction_angle));
    if (m.wall_adhesion)
      strength.adhesion = *m.wall_adhesion;
    return strength;
  }

  double
  Simulation::imbalance(const std::vector<unsigned int> &costs) const
  {
    double own = 0.;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        own += costs[index_of(grid.global_number(cell))];
    const auto work = Utilities::MPI::min_max_avg(own, grid.communicator());
    return work.max / work.avg;
  }

  void
  Simulation::balance()
  {
    const auto costs = points.cell_costs();
    // To repartition the mesh takes about as long as this many steps.
    constexpr double steps_of_repartition = 30.;
    // A part is made of whole cells: it may be impossible to do better than
    // after the last repartition.
    lost_steps +=
      Intervals::balance * std::max(0., imbalance(costs) - least_imbalance);
    if (lost_steps > steps_of_repartition)
      repartition(costs);
  }

  void
  Simulation::repartition(const std::vector<unsigned int> &costs)
  {
    std::vector<unsigned int> of_all_cells(costs.size());
    Utilities::MPI::sum(costs, grid.communicator(), of_all_cells);
    points.prepare_for_repartition();
    grid.repartition(costs);
    grid.move_to(body.motion().travel());
    points.unpack_after_repartition();
    recorder.count_repartition();
    // the points forget what moved and yielded: not by their costs now
    least_imbalance = imbalance(of_all_cells);
    lost_steps      = 0.;
  }

  void
  Simulation::start()
  {
    if (installation.is_given())
      return continue_from_installation();
    generator.generate(grid, body.shape(), soil, points);
    if (grid.n_ranks() > 1)
      repartition(points.cell_costs());
    energy.start(compute_point_energies(points, materials, grid));
    schedule.start();
  }

  void
  Simulation::resume()
  {
    const Checkpoint checkpoint(recorder.output_directory());
    checkpoint.read_points(grid, points);
    const NamedNumbers &state   = checkpoint.info.state;
    const std::string   missing = totals.resume(state, grid.is_first_rank());
    if (!missing.empty())
      throw BadInput("the checkpoint in " + recorder.output_directory() +
                     " lacks the entry " + missing +
                     ". Start the run again in another directory.");
    timer.resume(state);
    recorder.remember(checkpoint.info.warnings);
    grid.move_to(body.motion().travel());
    scatter(grid, checkpoint.read_fields(), water->fields());
    if (grid.n_ranks() > 1)
      repartition(points.cell_costs());
    schedule.resume();
  }

  void
  Simulation::continue_from_installation()
  {
    const Checkpoint &checkpoint = installation.checkpoint();
    checkpoint.read_points(grid, points);
    totals.take_over(checkpoint.info.state);
    if (grid.n_ranks() > 1)
      repartition(points.cell_costs());
    water->continue_after(installation.water_level(), checkpoint.read_fields());
    energy.start(compute_point_energies(points, materials, grid));
    schedule.start();
  }

  void
  Simulation::review(ParameterOrigins &origins) const
  {
    SceneReview(*this,
                slowest_and_fastest_wave().first,
                number_of_steps(),
                origins)
      .all();
    const double reach = body.shape().exists() && !body.shape().expands() ?
                           lines.total_travel() - body.shape().bottom() :
                           lines.depth();
    for (const auto &limits : {soil.known_limits(reach),
                               nodal_motion.settings().known_limits(),
                               time_step.known_limits(),
                               water->report(materials).known_limits})
      for (const std::string &limit : limits)
        origins.add_limit(limit);
  }
} // namespace CaissonMPM
