// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soil in its loosest state: what the laws bear there, with a gap and without,
// and how a cell shares its growth out among its points.
#include "kernel_scene.h"
#include "law_test.h"

namespace
{
  /** One point under isotropic strain. */
  template <typename Law>
  struct Sphere
  {
    typename Law::Parameters parameters;
    double                   pressure, void_ratio;
    double                   elastic = 0., plastic = 0.; // growth
    double                   variable[n_state_variables] = {};

    void
    strain(const double volumetric)
    {
      const double        d = volumetric / 3.;
      StressState<Scalar> sigma{-pressure, -pressure, -pressure, 0.};
      LawState<Scalar>    state;
      state.plastic_deviatoric = state.plastic_volumetric = Scalar(0.);
      state.void_ratio                                    = Scalar(void_ratio);
      for (int i = 0; i < n_state_variables; ++i)
        state.variable[i] = Scalar(variable[i]);
      Law::update(sigma,
                  StrainIncrement<Scalar>{d, d, d, 0.},
                  state,
                  parameters);
      for (int i = 0; i < n_state_variables; ++i)
        variable[i] = state.variable[i][0];
      plastic += state.plastic_volumetric[0];
      elastic += volumetric - state.plastic_volumetric[0];
      pressure   = -(sigma.rr[0] + sigma.zz[0] + sigma.tt[0]) / 3.;
      void_ratio = (1. + void_ratio) * (1. + volumetric) - 1.;
    }

    double
    loosest() const
    {
      const StressState<Scalar> sigma{-pressure, -pressure, -pressure, 0.};
      return Law::loosest_void_ratio(sigma, parameters)[0];
    }
  };

  /** Tear soil apart and press it together again. @p tolerance: of the void
   * ratio at which it bears, in steps of 1/4000 of the volume. */
  template <typename Law>
  void
  check_gap(const double *values,
            const double  void_ratio,
            const double  tolerance)
  {
    Sphere<Law>      soil = {read_parameters<Law>(values), 5e4, void_ratio};
    constexpr int    n    = 2000;
    constexpr double step = .5 / n;
    for (int i = 0; i < n; ++i)
      soil.strain(step);
    std::printf("%s\n", Law::name);
    verdict("stress of a gap", std::abs(soil.pressure), 1e-6);
    double too_loose = 0.;
    while (soil.void_ratio > void_ratio)
      {
        soil.strain(-step);
        if (soil.pressure > 1.)
          raise(too_loose, soil.void_ratio / soil.loosest() - 1.);
      }
    verdict("soil that bears is not looser", too_loose, tolerance);
    std::printf("it bears again: %s\n", soil.pressure > 5e3 ? "yes" : "no");
  }

  /** The plastic strain follows the gap, so that the elastic one is that of the
   * pressure. */
  void
  check_plastic_strain(const double *values, const double void_ratio)
  {
    Sphere<MohrCoulomb> soil = {read_parameters<MohrCoulomb>(values),
                                5e4,
                                void_ratio};
    for (int i = 0; i < 2000; ++i)
      soil.strain(1e-4);
    while (soil.pressure == 0.)
      soil.strain(-1e-4);
    verdict("elastic strain of a gap that has closed",
            std::abs(soil.elastic +
                     (soil.pressure - 5e4) / soil.parameters.bulk),
            1e-12);
  }

  /** Elastic steps along the loosest state lose nothing. */
  void
  check_elastic_steps(const double *values, const double e_max)
  {
    using Law             = MohrCoulomb;
    Sphere<Law>      soil = {read_parameters<Law>(values), 0., e_max};
    constexpr double step = 1e-5;
    constexpr int    n    = 400;
    for (int i = 0; i < n; ++i)
      soil.strain(-step);
    const double loaded = soil.pressure;
    for (int i = 0; i < n / 2; ++i)
      soil.strain(step);
    for (int i = 0; i < n / 2; ++i)
      soil.strain(-step);
    verdict("pressure after an elastic cycle",
            std::abs(soil.pressure / loaded - 1.),
            1e-4);
  }

