// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/shown_unit.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/lid_compartment.h>

namespace CaissonMPM
{
  namespace
  {
    // The heave is known when the flow is computed; the pump sees it smoothed.
    constexpr double time_of_heave = 1.; // s

    // From this share of the area on, the soil bears on the whole lid.
    constexpr double full_lid = .9;

    // Of the radius, over which a rise of the plug is measured; and of the
    // penetration, which a plug that is lifted rises.
    constexpr double window_of_lift = .04, lifted = .5;
  } // namespace

  LidCompartment::LidCompartment(const WaterScene &scene)
    : scene(scene)
    , suction_(scene.settings.suction, scene.settings.sea, scene.soil)
    , plug_(scene)
    , feasibility(scene.settings.feasibility)
  {
    RunTotals &totals = scene.totals;
    suction_.register_totals(totals);
    sealed.register_totals(totals);
    feasibility.register_totals(totals);
    recent_heave.register_totals(totals, "recent_heave");
    totals.keep("time_of_suction", time_of_suction);
    totals.keep("seepage_volume", seepage_volume);
    totals.keep("volume_at_start", volume_at_start);
    totals.keep("has_warned_of_cavity", has_warned_of_cavity);
  }

  void
  LidCompartment::check_parameters() const
  {
    const BodyMotion      &motion   = scene.body.motion();
    const SuctionSettings &settings = scene.settings.suction;
    const auto             control  = settings.control;
    if (motion.traits.follows_loads && settings.is_required())
      throw BadInput(
        "Rigid body/Motion is " + motion.name +
        ": the suction moves the body, and must be given. Set Water/Suction "
        "control = table or flow, or Rigid body/Motion = prescribed, for which "
        "the suction is a result.");
    if (control == SuctionSettings::Control::flow &&
        !motion.traits.follows_loads)
      throw BadInput(
        "Water/Suction control is flow, but Rigid body/Motion is " +
        motion.name +
        ": the velocity of the body sets the flow. Set Motion = lowered or "
        "dropped, or Suction control = required or table.");
    if (!scene.grid.axisymmetric())
      throw BadInput(
        "There is suction beneath the lid, but Grid/Geometry is plane strain: "
        "the lid of a caisson is round. Set Geometry = axisymmetric, or Level "
        "= drained or undrained with Suction control = automatic.");
    if (scene.body.shape().initial_depth() <= 0.)
      throw BadInput("There is suction beneath the lid, and Rigid body/Initial "
                     "penetration is 0: water would flow in below the skirt. "
                     "Begin with a penetration of some cells, or set Level = "
                     "drained or undrained with Suction control = automatic.");
  }

  void
  LidCompartment::initialize()
  {
    sealed.set_properties(
      {settings().leak,
       settings().bulk_modulus,
       settings().gas,
       scene.settings.sea.ambient_pressure(scene.soil.unit_weight_of_water())});
  }

  void
  LidCompartment::continue_after(const SoilColumns &soil_columns)
  {
    if (!is_sealed())
      sealed = SealedLid(); // an open lid keeps no cavity
    const double travel = scene.body.motion().travel();
    volume_at_start     = plug_.area() * (travel + plug_.heave(soil_columns)) +
                      suction_.gas_expansion();
    suction_.continue_at(plug_.area() * (travel + recent_heave.value()));
  }

  void
  LidCompartment::update_touching(const SoilColumns &now)
  {
    if (!scene.body.shape().has_lid())
      return;
    filled  = now.filled();
    touched = now.touched_share_of_lid(scene.grid);
  }

  void
  LidCompartment::open(Contact &contact) const
  {
    if (scene.body.shape().has_lid())
      contact.open_lid(filled, SoilColumns::touching);
  }

