// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
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
               {{"drained", Level::drained}, {"seepage", Level::seepage}},
               "The pore water has no excess pressure (drained), or flows "
               "steadily under the suction beneath the lid of a caisson "
               "(seepage). Units: none.");
    add_parameter("Renewal",
                  renewal,
                  "The flow is found anew when the body has moved, or the "
                  "mudline changed, by this share of a cell. Units: none.",
                  prm,
                  Patterns::Double(1e-6, 1.));
    add_parameter("Drained outer side",
                  sides.outer,
                  "The far side of the domain keeps the pressure of the open "
                  "water; otherwise nothing flows through it. Units: none.");
    add_parameter("Drained bottom",
                  sides.bottom,
                  "The bottom of the domain keeps the pressure of the open "
                  "water; otherwise nothing flows through it. Units: none.");
  }

  void
  GroundWater::check_parameters() const
  {
    if (!acts())
      return;
    suction.check_parameters();
    if (body.motion().follows_loads() && suction.is_result())
      throw BadInput(
        "Rigid body/Motion is " + body.motion().name() +
        ": the suction moves the body, and must be given. Set Water/Suction "
        "control = table, or Rigid body/Motion = prescribed, for which the "
        "suction is a result.");
    if (!soil.is_submerged() || soil.unit_weight_of_water() <= 0.)
      throw BadInput("Water/Level is seepage, but the soil is dry: set "
                     "Soil/Submerged = true, Soil/Fluid density and a Soil/"
                     "Gravity that points downward.");
    if (body.shape().name() != "caisson")
      throw BadInput("Water/Level is seepage, but Rigid body/Kind is " +
                     body.shape().name() +
                     ": only a caisson has a lid with suction beneath it. Set "
                     "Kind = caisson, or Level = drained.");
    if (!grid.axisymmetric())
      throw BadInput(
        "Water/Level is seepage, but Grid/Geometry is plane strain: "
        "the lid of a caisson is round. Set Geometry = "
        "axisymmetric, or Level = drained.");
    if (body.shape().initial_depth() <= 0.)
      throw BadInput("Water/Level is seepage, and Rigid body/Initial "
                     "penetration is 0: water would flow in below the skirt. "
                     "Begin with a penetration of some cells.");
  }

  void
  GroundWater::name_unused_entries(ParameterOrigins &origins) const
  {
    if (acts())
      return suction.name_unused_entries(origins);
    const std::string why = "Water/Level is drained";
    origins.add_unused({"Water/Renewal",
                        "Water/Drained outer side",
                        "Water/Drained bottom",
                        "Water/Suction control",
                        "Water/Suction table",
                        "Water/Suction delay",
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
    seepage.initialize(grid);
    mudline.initialize(grid, body.shape());
    is_solved = false;
  }

  void
  GroundWater::update()
  {
    if (!acts())
      return;
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
    find_permeabilities();
    grid.write_vertices();
    seepage.solve(grid, mudline, permeability, sides);
    find_tip();
    flow = seepage.flow(grid);
    exit = seepage.exit_gradient(grid, mudline, permeability);
    if (!has_started)
      plug_height = mudline.mean_height(Mudline::Side::plug);
    has_started      = true;
    is_solved        = true;
    travel_at_solve  = body.motion().travel();
    steps_since_look = 0;
  }

  void
  GroundWater::find_permeabilities()
  {
    // Flow along layers adds up, flow across them shares its gradient.
    permeability.assign(grid.n_cells(), {});
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      {
        if (!grid.is_owned(cell) || grid.is_rigid(cell))
          continue;
        double volume = 0., along = 0., across = 0.;
        points.for_each_in(cell, [&](const MaterialPoint &p) {
          const SoilLayer &layer = soil.layer(p.material);
          const double     k =
            layer.permeability_at(p.void_ratio(layer.void_ratio()));
          volume += p.volume;
          along += p.volume * k * layer.anisotropy;
          across += p.volume / k;
        });
        if (volume > 0.)
          permeability[cell] = {along / volume, volume / across};
        else // a gap
          {
            const auto      &g = grid.geometry(cell);
            const SoilLayer &layer =
              soil.layer(soil.layer_at(std::min(0., g.bottom_left)));
            permeability[cell] = {layer.permeability * layer.anisotropy,
                                  layer.permeability};
          }
      }
  }

  void
  GroundWater::find_tip()
  {
    tip_area = tip_phi = 0.;
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
            tip_area += area[i];
            tip_phi += area[i] * seepage.field().local_element(
                                   grid.cell_nodes(cell).node[2 + i]);
          }
      }
    tip_area =
      grid.circumference() * Utilities::MPI::sum(tip_area, grid.communicator());
    tip_phi =
      grid.circumference() * Utilities::MPI::sum(tip_phi, grid.communicator());
  }

  double
  GroundWater::lid_area() const
  {
    const double inner = body.shape().left();
    return pi * inner * inner;
  }

  void
  GroundWater::advance(const double time,
                       const double dt,
                       const double force_on_body)
  {
    if (!acts())
      return;
    // A body that is lowered rests before the pump starts.
    if (body.motion().follows_loads())
      time_of_suction += body.motion().travel_at_rest() ? dt : 0.;
    else
      time_of_suction = time + dt;
    suction.advance(time_of_suction,
                    dt,
                    {-force_on_body, body.submerged_weight(), loaded_area()});
    seepage_volume +=
      dt * suction.value() / soil.unit_weight_of_water() * flow.out;
  }

  const std::vector<double> &
  GroundWater::pressure()
  {
    pressure_.resize(grid.n_nodes());
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      pressure_[node] = -suction.value() * seepage.field().local_element(node);
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
    // only the names are wanted before the flow is known
    const auto at_wall = [&](const Mudline::Side side) {
      return is_solved ? mudline.height_at_wall(side) : 0.;
    };
    const double s = suction.value(), gamma = soil.unit_weight_of_water(),
                 rise = heave(mudline);
    return {{"suction_Pa", s},
            {"required_suction_Pa", suction.required()},
            {"suction_force_N", s * lid_area()},
            {"tip_water_force_N", -s * tip_phi},
            {"pore_pressure_factor", tip_phi / tip_area},
            {"exit_gradient_wall", s / gamma * exit.wall},
            {"exit_gradient_axis", s / gamma * exit.axis},
            {"critical_gradient", critical_gradient()},
            {"seepage_flow_m3_s", s / gamma * flow.out},
            {"seepage_inflow_m3_s", s / gamma * flow.in},
            {"seepage_volume_m3", seepage_volume},
            {"pumped_volume_m3",
             seepage_volume + lid_area() * (body.motion().travel() + rise)},
            {"plug_heave_m", rise},
            {"mudline_at_inner_wall_m", at_wall(Mudline::Side::plug)},
            {"mudline_at_outer_wall_m", at_wall(Mudline::Side::beyond)},
            {"flow_iterations", 1. * seepage.n_iterations()}};
  }

  NamedNumbers
  GroundWater::columns()
  {
    if (!acts())
      return {};
    if (!is_solved)
      solve();
    Mudline now = mudline;
    now.find(grid, points);
    return values(now);
  }

  std::vector<std::string>
  GroundWater::take_warnings()
  {
    std::vector<std::string> warnings;
    if (!acts())
      return warnings;
    const std::string where =
      " at a penetration of " + to_text(body.penetration(), 5) + " m";
    const double gradient =
      suction.value() / soil.unit_weight_of_water() * exit.wall;
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
    if (!acts())
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
    totals.keep("seepage_volume", seepage_volume);
    totals.keep("plug_height_at_start", plug_height);
    totals.keep("water_has_started", has_started);
  }
} // namespace CaissonMPM
