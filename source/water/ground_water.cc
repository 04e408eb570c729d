// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/cell_map.h>
#include <caisson_mpm/water/ground_water.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // Heights of the mudline are looked at this many steps apart.
    constexpr unsigned int steps_between_looks = 10;

    // Above this, inertia changes the pressure of a transient by more than half
    // a per cent.
    constexpr double largest_inertia = .02;

    // Permeability and density of coupled soil are found this many steps apart.
    constexpr unsigned int steps_between_properties = 20;

    // The heave is known when the flow is found; the pump sees it smoothed.
    constexpr double time_of_heave = 1.; // s
  } // namespace

  GroundWater::GroundWater(BackgroundGrid       &grid,
                           const MaterialPoints &points,
                           const Soil           &soil,
                           const RigidBody      &body)
    : ParameterAcceptor("/Water")
    , grid(grid)
    , points(points)
    , soil(soil)
    , body(body)
  {
    add_choice(*this,
               "Level",
               level,
               {{"drained", Level::drained},
                {"seepage", Level::seepage},
                {"coupled", Level::coupled}},
               "The pore water has no excess pressure (drained), flows "
               "steadily under the suction beneath the lid of a caisson "
               "(seepage), or has the pressure that follows from the motion of "
               "the soil (coupled). Units: none.");
    add_parameter("Renewal",
                  renewal,
                  "The flow is found anew when the body has moved, or the "
                  "mudline changed, by this share of a cell. Units: none.",
                  prm,
                  Patterns::Double(1e-6, 1.));
    add_parameter("Kept pressure",
                  kept_pressure,
                  "A coupled step begins with this share of the old pressure. "
                  "With less, soil that conducts badly drains by error; with "
                  "1, the pressure oscillates from node to node. Units: none.",
                  prm,
                  Patterns::Double(0., 1.));
    add_parameter("Time compression",
                  time_compression,
                  "The scene runs this many times faster than what it stands "
                  "for, and a coupled run multiplies all permeabilities with "
                  "it, so that as much water flows. Units: none.",
                  prm,
                  Patterns::Double(1e-9));
    add_parameter("Drained surface",
                  sides.surface,
                  "The free surface of the soil outside keeps the pressure of "
                  "the open water; otherwise nothing flows through it. Units: "
                  "none.");
    add_parameter("Drained outer side",
                  sides.outer,
                  "The far side of the domain keeps the pressure of the open "
                  "water; otherwise nothing flows through it. Units: none.");
    add_parameter("Drained bottom",
                  sides.bottom,
                  "The bottom of the domain keeps the pressure of the open "
                  "water; otherwise nothing flows through it. Units: none.");
    add_parameter("Bottom pressure",
                  bottom_text,
                  "A drained bottom has this excess pressure in a coupled run, "
                  "as an expression in the time t. Units: Pa.");
  }

  void
  GroundWater::check_parameters() const
  {
    if (!acts())
      return;
    suction.check_parameters();
    bottom_expression();
    if (!soil.is_submerged() || soil.unit_weight_of_water() <= 0.)
      throw BadInput("Water/Level is not drained, but the soil is dry: set "
                     "Soil/Submerged = true, Soil/Fluid density and a Soil/"
                     "Gravity that points downward.");
    if (!has_lid())
      {
        if (!is_coupled())
          throw BadInput(
            "Water/Level is seepage, but Rigid body/Kind is " +
            body.shape().name() +
            ": only a caisson has a lid with suction beneath it. Set Kind = "
            "caisson, or Level = drained or coupled.");
        return;
      }
    if (body.motion().follows_loads() && suction.is_result())
      throw BadInput(
        "Rigid body/Motion is " + body.motion().name() +
        ": the suction moves the body, and must be given. Set Water/Suction "
        "control = table, or Rigid body/Motion = prescribed, for which the "
        "suction is a result.");
    if (suction.moves_body() && !body.motion().follows_loads())
      throw BadInput(
        "Water/Suction control is flow, but Rigid body/Motion is " +
        body.motion().name() +
        ": the velocity of the body sets the flow. Set Motion = "
        "lowered, or Suction control = required.");
    if (!grid.axisymmetric())
      throw BadInput(
        "Water/Level is not drained, but Grid/Geometry is plane strain: the "
        "lid of a caisson is round. Set Geometry = axisymmetric, or Level = "
        "drained.");
    if (body.shape().initial_depth() <= 0.)
      throw BadInput("Water/Level is not drained, and Rigid body/Initial "
                     "penetration is 0: water would flow in below the skirt. "
                     "Begin with a penetration of some cells.");
  }

  void
  GroundWater::name_unused_entries(ParameterOrigins &origins) const
  {
    if (is_coupled())
      origins.add_unused({"Water/Renewal"}, "Water/Level is coupled");
    else if (acts())
      origins.add_unused({"Water/Kept pressure",
                          "Water/Bottom pressure",
                          "Water/Time compression",
                          "Water/Drained surface"},
                         "Water/Level is seepage");
    if (acts())
      return suction.name_unused_entries(origins);
    const std::string why = "Water/Level is drained";
    origins.add_unused({"Water/Renewal",
                        "Water/Kept pressure",
                        "Water/Bottom pressure",
                        "Water/Time compression",
                        "Water/Drained surface",
                        "Water/Drained outer side",
                        "Water/Drained bottom",
                        "Water/Suction control",
                        "Water/Suction table",
                        "Water/Suction delay",
                        "Water/Pumped flow table",
                        "Water/Pump delay",
                        "Water/Largest suction",
                        "Water/Water depth"},
                       why);
    for (unsigned int i = 1; i <= soil.n_layers(); ++i)
      {
        const std::string layer = "Soil/Layer " + to_text(i) + "/Permeability";
        origins.add_unused({layer, layer + " ratio", layer + " by void ratio"},
                           why);
      }
    if (!body.motion().follows_loads())
      origins.add_unused({"Rigid body/Submerged weight"},
                         why + ", and Rigid body/Motion is " +
                           body.motion().name());
  }

  void
  GroundWater::initialize()
  {
    if (!acts())
      return;
    bottom_pressure = bottom_expression();
    if (is_coupled())
      projection.initialize(grid);
    else
      seepage.initialize(grid);
    mudline.initialize(grid, body.shape());
    is_solved = false;
    if (!kept_field.empty())
      scatter_field(kept_field);
    kept_field.clear();
  }

  Expression
  GroundWater::bottom_expression() const
  {
    return Expression(bottom_text, "Water/Bottom pressure = " + bottom_text);
  }

  NodalData &
  GroundWater::field()
  {
    return is_coupled() ? projection.pressure() : seepage.field();
  }

  std::size_t
  GroundWater::n_places() const
  {
    return std::size_t(grid.lines().n_columns() + 1) *
           (grid.lines().n_rows() + 1);
  }

  template <typename Action>
  void
  GroundWater::for_each_place(const Action &action) const
  {
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const CellBlock &block =
          grid.lines().tree().block(grid.global_number(cell));
        for (unsigned int k = 0; k < 4; ++k)
          action(grid.cell_nodes(cell).node[k],
                 std::size_t(block.row + k / 2 * block.size) *
                     (grid.lines().n_columns() + 1) +
                   block.column + k % 2 * block.size);
      }
  }

  std::vector<double>
  GroundWater::gather_field() const
  {
    constexpr double    none = std::numeric_limits<double>::lowest();
    std::vector<double> values(n_places(), none);
    const NodalData    &field =
      is_coupled() ? projection.pressure() : seepage.field();
    for_each_place([&](const unsigned int node, const std::size_t place) {
      if (node < grid.n_owned_nodes())
        values[place] = field.local_element(node);
    });
    Utilities::MPI::max(values, grid.communicator(), values);
    for (double &value : values)
      if (value == none)
        value = std::numeric_limits<double>::quiet_NaN();
    return values;
  }

  void
  GroundWater::scatter_field(const std::vector<double> &values)
  {
    field().zero_out_ghost_values();
    for_each_place([&](const unsigned int node, const std::size_t place) {
      if (node < grid.n_owned_nodes())
        field().local_element(node) = values[place];
    });
    field().update_ghost_values();
  }

  void
  GroundWater::keep_field()
  {
    if (acts() && has_started)
      kept_field = gather_field();
  }

  namespace
  {
    const std::string name_of_place = "water_at_";
  }

  NamedNumbers
  GroundWater::field_state() const
  {
    NamedNumbers state;
    if (!acts())
      return state;
    const std::vector<double> values = gather_field();
    for (std::size_t place = 0; place < values.size(); ++place)
      if (!std::isnan(values[place]))
        state.emplace_back(name_of_place + to_text(place), values[place]);
    return state;
  }

  void
  GroundWater::resume_field(const NamedNumbers &state)
  {
    if (!acts())
      return;
    std::vector<double> values(n_places(), 0.);
    for (const auto &[name, value] : state)
      if (name.compare(0, name_of_place.size(), name_of_place) == 0)
        values[std::stoul(name.substr(name_of_place.size()))] = value;
    scatter_field(values);
  }

  void
  GroundWater::write_pressure_to(MaterialPoints &of_points)
  {
    if (!acts() || !is_solved)
      return;
    const std::vector<double> &p = pressure();
    of_points.set_pore_pressure([&](const unsigned int cell,
                                    const Point<2>    &place) {
      const Kernels::CellMap<> map(grid.geometry(cell));
      double                   at_corner[4], field[4];
      for (unsigned int k = 0; k < 4; ++k)
        at_corner[k] = p[grid.cell_nodes(cell).node[k]];
      Kernels::coefficients(at_corner, field);
      return Kernels::evaluate(field,
                               map.at_position(place[radial], place[vertical]));
    });
  }

  void
  GroundWater::update(const double dt)
  {
    if (!acts())
      return;
    if (is_coupled())
      return set_up_step(dt);
    const double moved = std::abs(body.motion().travel() - travel_at_solve);
    if (is_solved && moved < renewal * body.shape().cell_width())
      {
        if (++steps_since_look < steps_between_looks)
          return;
        Mudline now = mudline;
        now.find(grid, points);
        steps_since_look = 0;
        if (Utilities::MPI::max(now.largest_change(mudline),
                                grid.communicator()) < renewal)
          return;
      }
    solve();
  }

  void
  GroundWater::solve()
  {
    mudline.find(grid, points);
    find_properties();
    seepage.solve(grid, mudline, permeability, sides);
    find_flow();
    is_solved        = true;
    travel_at_solve  = body.motion().travel();
    steps_since_look = 0;
  }

  void
  GroundWater::find_flow()
  {
    const auto over_tip = integrate_over_tip(
      is_coupled() ? projection.pressure() : seepage.field());
    tip_integral = over_tip[0];
    tip_area     = over_tip[1];
    flow_out     = solver().sum_at(outflow(), PressureSolver::plug);
    flow_in      = -solver().sum_at(outflow(), PressureSolver::open);
    if (has_lid() && !has_started)
      plug_height = mudline.mean_height(Mudline::Side::plug);
    has_started = true;
  }

  void
  GroundWater::set_up_step(const double dt)
  {
    mudline.find(grid, points);
    if (!is_solved || ++steps_since_look == steps_between_properties)
      {
        find_properties();
        steps_since_look = 0;
      }
    projection.set_up(grid, mudline, properties, sides, dt);
    if (!is_solved && !projection.solver().has_known_value())
      throw RunFailure(
        "the pore water has nowhere to drain to: its pressure is known nowhere. "
        "Set Water/Drained surface, Drained outer side or Drained bottom.");
    is_solved    = true;
    is_corrected = false;
    step         = dt;
  }

  void
  GroundWater::correct(const Kernels::NodalVector             *velocity,
                       const std::vector<Kernels::CornerView> &corners)
  {
    projection.solve(velocity,
                     corners,
                     kept_pressure,
                     {-suction.value(),
                      bottom_pressure(Point<2>(), time + .5 * step)});
    is_corrected = true;
    find_flow();
    unbalanced +=
      step * std::abs(solver().sum_at(outflow(), PressureSolver::unknown));
    through_surfaces += step * (std::abs(flow_out) + std::abs(flow_in));
  }

  const double *
  GroundWater::volume_rates(const Kernels::NodalVector             *velocity,
                            const std::vector<Kernels::CornerView> &corners)
  {
    if (!is_coupled())
      return nullptr;
    projection.find_volume_rates(velocity, corners);
    return projection.volume_rates().data();
  }

  const PressureSolver &
  GroundWater::solver() const
  {
    return is_coupled() ? projection.solver() : seepage.solver();
  }

  const NodalData &
  GroundWater::outflow() const
  {
    return is_coupled() ? projection.outflow() : seepage.residual();
  }

  double
  GroundWater::flow_scale() const
  {
    return is_coupled() ? 1. : suction.value() / soil.unit_weight_of_water();
  }

  bool
  GroundWater::has_lid() const
  {
    return body.shape().name() == "caisson";
  }

  void
  GroundWater::find_properties()
  {
    // Flow along layers adds up, flow across them shares its gradient.
    const double faster = is_coupled() ? time_compression : 1.;
    permeability.assign(grid.n_cells(), {});
    properties.assign(grid.n_cells(), {});
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (!grid.is_owned(cell) || grid.is_rigid(cell))
          continue;
        double volume = 0., mass = 0., along = 0., across = 0.;
        points.for_each_in(cell, [&](const MaterialPoint &p) {
          const SoilLayer &layer = soil.layer(p.material);
          const double     k =
            faster * layer.permeability_at(p.void_ratio(layer.void_ratio()));
          volume += p.volume;
          mass += p.mass;
          along += p.volume * k * layer.anisotropy;
          across += p.volume / k;
        });
        if (volume > 0.)
          permeability[cell] = {along / volume, volume / across};
        else // a gap
          {
            const auto        &g = grid.geometry(cell);
            const unsigned int i = soil.layer_at(std::min(0., g.bottom_left));
            const double       k = faster * soil.layer(i).permeability;
            permeability[cell]   = {k * soil.layer(i).anisotropy, k};
            volume               = 1.;
            mass                 = soil.inertial_density(i);
          }
        const double gamma = soil.unit_weight_of_water();
        properties[cell]   = {{permeability[cell].horizontal / gamma,
                               permeability[cell].vertical / gamma},
                              volume / mass};
      }
  }

  std::array<double, 2>
  GroundWater::integrate_over_tip(const NodalData &field) const
  {
    std::array<double, 2> sums = {{0., 0.}};
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        const int above = grid.neighbor(cell, 3);
        if (!grid.is_owned(cell) || grid.is_rigid(cell) || above < 0 ||
            !grid.is_rigid(above) ||
            mudline.side_of(cell) != Mudline::Side::body)
          continue;
        const auto area =
          areas_of_side(grid.geometry(cell), grid.axisymmetric());
        for (unsigned int i = 0; i < 2; ++i)
          {
            sums[0] +=
              area[i] * field.local_element(grid.cell_nodes(cell).node[2 + i]);
            sums[1] += area[i];
          }
      }
    for (double &sum : sums)
      sum =
        grid.circumference() * Utilities::MPI::sum(sum, grid.communicator());
    return sums;
  }

  double
  GroundWater::lid_area() const
  {
    if (!has_lid())
      return 0.;
    const double inner = body.shape().left();
    return pi * inner * inner;
  }

  SuctionLoad
  GroundWater::load_of_suction(const double force_on_body) const
  {
    const double weight = body.submerged_weight(), area = lid_area(),
                 volume = seepage_volume + area * (body.motion().travel() +
                                                   recent_heave.value());
    // In seepage, the pressure at the tip grows with the suction.
    if (is_coupled())
      return {-force_on_body + tip_force(), weight, area, volume};
    return {-force_on_body, weight, area + tip_integral, volume};
  }

  void
  GroundWater::advance(const double time,
                       const double dt,
                       const double force_on_body)
  {
    if (!acts())
      return;
    seepage_volume += dt * flow_scale() * flow_out;
    last_force_on_body = force_on_body;
    this->time         = time + dt;
    if (!has_lid())
      return;
    // A body that is lowered rests before the pump starts.
    if (body.motion().follows_loads())
      time_of_suction += body.motion().travel_at_rest() ? dt : 0.;
    else
      time_of_suction = time + dt;
    recent_heave.add(dt, time_of_heave, heave(mudline));
    suction.advance(time_of_suction, dt, load_of_suction(force_on_body));
  }

  const std::vector<double> &
  GroundWater::pressure()
  {
    pressure_.resize(grid.n_nodes());
    const NodalData &field =
      is_coupled() ? projection.pressure() : seepage.field();
    const double factor = is_coupled() ? 1. : -suction.value();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      pressure_[node] = factor * field.local_element(node);
    return pressure_;
  }

  const std::vector<double> &
  GroundWater::acting_pressure()
  {
    pressure();
    if (is_coupled() && !is_corrected)
      for (double &p : pressure_)
        p *= kept_pressure;
    return pressure_;
  }

  std::vector<std::string>
  GroundWater::column_names() const
  {
    std::vector<std::string> names;
    for (const auto &value : values(mudline))
      names.push_back(value.first);
    return names;
  }

  double
  GroundWater::heave(const Mudline &mudline) const
  {
    return is_solved ? mudline.mean_height(Mudline::Side::plug) - plug_height :
                       0.;
  }

  double
  GroundWater::heave_by_wall() const
  {
    const double outer = body.shape().right(), area = pi * outer * outer;
    return body.motion().travel() * (area - lid_area()) / lid_area();
  }

  NamedNumbers
  GroundWater::values(const Mudline &mudline) const
  {
    if (!acts())
      return {};
    const double scale = flow_scale();
    NamedNumbers result;
    if (is_coupled())
      result = {{"pore_pressure_smallest_Pa", extremes().first},
                {"pore_pressure_largest_Pa", extremes().second},
                {"water_balance",
                 through_surfaces > 0. ? unbalanced / through_surfaces : 0.}};
    if (!has_lid())
      {
        result.insert(result.end(),
                      {{"tip_water_force_N", tip_force()},
                       {"total_force_with_water_N",
                        -last_force_on_body + tip_force()},
                       {"surface_outflow_m3_s", -scale * flow_in},
                       {"flow_iterations", 1. * solver().n_iterations()}});
        return result;
      }
    // only the names are wanted before the flow is known
    const auto at_wall = [&](const Mudline::Side side) {
      return is_solved ? mudline.height_at_wall(side) : 0.;
    };
    const double       s = suction.value(), rise = heave(mudline);
    const NamedNumbers of_lid = {
      {"suction_Pa", s},
      {"required_suction_Pa", suction.required()},
      {"suction_force_N", s * lid_area()},
      {"tip_water_force_N", tip_force()},
      {"pore_pressure_factor",
       is_coupled() ? (s > 0. ? -tip_integral / tip_area / s : 0.) :
                      tip_integral / tip_area},
      {"exit_gradient_wall", scale * exit.wall},
      {"exit_gradient_axis", scale * exit.axis},
      {"critical_gradient", critical_gradient()},
      {"seepage_flow_m3_s", scale * flow_out},
      {"seepage_inflow_m3_s", scale * flow_in},
      {"seepage_volume_m3", seepage_volume},
      {"pumped_volume_m3",
       seepage_volume + lid_area() * (body.motion().travel() + rise)},
      {"plug_heave_m", rise},
      {"mudline_at_inner_wall_m", at_wall(Mudline::Side::plug)},
      {"mudline_at_outer_wall_m", at_wall(Mudline::Side::beyond)},
      {"flow_iterations", 1. * solver().n_iterations()}};
    result.insert(result.end(), of_lid.begin(), of_lid.end());
    return result;
  }

  std::pair<double, double>
  GroundWater::extremes() const
  {
    std::pair<double, double> result = {0., 0.};
    if (!is_solved)
      return result;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      {
        const double p = projection.pressure().local_element(node);
        result.first   = std::min(result.first, p);
        result.second  = std::max(result.second, p);
      }
    return {Utilities::MPI::min(result.first, grid.communicator()),
            Utilities::MPI::max(result.second, grid.communicator())};
  }

  NamedNumbers
  GroundWater::columns()
  {
    if (!acts())
      return {};
    if (!is_solved && !is_coupled())
      solve();
    if (is_solved && has_lid())
      exit = exit_gradient(grid, mudline, permeability, outflow());
    Mudline now = mudline;
    now.find(grid, points);
    return values(now);
  }

  std::vector<std::string>
  GroundWater::take_warnings()
  {
    std::vector<std::string> warnings;
    if (!acts() || !has_lid())
      return warnings;
    const std::string where =
      " at a penetration of " + to_text(body.penetration(), 5) + " m";
    const double gradient = flow_scale() * exit.wall;
    if (!has_warned_of_piping && gradient > critical_gradient())
      {
        has_warned_of_piping = true;
        warnings.push_back(
          "the exit gradient at the inner wall becomes critical" + where +
          ": the flow carries the soil. Piping may begin, which the program "
          "does not follow");
      }
    if (!has_warned_of_lift &&
        heave(mudline) > heave_by_wall() + .02 * body.shape().right())
      {
        has_warned_of_lift = true;
        warnings.push_back("the suction lifts the plug" + where +
                           ": it rises by more than the wall displaces");
      }
    return warnings;
  }

  double
  GroundWater::critical_gradient() const
  {
    return soil.unit_weight(0) / soil.unit_weight_of_water();
  }

  std::vector<GroundWater::Drainage>
  GroundWater::drainage(const std::vector<Kernels::Material> &materials) const
  {
    std::vector<Drainage> result;
    if (!is_coupled() || !body.shape().exists())
      return result;
    const double diameter = 2. * body.shape().right(),
                 speed    = body.motion().usual_velocity();
    for (unsigned int i = 0; i < soil.n_layers(); ++i)
      {
        const double modulus = materials[i].p_wave_modulus;
        Drainage     d;
        d.c_v = time_compression * soil.layer(i).permeability * modulus /
                soil.unit_weight_of_water();
        d.group = speed * diameter / d.c_v;
        d.inertia =
          d.c_v / (std::sqrt(modulus / soil.inertial_density(i)) * diameter);
        result.push_back(d);
      }
    return result;
  }

  std::vector<std::pair<std::string, std::string>>
  GroundWater::description(
    const std::vector<Kernels::Material> &materials) const
  {
    std::vector<std::pair<std::string, std::string>> lines;
    const auto of_layers = drainage(materials);
    for (unsigned int i = 0; i < of_layers.size(); ++i)
      lines.emplace_back(
        "drainage of layer " + to_text(i + 1),
        "c_v = " + to_text(of_layers[i].c_v, 3) +
          " m2/s, v D / c_v = " + to_text(of_layers[i].group, 3) +
          (time_compression != 1. ?
             ", permeability times " + to_text(time_compression) +
               " (Water/Time compression)" :
             ""));
    return lines;
  }

  std::vector<std::string>
  GroundWater::known_limits(
    const std::vector<Kernels::Material> &materials) const
  {
    std::vector<std::string> limits;
    const auto               of_layers = drainage(materials);
    for (unsigned int i = 0; i < of_layers.size(); ++i)
      if (of_layers[i].inertia > largest_inertia)
        limits.push_back(
          "inertia delays the drainage of layer " + to_text(i + 1) +
          ": c_v over wave speed and diameter is " +
          to_text(of_layers[i].inertia, 2) + ", more than " +
          to_text(largest_inertia) +
          ". Reduce Time/Mass scaling if pressures that change fast matter");
    return limits;
  }

  NamedNumbers
  GroundWater::limits() const
  {
    return {{"submerged_weight_N", body.submerged_weight()},
            {"cavitation_suction_Pa",
             suction.cavitation(soil.unit_weight_of_water())}};
  }

  std::string
  GroundWater::reason_to_end() const
  {
    if (!acts() || !has_lid())
      return "";
    const double travel = body.motion().travel();
    if (body.penetration() <= 0.)
      return "the caisson has left the soil, and water flows in below its skirt";
    if (is_solved && mudline.mean_height(Mudline::Side::plug) >=
                       body.shape().lower_face_of_lid() - travel)
      return "the plug has reached the lid, or the top of the skirt where the "
             "mesh has no lid (refusal)";
    return suction.limit_reached(soil.unit_weight_of_water());
  }

  void
  GroundWater::register_totals(RunTotals &totals)
  {
    suction.register_totals(totals);
    totals.keep("time_of_suction", time_of_suction);
    recent_heave.register_totals(totals, "recent_heave");
    totals.keep("seepage_volume", seepage_volume);
    totals.keep("plug_height_at_start", plug_height);
    totals.keep("water_has_started", has_started);
    totals.keep("water_unbalanced", unbalanced);
    totals.keep("water_through_surfaces", through_surfaces);
  }
} // namespace CaissonMPM