  void
  LidCompartment::end_step(const double       time,
                           const double       dt,
                           const double       force_on_body,
                           const SoilColumns &soil_columns,
                           const WaterFlow   &flow)
  {
    seepage_volume += dt * flow.scale * flow.out;
    // A body that is lowered rests before the pump starts.
    const BodyMotion &motion = scene.body.motion();
    if (motion.traits.follows_loads)
      time_of_suction += motion.travel_at_rest() ? dt : 0.;
    else
      time_of_suction = time;
    recent_heave.add(dt, time_of_heave, plug_.heave(soil_columns));
    if (is_sealed())
      advance_sealed(dt, soil_columns, flow);
    suction_.advance(time_of_suction,
                     dt,
                     {-force_on_body + flow.tip_resistance,
                      scene.body.submerged_weight(),
                      plug_.area() + flow.tip_area,
                      seepage_volume +
                        plug_.area() * (motion.travel() + recent_heave.value()),
                      motion.velocity() < 0.});
  }

  void
  LidCompartment::advance_sealed(const double       dt,
                                 const SoilColumns &soil_columns,
                                 const WaterFlow   &flow)
  {
    const double displaced = plug_.area() * scene.body.motion().travel();
    if (!sealed.has_started())
      sealed.start(suction(),
                   plug_.area() *
                       (height_of_lid() -
                        soil_columns.mean_height(SoilColumns::Side::plug)) -
                     sealed.cavity(),
                   displaced);
    sealed.advance(dt,
                   displaced,
                   {flow.plug_rate, flow.scale * flow.out, flow.response},
                   suction_.cavitation(height_of_lid()));
    suction_.set(sealed.suction());
  }

  void
  LidCompartment::update_limits(const SoilColumns &now, const WaterFlow &flow)
  {
    if (flow.flows)
      plug_.find_withstood(now);
    if (is_sealed())
      return;
    const double critical = plug_.withstood().surface;
    feasibility.update(scene.body.penetration(),
                       plug_.extra_heave(now),
                       suction(),
                       critical > 0. ?
                         plug_.lifting_gradient(flow.scale, suction()) /
                           critical :
                         0.,
                       window_of_lift * scene.body.shape().right());
  }

  std::optional<Feasibility::Place>
  LidCompartment::infeasible() const
  {
    if (const auto place = feasibility.place())
      return place;
    if (const std::string limit = suction_.limit_reached(height_of_lid());
        !limit.empty() && !is_sealed())
      return Feasibility::Place{scene.body.penetration(),
                                suction_.exceeds_pump() ? "pump" : "boiling"};
    return {};
  }

  NamedNumbers
  LidCompartment::columns(const SoilColumns &soil_columns,
                          const WaterFlow   &flow)
  {
    // only the names are wanted before the flow is known
    const auto at_wall = [&](const SoilColumns::Side side) {
      return soil_columns.is_found() ? soil_columns.height_at_wall(side) : 0.;
    };
    const NamedNumbers balance = plug_.balance(soil_columns);
    const double       rise    = plug_.heave(soil_columns);
    NamedNumbers       result  = {{"suction_Pa", suction()},
                                  {"cavitation_suction_Pa",
                                   suction_.cavitation(height_of_lid())},
                                  {"suction_force_N", load()},
                                  {"tip_water_force_N", flow.tip_force},
                                  {"pore_pressure_factor", flow.pressure_factor}};
    const auto         add     = [&result](const NamedNumbers &more) {
      result.insert(result.end(), more.begin(), more.end());
    };
    if (flow.flows)
      add({{"exit_gradient_wall", flow.scale * plug_.exit().wall},
           {"exit_gradient_axis", flow.scale * plug_.exit().axis},
           {"critical_gradient", plug_.withstood().surface},
           {"seepage_flow_m3_s", flow.scale * flow.out},
           {"seepage_inflow_m3_s", flow.scale * flow.in},
           {"seepage_volume_m3", seepage_volume}});
    add({{"plug_heave_m", rise},
         {"mudline_at_inner_wall_m", at_wall(SoilColumns::Side::plug)},
         {"mudline_at_outer_wall_m", at_wall(SoilColumns::Side::beyond)},
         {"flow_iterations", 1. * flow.n_iterations}});
    add(balance);
    if (is_sealed())
      add(sealed.columns());
    else
      {
        const double gas = suction_.gas_expansion();
        add({{"required_suction_Pa", suction_.required()},
             {"pumped_volume_m3",
              seepage_volume +
                plug_.area() * (scene.body.motion().travel() + rise) + gas -
                volume_at_start},
             {"gas_expansion_m3", gas}});
      }
    return result;
  }

