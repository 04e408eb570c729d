// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/selective_mass.h>
#include <caisson_mpm/operators/time_step.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>

#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;

  TimeStep::TimeStep()
    : Section("/Time")
  {
    add_parameter(
      "Courant number",
      courant,
      "",
      "The time step is this fraction of the stability limit of linear cells.",
      Patterns::Double(1e-6, 1.))
      .influence = Influence::motion;
    add_word_or_number(
      *this,
      "Time step",
      fixed_step,
      "auto",
      0.,
      "s",
      "The time step has this length; with auto it follows from the Courant "
      "number.",
      Patterns::Double(0.))
      .influence = Influence::motion;
    add_word_or_number(
      *this,
      "Inertia tolerance",
      tolerance,
      "none",
      0.,
      "",
      "The inertia of the smallest cells, mass scaling times density times the "
      "square of the velocity of the body, is this share of the initial "
      "vertical effective stress at the tip, without the surcharge, or, if no "
      "soil has friction, of half the least strength from there to four wall "
      "thicknesses above, 0.4 to 1.6 as a rule. A constant dilatancy angle psi "
      "divides it by exp(pi/2 tan psi). The scaling follows the penetration. Larger cells get "
      "less of it, and cells that the tip bends get more. The scaled inertia "
      "resists the deformation of cells, and hardly their translation. Mass "
      "scaling must then be 1.",
      Patterns::Double(1e-6, 10.))
      .influence = Influence::motion;
  }

  void
  TimeStep::initialize(const Kernels::KernelTable     &kernels,
                       const BackgroundGrid           &grid,
                       MaterialPoints                 &points,
                       const Soil                     &soil,
                       std::vector<Kernels::Material> &materials)
  {
    update_moduli(kernels, grid.communicator(), points, soil, materials);
    update_limit(grid, points, soil, materials);
    // The start of a run counts as a step. With a tolerance, the search is due
    // in the steps in which ranks may have repartitioned the mesh, so that it
    // comes in the same steps on any number of ranks.
    age = tolerance ? -1 : 1;
    if (!std::isfinite(limit) || limit <= 0.)
      throw BadInput("the stability limit of the time step is " +
                     to_text(limit) + " s, set by " + limiting_cell +
                     ". Check the stiffness and the densities of the soil, "
                     "and Soil/Fluid density." +
                     soil.cause_in_user_materials());
    if (is_too_large())
      throw BadInput(text_of_too_large_step() + soil.cause_in_user_materials());
  }

  double
  TimeStep::choose(const Kernels::KernelTable     &kernels,
                   const BackgroundGrid           &grid,
                   MaterialPoints                 &points,
                   const Soil                     &soil,
                   std::vector<Kernels::Material> &materials)
  {
    // The mesh moves slowly, and the search goes through all cells.
    if (++age == static_cast<int>(Intervals::time_step))
      {
        update_moduli(kernels, grid.communicator(), points, soil, materials);
        update_limit(grid, points, soil, materials);
      }
    if (is_too_large())
      throw RunFailure(text_of_too_large_step() +
                       soil.cause_in_user_materials());
    return step_size();
  }

  std::vector<std::string>
  TimeStep::known_limits() const
  {
    constexpr double usual = 2.;
    if (!tolerance || *tolerance <= usual)
      return {};
    return {"Time/Inertia tolerance above " + to_text(usual) +
            " was found to raise the total force by 4 to 8 % with 6; 0.4 to "
            "1.6 are usual"};
  }

  double
  TimeStep::inertia_for(const double stress_over_inertia) const
  {
    constexpr double largest = 1e6; // as for a number
    return std::clamp(*tolerance * stress_over_inertia, 1., largest);
  }

  double
  TimeStep::growth_of_step(const double stress_over_inertia,
                           const double growth_of_speed) const
  {
    if (fixed_step)
      return 1.;
    const double inertia =
      tolerance ? inertia_for(stress_over_inertia) / inertia_at_tip_ : 1.;
    return std::sqrt(inertia) / growth_of_speed;
  }

  std::string
  TimeStep::text_of_too_large_step() const
  {
    return "Time/Time step = " + to_text(*fixed_step) +
           " s exceeds the stability limit " + to_text(limit, 6) +
           " s, set by " + limiting_cell +
           ". Reduce it, or set it to auto for the stable one.";
  }

  void
  TimeStep::update_moduli(const Kernels::KernelTable     &kernels,
                          const MPI_Comm                  communicator,
                          MaterialPoints                 &points,
                          const Soil                     &soil,
                          std::vector<Kernels::Material> &materials)
  {
    margin_of_modulus.assign(materials.size(), 1.);
    // 1. the materials whose stiffness varies, if any
    bool any = false;
    for (unsigned int i = 0; i < materials.size(); ++i)
      any |= soil.material(i).stiffness_varies();
    if (!any)
      return;
    // 2. the largest modulus of the points of each of them, on all ranks
    std::vector<double> found(materials.size(), 0.);
    kernels.largest_moduli(points.view(), materials.data(), found.data());
    Utilities::MPI::max(found, communicator, found);
    // 3. what may come until the next update, and the water
    for (unsigned int i = 0; i < materials.size(); ++i)
      if (found[i] > 0.) // else no point is of this material
        {
          const double to_come = soil.material(i).modulus_to_come(found[i]);
          margin_of_modulus[i] = to_come / found[i];
          materials[i].p_wave_modulus = materials[i].water_modulus + to_come;
        }
  }

  namespace
  {
    /**
     * Frequencies in a cell, squared, over (2 c)^2, in 1/m2. The gradient in
     * the unit cell is J^-T, and the largest frequency of linear cells at most
     * 2 c |J^-1|: 1/dr^2 + 1/dz^2 where rows are level, more where they are
     * bent.
     */
    struct InverseSquareOfSize
    {
      explicit InverseSquareOfSize(const Kernels::CellGeometry &g)
      {
        const double h   = std::min(g.height_left, g.height_right);
        const double top = g.bottom_right + g.height_right - g.bottom_left -
                           g.height_left,
                     rise = std::max(std::abs(g.bottom_right - g.bottom_left),
                                     std::abs(top)) /
                            g.width,
                     across = 1. / (g.width * g.width), along = 1. / (h * h),
                     along_bent = along * (1. + rise * rise);
        with_level_rows         = across + along;
        bound                   = across + along_bent;
        of_row                  = std::max(across, along_bent);
      }

      /** Of a cell that is @p n times as large. */
      InverseSquareOfSize
      enlarged(const double n) const
      {
        InverseSquareOfSize result = *this;
        for (double *x :
             {&result.with_level_rows, &result.bound, &result.of_row})
          *x /= n * n;
        return result;
      }

      /** What limits the step, with what the transfer makes of the shortest
       * wave of a row. */
      double
      with_transfer(const double narrowing) const
      {
        return std::max(bound, narrowing * of_row);
      }

      double with_level_rows, bound;
      double of_row; // of the shortest wave of a row of cells
    };

    /**
     * (omega dt)^2 must be less than 4 over this, in soil that takes the
     * share @p d of its strain from the new velocities of the nodes and the
     * rest from those that the points bring back. They bring the share a of the
     * shortest wave of a row of cells back, so that in a step
     *   s += w ((1 - d) v+ + d (v - w s)),   v+ = v - a w s,   w = omega dt.
     */
    double
    narrowing_by_transfer(const double d)
    {
      constexpr double n = 2.; // points per direction; more allow 2 % more
      constexpr double a = (1. - 1. / (n * n)) / 3.;
      return a + 2. * d * (1. - a);
    }

    /** c^2 = (lambda + 2 mu) / rho of each material, the water included or
     * not; the stiffness of the points changes p_wave_modulus. Units: m2/s2. */
    std::vector<double>
    squares_of_waves(const Soil                           &soil,
                     const std::vector<Kernels::Material> &materials,
                     const bool                            with_water)
    {
      std::vector<double> squares;
      for (unsigned int i = 0; i < soil.n_materials(); ++i)
        squares.push_back((materials[i].p_wave_modulus -
                           (with_water ? 0. : materials[i].water_modulus)) /
                          soil.inertial_density(i));
      return squares;
    }

    /** The largest of the @p values of the materials in a cell. */
    double
    largest_in(const MaterialPoints      &points,
               const unsigned int         cell,
               const std::vector<double> &values)
    {
      double largest = 0.;
      points.for_each_material(cell, [&](const unsigned int material) {
        largest = std::max(largest, values[material]);
      });
      return largest;
    }

    std::string
    describe(const BackgroundGrid &grid,
             const unsigned int    cell,
             const double          speed)
    {
      const auto &g    = grid.geometry(cell);
      const auto  text = [](const double x) { return to_text(x, 6); };
      return "the cell at r = " + text(g.left) +
             " m, z = " + text(g.bottom_left) + " m of the " +
             GridLines::name_of(grid.zone(cell)) + " zone, " + text(g.width) +
             " m x " + text(std::min(g.height_left, g.height_right)) +
             " m, wave speed " + text(speed) + " m/s";
    }
  } // namespace

  std::vector<double>
  TimeStep::narrowing_of(const std::vector<Kernels::Material> &materials) const
  {
    // The Courant number is the margin of a bound. The limit of the transfer is
    // sharp: points that have moved within their cells change it by 3 %, and a
    // modulus that varies has its own margin.
    constexpr double    margin = .97;
    const double        excess = fixed_step ? 1. : courant / margin;
    std::vector<double> narrowing;
    for (unsigned int i = 0; i < materials.size(); ++i)
      narrowing.push_back(excess * excess / margin_of_modulus[i] *
                          narrowing_by_transfer(strains_with_new_velocities ?
                                                  1. :
                                                  materials[i].volume_damping));
    return narrowing;
  }

  void
  TimeStep::update_inertia(const BackgroundGrid      &grid,
                           const MaterialPoints      &points,
                           const std::vector<double> &squares,
                           const std::vector<double> &narrowing)
  {
    // Soil that is heavier than what lies around it reflects its own waves, and
    // swings on it. So the factor falls slowly, with the size of the cells to
    // the power 2/3, although the step allows the square; cells up to twice as
    // large keep all of it. Cells that are bent beneath the tip, or elongated,
    // get what their step needs. Halved cells have twice the factor of their
    // parents: the error of the tip force follows the factor there, that of the
    // friction the factor beside the wall, which is thus smaller for the same
    // step.
    constexpr double margin = 4.;
    const auto halved = [&](const unsigned int cell) { // 2 to the power of that
      return static_cast<double>(1u << grid.cell_iterator(cell)->level());
    };
    const auto size_of_ancestor = [&](const unsigned int cell) {
      return InverseSquareOfSize(grid.geometry(cell)).enlarged(halved(cell));
    };
    double worst = 0.;
    for (const unsigned int cell : points.cells_with_points())
      worst = std::max(worst,
                       largest_in(points, cell, squares) *
                         size_of_ancestor(cell).with_level_rows);
    worst           = Utilities::MPI::max(worst, grid.communicator());
    inertia_at_tip_ = inertia_for(stress_over_inertia_at_tip());
    least_inertia   = least_inertia > 0. ?
                        std::min(least_inertia, inertia_at_tip_) :
                        inertia_at_tip_;
    largest_inertia = std::max(largest_inertia, inertia_at_tip_);
    const auto set  = [&](const unsigned int cell,
                         const double       square,
                         const double       narrowing) {
      const auto   size = size_of_ancestor(cell);
      const double level =
                     std::cbrt(margin * square * size.with_level_rows / worst),
                   needed = square * size.with_transfer(narrowing) / worst;
      inertia_[cell]      = std::max(1.,
                                inertia_at_tip_ * halved(cell) *
                                  std::max(std::min(level, 1.), needed));
    };
    // 1. cells that points may enter until the next time: of the fastest wave
    const double fastest = *std::max_element(squares.begin(), squares.end()),
                 most = *std::max_element(narrowing.begin(), narrowing.end());
    inertia_.resize(grid.n_cells());
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (!grid.is_rigid(cell))
        set(cell, fastest, most);
    // 2. cells with points: of the fastest wave in them
    for (const unsigned int cell : points.cells_with_points())
      set(cell,
          largest_in(points, cell, squares),
          largest_in(points, cell, narrowing));
    translation = factors_of_translation(grid, inertia_);
  }

  void
  TimeStep::update_limit(const BackgroundGrid                 &grid,
                         const MaterialPoints                 &points,
                         const Soil                           &soil,
                         const std::vector<Kernels::Material> &materials)
  {
    // 1. c^2 of each material, with and without the water
    const std::vector<double> squares = squares_of_waves(soil, materials, true),
                              squares_of_soil =
                                squares_of_waves(soil, materials, false);
    const std::vector<double> narrowing = narrowing_of(materials);
    if (tolerance)
      update_inertia(grid, points, squares, narrowing);
    // 2. the largest c^2 (1/dr^2 + 1/dz^2) over the inertia, of the stiffest
    //    material in each cell of this rank, and at least what the transfer
    //    needs; the same without the water, and by zone without the inertia
    unsigned int        limiting = 0;
    double              worst = 0., worst_of_soil = 0., speed = 0.; // 1/s2, m/s
    std::vector<double> worst_of_zone(GridLines::n_zones, 0.);
    for (const unsigned int cell : points.cells_with_points())
      {
        const double square  = largest_in(points, cell, squares),
                     of_soil = largest_in(points, cell, squares_of_soil);
        const double size =
                       InverseSquareOfSize(grid.geometry(cell))
                         .with_transfer(largest_in(points, cell, narrowing) *
                                        points.volume_ratio_in(cell)),
                     heavy     = tolerance ? size / inertia_[cell] : size,
                     frequency = square * heavy;
        worst_of_soil          = std::max(worst_of_soil, of_soil * heavy);
        double &of_zone = worst_of_zone[static_cast<int>(grid.zone(cell))];
        of_zone         = std::max(of_zone, square * size);
        if (frequency > worst)
          {
            worst    = frequency;
            limiting = cell;
            speed    = std::sqrt(square);
          }
      }
    // 3. the limits, 1 / sqrt of the largest value on all ranks
    const MPI_Comm communicator = grid.communicator();
    Utilities::MPI::max(worst_of_zone, communicator, worst_of_zone);
    for (unsigned int zone = 0; zone < GridLines::n_zones; ++zone)
      limit_of_zone[zone] = 1. / std::sqrt(worst_of_zone[zone]);
    const auto of_all = Utilities::MPI::min_max_avg(worst, communicator);
    limit             = 1. / std::sqrt(of_all.max);
    limit_of_soil =
      1. / std::sqrt(Utilities::MPI::max(worst_of_soil, communicator));
    age = 0;

    // 4. the rank with the cell that limits the step describes it to all
    std::string text;
    if (of_all.max_index == Utilities::MPI::this_mpi_process(communicator))
      text = describe(grid, limiting, speed);
    limiting_cell =
      Utilities::MPI::broadcast(communicator, text, of_all.max_index);
  }

  std::vector<std::pair<std::string, double>>
  TimeStep::zone_limits() const
  {
    std::vector<std::pair<std::string, double>> result;
    for (unsigned int zone = 0; zone < GridLines::n_zones; ++zone)
      if (std::isfinite(limit_of_zone[zone]))
        result.emplace_back(GridLines::name_of(
                              static_cast<GridLines::Zone>(zone)),
                            limit_of_zone[zone]);
    return result;
  }
} // namespace CaissonMPM
