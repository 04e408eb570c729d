// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The soil beneath the lid of a caisson: how far it rises and why, the gradient
// of the water that flows out of it, and what holds it against that.
#ifndef caisson_mpm_water_plug_h
#define caisson_mpm_water_plug_h

#include <caisson_mpm/water/cell_integrals.h>
#include <caisson_mpm/water/pore_water.h>
#include <caisson_mpm/water/soil_columns.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** The upward hydraulic gradient at the mudline of the plug, at the wall and
   * at the axis. */
  struct ExitGradient
  {
    double wall = 0., axis = 0.;
  };

  /** Upward hydraulic gradients that the plug withstands. */
  struct WithstoodGradients
  {
    double surface  = 0.; // by its weight, of the soil at its surface
    double weight   = 0.; // of the block that is lifted first: by its weight,
    double strength = 0.; // and by its cohesion

    double
    of_block() const
    {
      return weight + strength;
    }
  };

  /**
   * The balance of the plug is that of the cylinder within the inner radius of
   * the caisson, from the bottom of the mesh, through which no soil passes, to
   * the mudline of the plug. Soil passes only through its side beneath the tip.
   * So
   *
   *   heave of the mudline * area = inflow + dilation,
   *
   * where the inflow is the change of the sum of the initial volumes of the
   * points inside, which is that of their mass, and the dilation the change of
   * the sum of present minus initial volumes. Without coupled water, clay of
   * undrained strength keeps its volume: what it has lost in a law by total
   * stress, with a Poisson's ratio below 0.5, is added to the dilation, and to
   * the heave over the area. The mudline is found from the tops of the highest
   * points and not from volumes: the difference of both sides is an error of
   * the mudline, or of the volumes, which may leave gaps or overlap. Beneath
   * the tip, a point counts with the share of its width that is inside. Whole
   * points would make the inflow jump by a row of points at a time: in
   * prm/jack_coarse.prm, by a quarter of it after half a meter.
   *
   * Water lifts one block of the plug first (Terzaghi's heave): one beside the
   * wall from the surface down to a depth h, as wide as half of the embedment
   * w. A gradient i pulls on it with i gamma_w h per area; its buoyant weight
   * holds it, the tension that the soil at its base bears, and the cohesion on
   * its side in the plug, i = (int gamma' dz + T(h) + 2/w int c dz) / (gamma_w
   * h), which is smallest for the block that matters. Friction on the side and
   * on the wall is left out of account. Layers are those of the points,
   * wherever they have come to.
   */
  class Plug
  {
  public:
    explicit Plug(const WaterScene &scene);

    /** Remember the soil below the @p soil_columns; only the first call counts.
     * Collective. */
    void
    start(const SoilColumns &soil_columns);

    /** The area within the wall. Units: m2. */
    double
    area() const;

    /** How far the surface has risen, with the volume that clay had lost at the
     * last balance(), and how far beyond what the soil that the wall displaces
     * would make it rise. Units: m. */
    double
    heave(const SoilColumns &soil_columns) const;

    double
    extra_heave(const SoilColumns &soil_columns) const;

    /**
     * Find the exit gradient of the flow @p outflow [n_nodes] out of the nodes,
     * which is more accurate than the gradient in the cell below. The one at
     * the wall is the value there of the even parabola i = a + b d^2 that fits
     * the flow over the embedment beside it, with weights that fall to zero
     * with it: no water crosses the wall, so that the gradient is even in the
     * distance d, and single nodes, which change when the mudline crosses a row
     * of cells, hardly matter. @p permeability [n_cells] in m/s. Collective.
     */
    void
    find_exit_gradient(const SoilColumns              &soil_columns,
                       const std::vector<Conductance> &permeability,
                       const NodalData                &outflow);

    /** Find which gradients the plug withstands; zeros where it has no point.
     * Collective. */
    void
    find_withstood(const SoilColumns &soil_columns);

    /** The last exit gradient, over the scale of its flow. */
    const ExitGradient &
    exit() const
    {
      return exit_;
    }

    const WithstoodGradients &
    withstood() const
    {
      return withstood_;
    }

    /** The larger exit gradient of a flow of this @p scale; 0 where the @p
     * suction is so small that its flow lifts no soil: the gradient of soil
     * that gives off hardly any water is noise. Units: Pa. */
    double
    lifting_gradient(const double scale, const double suction) const;

    /** Return the columns of the balance; all names and zeros before start().
     * Collective. */
    NamedNumbers
    balance(const SoilColumns &soil_columns);

    /** Append warnings of piping and lift at a flow of this @p scale. @p where:
     * at which penetration. */
    void
    warn(const std::string        &where,
         const SoilColumns        &soil_columns,
         const double              scale,
         const double              suction,
         std::vector<std::string> &warnings);

  private:
    /** The soil inside, and how much of it undrained clay has lost. */
    struct Volume
    {
      double initial = 0., present = 0., lost_by_clay = 0.; // m3
    };

    Volume
    find_volume() const;

    const WaterScene   scene;
    bool               has_started     = false;
    double             height_at_start = 0.; // m
    Volume             volume_at_start;
    double             lost_by_clay = 0.; // m3, since the start
    ExitGradient       exit_;
    WithstoodGradients withstood_;
    bool               has_warned_of_piping = false, has_warned_of_lift = false;
  };
} // namespace CaissonMPM

#endif