  void
  LidCompartment::warn(const std::string        &where,
                       const SoilColumns        &soil_columns,
                       const WaterFlow          &flow,
                       std::vector<std::string> &warnings)
  {
    plug_.warn(where, soil_columns, flow.scale, suction(), warnings);
    if (holds_first(has_warned_of_cavity, sealed.cavity() > 0.))
      warnings.push_back(
        "water boils beneath the sealed lid" + where + ", at a suction of " +
        to_text(1e-3 * suction(), 4) +
        " kPa: the suction grows no more, and a cavity takes the place of the "
        "water");
  }

  std::string
  LidCompartment::reason_to_end(const SoilColumns *soil_columns) const
  {
    if (scene.body.penetration() <= 0.)
      return "the caisson has left the soil, and water flows in below its "
             "skirt";
    // soil may rest on the lid, and leave it again
    const BodyMotion &motion = scene.body.motion();
    if (is_sealed() || motion.velocity() < 0.)
      return "";
    // at rest a way begins, and it may be one up
    const bool begins = motion.velocity() == 0. && motion.usual_velocity() > 0.;
    // soil that has been piping or lifted is no plug that refuses
    const std::string refusal = feasibility.place() ? "" : " (refusal)";
    if (!begins && touched >= full_lid)
      return "the plug fills the caisson: soil bears on " +
             percent(full_lid, 2) + " of the lid" + refusal;
    if (!begins && soil_columns != nullptr &&
        soil_columns->mean_height(SoilColumns::Side::plug) >= height_of_lid())
      return "the plug fills the caisson: it has reached the lid, or the top of "
             "the skirt where the mesh has no lid" +
             refusal;
    const std::string limit = suction_.limit_reached(height_of_lid());
    return limit.empty() ? feasibility.reason_to_end(scene.body.penetration()) :
                           limit;
  }

  std::string
  LidCompartment::description() const
  {
    const double weight   = scene.body.submerged_weight(),
                 stress   = weight / plug_.area();
    const ShownUnit force = unit_of_forces(weight),
                    unit  = unit_of_stresses(stress);
    return "on a lid of " + to_text(plug_.area(), 4) + " m2; the weight is " +
           to_text(force.factor * weight, 4) + " " + force.name +
           ", equal to " + to_text(unit.factor * stress, 3) + " " + unit.name +
           " on it; water cavitates there at a suction of " +
           to_text(1e-3 * suction_.cavitation(height_of_lid()), 3) + " kPa";
  }

  double
  LidCompartment::height_of_lid() const
  {
    return scene.body.shape().lower_face_of_lid() -
           scene.body.motion().travel();
  }

  // ------------------------------------------------------------ feasibility

  void
  Feasibility::update(const double penetration,
                      const double extra_heave,
                      const double suction,
                      const double gradient,
                      const double window)
  {
    if (suction <= 0.)
      at = -1.;
    else if (piping < 0. && gradient >= 1.)
      piping = penetration;
    if (suction <= 0. || (at >= 0. && penetration < at + window))
      return;
    const double rise = extra_heave - heave_there;
    if (at >= 0. && lift < 0. && rise > lifted * (penetration - at))
      lift = at;
    at          = penetration;
    heave_there = extra_heave;
  }

  std::optional<Feasibility::Place>
  Feasibility::place() const
  {
    if (piping >= 0. && (lift < 0. || piping <= lift))
      return Place{piping, "piping"};
    if (lift >= 0.)
      return Place{lift, "plug lift"};
    return {};
  }

  std::string
  Feasibility::reason_to_end(const double penetration) const
  {
    const auto from = place();
    if (!from || !settings.distance ||
        penetration < from->penetration + *settings.distance)
      return "";
    return "the installation has not been feasible since " +
           to_text(from->penetration, 4) + " m (" + from->reason +
           "), and Installation/End where infeasible is " +
           to_text(*settings.distance) + " m";
  }

  void
  Feasibility::register_totals(RunTotals &totals)
  {
    totals.keep("piping_since", piping);
    totals.keep("plug_lifted_since", lift);
    totals.keep("plug_rise_measured_at", at);
    totals.keep("plug_rise_measured", heave_there);
  }
} // namespace CaissonMPM
