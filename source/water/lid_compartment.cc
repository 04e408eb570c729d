// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/shown_unit.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/lid_compartment.h>

#include <algorithm>

namespace CaissonMPM
{
  namespace
  {
    // The heave is known when the flow is computed; the pump sees it smoothed.
    constexpr double time_of_heave = 1.; // s

    // From this share of the area on, the soil bears on the whole lid.
    constexpr double full_lid = .9;

    // Nearer to the critical gradient than this, no margin is left: the suction
    // is not known better.
    constexpr double near_critical = .9;

    // Of the radius, over which a rise of the plug is measured.
    constexpr double window_of_lift = .04;

    // A flow that lifts less than this share of the plug is ignored.
    constexpr double least_lifted_share = .1;
  } // namespace

  LidCompartment::LidCompartment(const WaterScene &scene)
    : scene(scene)
    , suction_(scene.settings.suction, scene.settings.sea)
    , plug_balance(scene.grid, scene.points, scene.body)
    , plug_strength(scene.grid, scene.points, scene.soil, scene.body)
    , feasibility(scene.settings.feasibility)
  {
    RunTotals &totals = scene.totals;
    suction_.register_totals(totals);
    sealed.register_totals(totals);
    totals.keep("time_of_suction", time_of_suction);
    recent_heave.register_totals(totals, "recent_heave");
    plug_balance.register_totals(totals);
    feasibility.register_totals(totals);
    totals.keep("seepage_volume", seepage_volume);
    totals.keep("volume_at_start", volume_at_start);
    totals.carry("plug_height_at_start", plug_height);
    totals.carry("plug_has_started", has_started);
    totals.keep("has_warned_of_piping", has_warned_of_piping);
    totals.keep("has_warned_of_cavity", has_warned_of_cavity);
    totals.keep("has_warned_of_lift", has_warned_of_lift);
  }

  void
  LidCompartment::check_parameters() const
  {
    const BodyMotion      &motion   = scene.body.motion();
    const SuctionSettings &settings = scene.settings.suction;
    const auto             control  = settings.control;
    if (motion.follows_loads() && settings.is_required())
      throw BadInput(
        "Rigid body/Motion is " + motion.name() +
        ": the suction moves the body, and must be given. Set Water/Suction "
        "control = table or flow, or Rigid body/Motion = prescribed, for which "
        "the suction is a result.");
    if (control == SuctionSettings::Control::flow && !motion.follows_loads())
      throw BadInput(
        "Water/Suction control is flow, but Rigid body/Motion is " +
        motion.name() +
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
    const double unit_weight = scene.soil.unit_weight_of_water();
    suction_.initialize(unit_weight);
    sealed.set_properties({settings().leak,
                           settings().bulk_modulus,
                           settings().gas,
                           scene.settings.sea.ambient_pressure(unit_weight)});
  }

  void
  LidCompartment::start(const Mudline &mudline)
  {
    if (has_started)
      return;
    plug_height = mudline.mean_height(Mudline::Side::plug);
    plug_balance.start();
    has_started = true;
  }

  void
  LidCompartment::continue_after(const Mudline &mudline)
  {
    if (!is_sealed())
      sealed = SealedLid(); // an open lid keeps no cavity
    const double travel = scene.body.motion().travel();
    volume_at_start =
      area() * (travel + heave(mudline)) + suction_.gas_expansion();
    suction_.continue_at(area() * (travel + recent_heave.value()));
  }

  void
  LidCompartment::update_touching(const Mudline &now)
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
      contact.open_lid(filled, Mudline::touching);
  }

  void
  LidCompartment::end_step(const double     time,
                           const double     dt,
                           const double     force_on_body,
                           const Mudline   &mudline,
                           const WaterFlow &flow)
  {
    seepage_volume += dt * flow.scale * flow.out;
    // A body that is lowered rests before the pump starts.
    const BodyMotion &motion = scene.body.motion();
    if (motion.follows_loads())
      time_of_suction += motion.travel_at_rest() ? dt : 0.;
    else
      time_of_suction = time;
    recent_heave.add(dt, time_of_heave, heave(mudline));
    if (is_sealed())
      advance_sealed(dt, mudline, flow);
    suction_.advance(time_of_suction,
                     dt,
                     {-force_on_body + flow.tip_resistance,
                      scene.body.submerged_weight(),
                      area() + flow.tip_area,
                      seepage_volume +
                        area() * (motion.travel() + recent_heave.value())});
  }

  void
  LidCompartment::advance_sealed(const double     dt,
                                 const Mudline   &mudline,
                                 const WaterFlow &flow)
  {
    const double displaced = area() * scene.body.motion().travel();
    if (!sealed.has_started())
      sealed.start(suction(),
                   area() * (height_of_lid() -
                             mudline.mean_height(Mudline::Side::plug)) -
                     sealed.cavity(),
                   displaced);
    sealed.advance(dt,
                   displaced,
                   {flow.plug_rate, flow.scale * flow.out, flow.response},
                   suction_.cavitation(height_of_lid()));
    suction_.set(sealed.suction());
  }

  double
  LidCompartment::area() const
  {
    const double inner = scene.body.shape().left();
    return pi * inner * inner;
  }

  void
  LidCompartment::update_exit_gradient(
    const Mudline                  &mudline,
    const std::vector<Conductance> &permeability,
    const NodalData                &outflow)
  {
    const double wall  = scene.body.shape().left(),
                 width = scene.body.penetration();
    exit =
      exit_gradient(scene.grid, mudline, permeability, outflow, wall, width);
  }

