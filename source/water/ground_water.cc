// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/nodal_sums.h>
#include <caisson_mpm/kernels/views.h>
#include <caisson_mpm/water/ground_water.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    // Heights of the mudline are looked at this many steps apart.
    constexpr unsigned int steps_between_looks = 10;

    // Permeability and density of coupled soil are found this many steps apart.
    constexpr unsigned int steps_between_properties = 20;

    // In this many steps, the soil moves by a small part of a cell.
    constexpr unsigned int steps_between_set_ups = 4;

    // The heave is known when the flow is found; the pump sees it smoothed.
    constexpr double time_of_heave = 1.; // s
  }                                      // namespace

  GroundWater::GroundWater(BackgroundGrid  &grid,
                           MaterialPoints  &points,
                           const Soil      &soil,
                           const RigidBody &body)
    : ParameterAcceptor("/Water")
    , grid(grid)
    , points(points)
    , soil(soil)
    , body(body)
    , plug_balance(grid, points, body)
    , plug_strength(grid, points, soil, body)
  {
    add_choice(
      *this,
      "Level",
      level,
      {{"drained", Level::drained},
       {"undrained", Level::undrained},
       {"seepage", Level::seepage},
       {"coupled", Level::coupled}},
      "The pore water has no excess pressure (drained), stays where it "
      "is and resists any change of volume (undrained), flows "
      "steadily under the suction beneath the lid of a caisson "
      "(seepage), or has the pressure that follows from the motion of "
      "the soil (coupled). Units: none.");
    add_parameter("Renewal",
                  renewal,
                  "The flow is found anew when the body has moved, or the "
                  "mudline changed, by this share of a cell. Units: none.",
                  prm,
                  Patterns::Double(1e-6, 1.));
    add_parameter("Time compression",
                  time_compression,
                  "The scene runs this many times faster than what it stands "
                  "for, and a coupled run multiplies all permeabilities with "
                  "it, so that as much water flows. Units: none.",
                  prm,
                  Patterns::Double(1e-9));
    add_parameter("Bulk modulus",
                  bulk_modulus,
                  "Bulk modulus of the water in undrained soil over the "
                  "porosity: the excess pressure is this times the decrease of "
                  "volume. 20 to 60 times the bulk modulus of the soil leaves "
                  "hardly any change of volume. Units: Pa.",
                  prm,
                  Patterns::Double(1e-9));
    declare_open_sides();
  }

  void
  GroundWater::declare_open_sides()
  {
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
    if (is_undrained())
      {
        if (!soil.is_submerged())
          throw BadInput("Water/Level is undrained, but the soil is dry: set "
                         "Soil/Submerged = true, or Level = drained.");
        return;
      }
    suction.check_parameters();
    bottom_expression().at_time(0.);
    if (!soil.is_submerged() || soil.unit_weight_of_water() <= 0.)
      throw BadInput("Water/Level is not drained, but the soil is dry: set "
                     "Soil/Submerged = true, Soil/Fluid density and a Soil/"
                     "Gravity that points downward, or Level = drained.");
    if (!has_lid())
      {
        if (!is_coupled())
          throw BadInput(
            "Water/Level is seepage, but Rigid body/Kind is " +
            body.shape().name() +
            ": only a caisson has a lid with suction beneath it. Set Kind = "
            "caisson, or Level = drained, undrained or coupled.");
        if (!sides.surface && !sides.outer && !sides.bottom)
          throw BadInput(
            "the pore water has nowhere to drain to. Set Water/Drained "
            "surface, Drained outer side or Drained bottom = true.");
        return;
      }
    if (body.motion().follows_loads() && suction.is_result())
      throw BadInput(
        "Rigid body/Motion is " + body.motion().name() +
        ": the suction moves the body, and must be given. Set Water/Suction "
        "control = table or flow, or Rigid body/Motion = prescribed, for which "
        "the suction is a result.");
    if (suction.moves_body() && !body.motion().follows_loads())
      throw BadInput(
        "Water/Suction control is flow, but Rigid body/Motion is " +
        body.motion().name() +
        ": the velocity of the body sets the flow. Set Motion = lowered or "
        "dropped, or Suction control = required or table.");
    if (!grid.axisymmetric())
      throw BadInput(
        "Water/Level is not drained, but Grid/Geometry is plane strain: the "
        "lid of a caisson is round. Set Geometry = axisymmetric, or Level = "
        "drained or undrained.");
    if (body.shape().initial_depth() <= 0.)
      throw BadInput("Water/Level is not drained, and Rigid body/Initial "
                     "penetration is 0: water would flow in below the skirt. "
                     "Begin with a penetration of some cells, or set Level = "
                     "drained or undrained.");
  }

  void
  GroundWater::name_unused_entries(ParameterOrigins &origins) const
  {
    if (!flows())
      return name_unused_without_flow(origins);
    origins.add_unused({"Water/Bulk modulus"}, "Water/Level is not undrained");
    if (is_coupled())
      origins.add_unused({"Water/Renewal"}, "Water/Level is coupled");
    else
      origins.add_unused({"Water/Bottom pressure",
                          "Water/Time compression",
                          "Water/Drained surface"},
                         "Water/Level is seepage");
    if (is_coupled() && !sides.bottom)
      origins.add_unused({"Water/Bottom pressure"},
                         "Water/Drained bottom is false");
    if (!has_lid())
      return Suction::name_all_unused(origins, "there is no caisson");
    suction.name_unused_entries(origins);
  }

  void
  GroundWater::name_unused_without_flow(ParameterOrigins &origins) const
  {
    const std::string why =
      is_undrained() ? "Water/Level is undrained" : "Water/Level is drained";
    if (!is_undrained())
      origins.add_unused({"Water/Bulk modulus", "Water/Water depth"}, why);
    origins.add_unused({"Water/Renewal",
                        "Water/Bottom pressure",
                        "Water/Time compression",
                        "Water/Drained surface",
                        "Water/Drained outer side",
                        "Water/Drained bottom"},
                       why);
    Suction::name_all_unused(origins, why);
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
    suction.initialize(soil.unit_weight_of_water());
    mudline.initialize(grid, body.shape());
    find_cells_at_tip();
    undrained.forget();
    if (!flows())
      return;
    bottom_pressure = bottom_expression();
    if (is_coupled())
      projection.initialize(grid);
    else
      seepage.initialize(grid);
    is_solved        = false;
    steps_since_look = 0;
    step             = 0.;
    if (is_coupled() && !kept_values.empty())
      projection.know_wet_cells();
    const auto fields = kept_fields();
    for (std::size_t i = 0; i < kept_values.size(); ++i)
      scatter(kept_values[i], *fields[i].field);
    kept_values.clear();
  }

  Expression
  GroundWater::bottom_expression() const
  {
    return Expression(bottom_text, "Water/Bottom pressure = " + bottom_text);
  }

  void
  GroundWater::update(const double dt, const BoundaryConditions &conditions)
  {
    if (!acts())
      return;
    if (is_undrained())
      return find_undrained_pressure();
    if (is_coupled())
      return set_up_step(dt, conditions);
    const double moved = std::abs(body.motion().travel() - travel_at_solve);
    if (is_solved && moved < renewal * body.shape().cell_width())
      {
        if (++steps_since_look < steps_between_looks)
          return;
        Mudline now = mudline;
        now.find(grid, points);
        look_at_lid(now);
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
    look_at_lid(mudline);
    find_properties();
    seepage.solve(grid, mudline, permeability, sides);
    find_flow();
    is_solved        = true;
    travel_at_solve  = body.motion().travel();
    steps_since_look = 0;
  }

  void
  GroundWater::look_at_lid(const Mudline &now)
  {
    if (filled_beneath_lid() == nullptr)
      return;
    filled_beneath_lid_ = now.filled();
    touched_lid         = now.touched_share_of_lid(grid);
  }

  void
  GroundWater::stiffen(std::vector<Kernels::Material> &materials) const
  {
    for (Kernels::Material &material : materials)
      if (is_undrained())
        {
          material.water_modulus = bulk_modulus;
          material.p_wave_modulus += bulk_modulus;
        }
  }

  void
  GroundWater::find_flow()
  {
    find_tip_integral();
    if (is_coupled())
      {
        flow_out       = projection.flow().out;
        flow_in        = projection.flow().in;
        flow_remaining = projection.flow().left;
      }
    else
      {
        const auto sums = seepage.solver().sums_by_state(seepage.residual());
        flow_out        = sums[PressureSolver::plug];
        flow_in         = -sums[PressureSolver::open];
        flow_remaining  = sums[PressureSolver::unknown];
      }
    if (has_lid() && !has_started)
      {
        plug_height = mudline.mean_height(Mudline::Side::plug);
        plug_balance.start();
      }
    has_started = true;
  }

  void
  GroundWater::set_up_step(const double              dt,
                           const BoundaryConditions &conditions)
  {
    if (!is_solved || ++steps_since_look == steps_between_properties)
      {
        find_properties();
        steps_since_look = 0;
      }
    // steps that end at a record differ by rounding alone
    const bool is_new_step = std::abs(dt - step) > 1e-9 * step;
    if (is_new_step || steps_since_look % steps_between_set_ups == 0)
      {
        mudline.find(grid, points);
        look_at_lid(mudline);
        projection.set_up(grid, mudline, properties, sides, conditions, dt);
      }
    if (!is_solved && !projection.solver().has_known_value())
      throw RunFailure(
        "the pore water has nowhere to drain to: its pressure is known nowhere. "
        "Set Water/Drained surface, Drained outer side or Drained bottom.");
    is_solved = true;
    step      = dt;
  }

  void
  GroundWater::correct(const Kernels::NodalVector             *velocity,
                       const std::vector<Kernels::CornerView> &corners)
  {
    projection.solve(velocity,
                     corners,
                     {-suction.value(),
                      bottom_pressure.at_time(time + .5 * step)});
    find_flow();
    unbalanced += step * std::abs(flow_remaining);
    through_surfaces += step * (std::abs(flow_out) + std::abs(flow_in));
  }

  const double *
  GroundWater::volume_rates(const Kernels::NodalVector             *velocity,
                            const std::vector<Kernels::CornerView> &corners)
  {
    if (!is_coupled())
      return nullptr;
    return projection.find_volume_rates(velocity, corners).data();
  }

  const NodalData &
  GroundWater::outflow()
  {
    return is_coupled() ? projection.find_outflow() : seepage.residual();
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
          const SoilMaterial &material = soil.material(p.material);
          const double        k        = faster * material.permeability_at(
                                      p.void_ratio(material.void_ratio()));
          volume += p.volume;
          mass += p.mass;
          along += p.volume * k * material.anisotropy;
          across += p.volume / k;
        });
        if (volume > 0.)
          permeability[cell] = {along / volume, volume / across};
        else // a gap
          {
            const auto        &g = grid.geometry(cell);
            const unsigned int i =
              soil.material_at(std::min(0., g.bottom_left));
            const double k     = faster * soil.material(i).permeability;
            permeability[cell] = {k * soil.material(i).anisotropy, k};
            volume             = 1.;
            mass               = soil.inertial_density(i);
          }
        const double gamma = soil.unit_weight_of_water();
        properties[cell]   = {{permeability[cell].horizontal / gamma,
                               permeability[cell].vertical / gamma},
                              volume / mass};
      }
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
    last_force_on_body = force_on_body;
    this->time         = time + dt;
    if (is_undrained())
      return;
    seepage_volume += dt * flow_scale() * flow_out;
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
    const double     factor = is_coupled() ? 1. : -suction.value();
    const NodalData &nodal =
      is_coupled() ? projection.find_nodal_pressure() : seepage.field();
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      pressure_[node] = factor * nodal.local_element(node);
    return pressure_;
  }

  void
  GroundWater::add_coupled_force(Kernels::NodalVector *force) const
  {
    projection.add_force(force);
  }

  void
  GroundWater::register_totals(RunTotals &totals)
  {
    suction.register_totals(totals);
    totals.keep("time_of_suction", time_of_suction);
    recent_heave.register_totals(totals, "recent_heave");
    plug_balance.register_totals(totals);
    projection.register_totals(totals);
    totals.keep("seepage_volume", seepage_volume);
    totals.keep("volume_at_start", volume_at_start);
    totals.carry("plug_height_at_start", plug_height);
    totals.carry("water_has_started", has_started);
    totals.keep("water_time", time);
    totals.carry("water_force_on_body", last_force_on_body);
    totals.keep("water_unbalanced", unbalanced);
    totals.keep("water_through_surfaces", through_surfaces);
  }
} // namespace CaissonMPM
