// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/water/plug.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_slices = 100;
    // Nearer to the critical gradient than this, no margin is left: the suction
    // is not known better.
    constexpr double near_critical = .9;
    // A flow that lifts less than this share of the plug is ignored.
    constexpr double least_lifted_share = .1;
  } // namespace

  Plug::Plug(const WaterScene &scene)
    : scene(scene)
  {
    RunTotals &totals = scene.totals;
    totals.carry("plug_has_started", has_started);
    totals.carry("plug_height_at_start", height_at_start);
    totals.carry("plug_soil_at_start", volume_at_start.initial);
    totals.carry("plug_volume_at_start", volume_at_start.present);
    totals.carry("plug_clay_lost_at_start", volume_at_start.lost_by_clay);
    totals.carry("plug_volume_lost_by_clay", lost_by_clay);
    totals.keep("has_warned_of_piping", has_warned_of_piping);
    totals.keep("has_warned_of_lift", has_warned_of_lift);
  }

  void
  Plug::start(const SoilColumns &soil_columns)
  {
    if (has_started)
      return;
    has_started     = true;
    height_at_start = soil_columns.mean_height(SoilColumns::Side::plug);
    volume_at_start = find_volume();
  }

  double
  Plug::area() const
  {
    const double inner = scene.body.shape().left();
    return pi * inner * inner;
  }

  double
  Plug::heave(const SoilColumns &soil_columns) const
  {
    return has_started && soil_columns.is_found() ?
             soil_columns.mean_height(SoilColumns::Side::plug) -
               height_at_start + lost_by_clay / area() :
             0.;
  }

  double
  Plug::extra_heave(const SoilColumns &soil_columns) const
  {
    const double outer = scene.body.shape().right(), all = pi * outer * outer;
    return heave(soil_columns) -
           scene.body.motion().travel() * (all - area()) / area();
  }

  // ------------------------------------------------------------ balance

  Plug::Volume
  Plug::find_volume() const
  {
    const double radius     = scene.body.shape().left(),
                 tip        = -scene.body.penetration();
    const bool is_coupled   = scene.settings.level == WaterLevel::coupled;
    const auto keeps_volume = [&](const MaterialPoint &p) {
      return !is_coupled &&
             scene.soil.material(p.material).has_undrained_strength();
    };
    const auto share_inside = [&](const MaterialPoint &p) {
      const double inside = radius - p.position[radial];
      if (p.position[vertical] > tip)
        return inside > 0. ? 1. : 0.;
      return std::clamp(.5 + inside / p.size[radial], 0., 1.);
    };
    Volume sum;
    for (const unsigned int cell : scene.points.cells_with_points())
      if (scene.grid.geometry(cell).left - scene.grid.geometry(cell).width <
          radius)
        scene.points.for_each_in(cell, [&](const MaterialPoint &p) {
          const double share = share_inside(p);
          sum.initial += share * p.initial_volume;
          sum.present += share * p.volume;
          if (keeps_volume(p))
            sum.lost_by_clay += share * (p.initial_volume - p.volume);
        });
    for (double *const value : {&sum.initial, &sum.present, &sum.lost_by_clay})
      *value = scene.grid.circumference() *
               Utilities::MPI::sum(*value, scene.grid.communicator());
    return sum;
  }

  NamedNumbers
  Plug::balance(const SoilColumns &soil_columns)
  {
    double inflow = 0., dilation = 0.;
    if (has_started)
      {
        const Volume now = find_volume();
        lost_by_clay =
          std::max(0., now.lost_by_clay - volume_at_start.lost_by_clay);
        inflow = now.initial - volume_at_start.initial;
        dilation =
          now.present - volume_at_start.present - inflow + lost_by_clay;
      }
    const double rise = area() * heave(soil_columns);
    const double largest =
      std::max({std::abs(rise), std::abs(inflow), std::abs(dilation)});
    const double error = rise - inflow - dilation;
    return {{"plug_heave_volume_m3", rise},
            {"plug_inflow_m3", inflow},
            {"plug_dilation_m3", dilation},
            {"plug_balance_error", largest > 0. ? error / largest : 0.}};
  }

  // ------------------------------------------------------------ exit gradient

  namespace
  {
    /** A part of the mudline of the plug; extensive values per radian. */
    struct Outlet
    {
      double r            = 0.; // m
      double flow         = 0.; // out of the soil, m2/s or that over a pressure
      double conductivity = 0.; // permeability times area, m3/s

      bool
      operator<(const Outlet &other) const
      {
        return r < other.r;
      }

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &r &flow &conductivity;
      }
    };

    /** The outlets at the nodes of all ranks, from the axis to the wall. */
    std::vector<Outlet>
    find_outlets(const BackgroundGrid           &grid,
                 const SoilColumns              &soil_columns,
                 const std::vector<Conductance> &permeability,
                 const NodalData                &outflow)
    {
      NodalData conductivity;
      grid.reinit(conductivity, 1);
      for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
        {
          if (!grid.is_owned(cell) || !soil_columns.is_top(cell) ||
              soil_columns.side_of(cell) != SoilColumns::Side::plug)
            continue;
          const auto &node = grid.cell_nodes(cell).node;
          const auto  area =
            areas_of_side(grid.geometry(cell), grid.axisymmetric());
          for (unsigned int i = 0; i < 2; ++i)
            conductivity.local_element(node[2 + i]) +=
              permeability[cell].vertical * area[i];
        }
      conductivity.compress(VectorOperation::add);
      std::vector<Outlet> own, all;
      for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
        if (conductivity.local_element(node) > 0.)
          own.push_back({grid.r_of(node),
                         outflow.local_element(node),
                         conductivity.local_element(node)});
      for (const auto &of_rank :
           Utilities::MPI::all_gather(grid.communicator(), own))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      std::sort(all.begin(), all.end());
      return all;
    }

    /** Fit i = a + b d^2 over the distance d < @p width from @p wall, each
     * outlet weighted with its conductivity times 1 - (d / width)^2, and return
     * a. Units: m. */
    double
    gradient_at_wall(const std::vector<Outlet> &outlets,
                     const double               wall,
                     const double               width)
    {
      double one = 0., x = 0., xx = 0., i = 0., ix = 0.;
      for (const Outlet &o : outlets)
        {
          const double d = (wall - o.r) / width, square = d * d,
                       share = std::max(0., 1. - square);
          one += share * o.conductivity;
          x += share * o.conductivity * square;
          xx += share * o.conductivity * square * square;
          i += share * o.flow;
          ix += share * o.flow * square;
        }
      const double determinant = one * xx - x * x;
      // no other node within the width
      if (determinant <= 1e-9 * one * one)
        return outlets.back().flow / outlets.back().conductivity;
      return (i * xx - ix * x) / determinant;
    }
  } // namespace

  void
  Plug::find_exit_gradient(const SoilColumns              &soil_columns,
                           const std::vector<Conductance> &permeability,
                           const NodalData                &outflow)
  {
    const auto outlets =
      find_outlets(scene.grid, soil_columns, permeability, outflow);
    exit_ = {};
    if (!outlets.empty())
      exit_ = {gradient_at_wall(outlets,
                                scene.body.shape().left(),
                                scene.body.penetration()),
               outlets.front().flow / outlets.front().conductivity};
  }

  double
  Plug::lifting_gradient(const double scale, const double suction) const
  {
    const double least = least_lifted_share * scene.body.penetration() *
                         withstood_.of_block() *
                         scene.soil.unit_weight_of_water();
    return suction > least ? scale * std::max(exit_.wall, exit_.axis) : 0.;
  }

  // ------------------------------------------------------------ strength

  void
  Plug::find_withstood(const SoilColumns &soil_columns)
  {
    withstood_        = {};
    const double wall = scene.body.shape().left(),
                 top  = soil_columns.height_at_wall(SoilColumns::Side::plug),
                 embedment = top + scene.body.penetration(),
                 width     = .5 * embedment,
                 gamma_w   = scene.soil.unit_weight_of_water();
    if (embedment <= 0.)
      return;
    // sums over the points of each slice of the depth, beside the wall; per
    // radian, and the least tension that the soil bears
    std::vector<double> volumes(n_slices, 0.), weights(n_slices, 0.),
      cohesions(n_slices, 0.),
      tensions(n_slices, std::numeric_limits<double>::max());
    const auto add = [&](const MaterialPoint &p) {
      const double to_wall = wall - p.position[radial],
                   depth   = (top - p.position[vertical]) / embedment;
      if (to_wall < 0. || to_wall > width || depth > 1.)
        return;
      const unsigned int  i = std::clamp(depth, 0., .999) * n_slices;
      const SoilMaterial &m = scene.soil.material(p.material);
      volumes[i] += p.volume;
      weights[i] += p.volume * scene.soil.unit_weight(m);
      cohesions[i] += p.volume * m.shear_strength.value_or(0.);
      tensions[i] = std::min(tensions[i], m.tension());
    };
    for (const unsigned int cell : scene.points.cells_with_points())
      if (scene.grid.geometry(cell).left < wall)
        scene.points.for_each_in(cell, add);
    for (auto *sums : {&volumes, &weights, &cohesions})
      Utilities::MPI::sum(*sums, scene.grid.communicator(), *sums);
    Utilities::MPI::min(tensions, scene.grid.communicator(), tensions);

    double volume = 0., weight = 0., cohesion = 0.;
    for (unsigned int i = 0; i < n_slices; ++i)
      {
        if (volumes[i] == 0.)
          continue;
        volume += volumes[i];
        weight += weights[i];
        cohesion += cohesions[i];
        const double depth          = embedment * (i + 1) / n_slices,
                     side           = 2. / embedment * cohesion / volume;
        const bool         is_first = withstood_.surface == 0.;
        WithstoodGradients of_block = {withstood_.surface,
                                       weight / volume / gamma_w,
                                       (tensions[i] / depth + side) / gamma_w};
        if (is_first)
          of_block.surface = of_block.weight;
        if (is_first || of_block.of_block() < withstood_.of_block())
          withstood_ = of_block;
      }
  }

  // ------------------------------------------------------------ warnings

  void
  Plug::warn(const std::string        &where,
             const SoilColumns        &soil_columns,
             const double              scale,
             const double              suction,
             std::vector<std::string> &warnings)
  {
    const std::string bound =
      withstood_.strength == 0. ?
        "the critical one" :
        "what weight and cohesion of the plug withstand, gradients of " +
          to_text(withstood_.weight, 3) + " and " +
          to_text(withstood_.strength, 3) + ",";
    if (holds_first(has_warned_of_piping,
                    lifting_gradient(scale, suction) >
                      near_critical * withstood_.of_block()))
      warnings.push_back(
        "the exit gradient exceeds " + percent(near_critical, 2) + " of " +
        bound + where +
        ": the flow carries nearly all of the soil. Piping may begin, which "
        "the program does not follow");
    if (holds_first(has_warned_of_lift,
                    extra_heave(soil_columns) >
                      .02 * scene.body.shape().right()))
      warnings.push_back(
        suction > 0. ?
          "the suction lifts the plug" + where +
            ": it rises by more than the wall displaces" :
          "the plug rises by more than the wall displaces" + where +
            ", before there is suction: see plug_inflow_m3 and "
            "plug_dilation_m3");
  }
} // namespace CaissonMPM