  void
  LidCompartment::update_limits(const Mudline &now, const WaterFlow &flow)
  {
    if (flow.flows)
      withstood = plug_strength.find(now);
    if (is_sealed())
      return;
    const double gradient = suction() > least_lifting_suction() ?
                              flow.scale * std::max(exit.wall, exit.axis) :
                              0.;
    feasibility.update(
      {scene.body.penetration(),
       heave(now) - heave_by_wall(),
       suction(),
       withstood.surface > 0. ? gradient / withstood.surface : 0.,
       window_of_lift * scene.body.shape().right()});
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
  LidCompartment::columns(const Mudline &mudline, const WaterFlow &flow) const
  {
    // only the names are wanted before the flow is known
    const auto at_wall = [&](const Mudline::Side side) {
      return mudline.is_found() ? mudline.height_at_wall(side) : 0.;
    };
    const double rise   = heave(mudline);
    NamedNumbers result = {{"suction_Pa", suction()},
                           {"cavitation_suction_Pa",
                            suction_.cavitation(height_of_lid())},
                           {"suction_force_N", load()},
                           {"tip_water_force_N", flow.tip_force},
                           {"pore_pressure_factor", flow.pressure_factor}};
    const auto   add    = [&result](const NamedNumbers &more) {
      result.insert(result.end(), more.begin(), more.end());
    };
    if (flow.flows)
      add({{"exit_gradient_wall", flow.scale * exit.wall},
           {"exit_gradient_axis", flow.scale * exit.axis},
           {"critical_gradient", withstood.surface},
           {"seepage_flow_m3_s", flow.scale * flow.out},
           {"seepage_inflow_m3_s", flow.scale * flow.in},
           {"seepage_volume_m3", seepage_volume}});
    add({{"plug_heave_m", rise},
         {"mudline_at_inner_wall_m", at_wall(Mudline::Side::plug)},
         {"mudline_at_outer_wall_m", at_wall(Mudline::Side::beyond)},
         {"flow_iterations", 1. * flow.n_iterations}});
    add(plug_balance.columns(area() * rise));
    add(is_sealed() ? sealed.columns() : of_pump(rise));
    return result;
  }

  NamedNumbers
  LidCompartment::of_pump(const double rise) const
  {
    const double travel = scene.body.motion().travel(),
                 gas    = suction_.gas_expansion();
    return {{"required_suction_Pa", suction_.required()},
            {"pumped_volume_m3",
             seepage_volume + area() * (travel + rise) + gas - volume_at_start},
            {"gas_expansion_m3", gas}};
  }

  double
  LidCompartment::least_lifting_suction() const
  {
    return least_lifted_share * scene.body.penetration() *
           withstood.of_block() * scene.soil.unit_weight_of_water();
  }

  bool
  LidCompartment::carries_soil(const WaterFlow &flow) const
  {
    return suction() > least_lifting_suction() &&
           flow.scale * std::max(exit.wall, exit.axis) >
             near_critical * withstood.of_block();
  }

  void
  LidCompartment::warn(const std::string        &where,
                       const Mudline            &mudline,
                       const WaterFlow          &flow,
                       std::vector<std::string> &warnings)
  {
    const std::string bound =
      withstood.strength == 0. ?
        "the critical one" :
        "what weight and cohesion of the plug withstand, gradients of " +
          to_text(withstood.weight, 3) + " and " +
          to_text(withstood.strength, 3) + ",";
    if (holds_first(has_warned_of_piping, carries_soil(flow)))
      warnings.push_back(
        "the exit gradient exceeds " + percent(near_critical, 2) + " of " +
        bound + where +
        ": the flow carries nearly all of the soil. Piping may begin, which "
        "the program does not follow");
    if (holds_first(has_warned_of_cavity, sealed.cavity() > 0.))
      warnings.push_back(
        "water boils beneath the sealed lid" + where + ", at a suction of " +
        to_text(1e-3 * suction(), 4) +
        " kPa: the suction grows no more, and a cavity takes the place of the "
        "water");
    if (holds_first(has_warned_of_lift,
                    heave(mudline) >
                      heave_by_wall() + .02 * scene.body.shape().right()))
      warnings.push_back(
        suction() > 0. ?
          "the suction lifts the plug" + where +
            ": it rises by more than the wall displaces" :
          "the plug rises by more than the wall displaces" + where +
            ", before there is suction: see plug_inflow_m3 and "
            "plug_dilation_m3");
  }

  std::string
  LidCompartment::reason_to_end(const Mudline *mudline) const
  {
    if (scene.body.penetration() <= 0.)
      return "the caisson has left the soil, and water flows in below its "
             "skirt";
    if (is_sealed()) // soil may rest on the lid, and leave it again
      return "";
    // soil that has been piping or lifted is no plug that refuses
    const std::string refusal = feasibility.place() ? "" : " (refusal)";
    if (touched >= full_lid)
      return "the plug fills the caisson: soil bears on " +
             percent(full_lid, 2) + " of the lid" + refusal;
    if (mudline != nullptr &&
        mudline->mean_height(Mudline::Side::plug) >= height_of_lid())
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
                 stress   = weight / area();
    const ShownUnit force = unit_of_forces(weight),
                    unit  = unit_of_stresses(stress);
    return "on a lid of " + to_text(area(), 4) + " m2; the weight is " +
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

  double
  LidCompartment::heave(const Mudline &mudline) const
  {
    return has_started && mudline.is_found() ?
             mudline.mean_height(Mudline::Side::plug) - plug_height :
             0.;
  }

  double
  LidCompartment::heave_by_wall() const
  {
    const double outer = scene.body.shape().right(), area = pi * outer * outer;
    return scene.body.motion().travel() * (area - this->area()) / this->area();
  }
} // namespace CaissonMPM