  /** Triaxial compression: dilation ends at the loosest state. */
  void
  check_dilation(const double *values, const double void_ratio)
  {
    using Law = MohrCoulomb;
    Sample<Law> soil(read_parameters<Law>(values), 1e5, void_ratio);
    double      too_loose = 0., last = 0.;
    for (int i = 0; i < 4000; ++i)
      {
        const double before = soil.void_ratio;
        soil.strain_at_lateral_stress(-1e5, -5e-4);
        const double loosest = Law::loosest_void_ratio(
          StressState<Scalar>{soil.lateral, soil.axial, soil.lateral, 0.},
          soil.parameters)[0];
        raise(too_loose, soil.void_ratio / loosest - 1.);
        last = soil.void_ratio - before;
      }
    verdict("soil that dilates is not looser", too_loose, 1e-3);
    verdict("it shears at constant volume", std::abs(last), 1e-9);
  }

  // ------------------------------------------------------------ cells

  constexpr double e_0 = .6, e_max = .8;

  /** Every third point has dilated past the loosest state if there is one. */
  bool
  is_loose(const unsigned int i)
  {
    return i % 3 == 0;
  }

  /** The relative volume changes of all points in one step of the field
   * (rate r, rate z). */
  std::vector<double>
  volume_changes(Scene s, const double largest, const double rate)
  {
    const double values[] = {E, nu, 30., 10., 0., 0., largest};
    set_law<MohrCoulomb>(s.material, read_parameters<MohrCoulomb>(values));
    s.material.initial_void_ratio = e_0;
    fill_blocks(s);
    unsigned int i = 0;
    for_all(s, [&](PointBlock &block, int lane, const Point &p) {
      PointHistory &history        = s.histories[&block - s.blocks.data()];
      const double  e              = is_loose(i++) ? e_max + .01 : e_0;
      history.initial_volume[lane] = p.volume * (1. + e_0) / (1. + e);
    });
    update(
      s,
      *select_kernels("auto"),
      {1e-3, 1., true, 0., 0.},
      [rate](const double r, const double z) {
        return std::array<double, 2>{{rate * r, rate * z}};
      },
      std::vector<CellMoments>(n_cells, CellMoments()));
    std::vector<double> changes;
    for_all(s, [&](PointBlock &block, int lane, const Point &p) {
      changes.push_back(block.volume[lane] / p.volume - 1.);
    });
    return changes;
  }

  void
  check_cells(const double axisymmetric)
  {
    const Scene s     = make_scene(axisymmetric, false);
    const auto  all   = volume_changes(s, 10., 1.),
               shared = volume_changes(s, e_max, 1.),
               shrunk = volume_changes(s, e_max, -1.),
               plain  = volume_changes(s, 10., -1.);
    double of_loose = 0., of_shrunk = 0.;
    double growth[n_cells] = {}, of_all[n_cells] = {};
    for (unsigned int i = 0; i < s.points.size(); ++i)
      {
        const Point &p = s.points[i];
        growth[p.cell] += p.volume * shared[i];
        of_all[p.cell] += p.volume * all[i];
        if (is_loose(i))
          raise(of_loose, std::abs(shared[i]));
        raise(of_shrunk, std::abs(shrunk[i] - plain[i]));
      }
    double of_cells = 0.;
    for (unsigned int c = 0; c < n_cells; ++c)
      raise(of_cells, std::abs(growth[c] / of_all[c] - 1.));
    verdict("growth of loose points", of_loose, 0.);
    verdict("growth of the cells", of_cells, 1e-12);
    verdict("points that shrink", of_shrunk, 1e-15);
  }
} // namespace

int
main()
{
  const double sand[] = {20e6, .25, 35., 10., 0., 0., .8};
  check_gap<MohrCoulomb>(sand, .6, 1e-6);
  check_plastic_strain(sand, .6);
  check_elastic_steps(sand, .8);
  check_dilation(sand, .6);
  using Hypoplastic = HypoplasticIntergranular;
  double defaults[n_entries<Hypoplastic>];
  for (int i = 0; i < n_entries<Hypoplastic>; ++i)
    defaults[i] = Hypoplastic::entries[i].entry.value;
  check_gap<Hypoplastic>(defaults, .75, 1e-6);
  check_cells(1.);
  check_cells(0.);
}
