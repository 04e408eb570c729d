// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The plain data that the kernels and the floors above share: material points
// (MPs), cells, nodes, the arguments of the kernels, and the kernels.
#ifndef caisson_mpm_kernels_layout_h
#define caisson_mpm_kernels_layout_h

#include <caisson_mpm/kernels/point_fields.h>

namespace CaissonMPM::Kernels
{
  /** What a material law may keep of a point besides its plastic strains. */
  constexpr int n_state_variables = 4;

  /** What plastic shear does to the volume of a soil. */
  enum class VolumeInShear : unsigned char
  {
    kept,
    gained,
    by_state // or it has no plastic shear
  };

  /** The stress that elasticity is a law for: that of the present area, or
   * J times that, J being the volume over that at the start. */
  enum class StressMeasure : unsigned char
  {
    cauchy,
    kirchhoff
  };

  /**
   * A soil material as the kernels see it. Which law reads the parameters
   * is chosen once per block.
   */
  struct Material
  {
    int    law;
    double body_force[2]; // acceleration of the scaled mass (m/s2)
    // lambda + 2 mu, the largest of all points, and water_modulus (Pa)
    double        p_wave_modulus;
    double        water_modulus  = 0.; // of the water in undrained soil (Pa)
    double        volume_damping = 0.; // 0 to 1: see find_mean_divergence()
    VolumeInShear volume_in_shear;
    bool          is_frictionless   = false; // no strength from pressure
    bool          has_loosest_state = false; // kernels/loosest_state.h
    StressMeasure stress_measure    = StressMeasure::cauchy;
    double        initial_void_ratio;
    double        initial_density; // of the scaled mass, kg/m3
    alignas(16) unsigned char parameters[384];
  };

  // -------------------------------------------------------------- points

  // MPs lie in blocks of eight per cell (structure of arrays): a block
  // belongs to one cell and one material. Lanes beyond the count of a block
  // are padding: they repeat a valid point with mass and volume zero, so that
  // kernels may compute on all lanes. A block is a particle of deal.II, with
  // these properties: the BlockHeader; what every step needs, the PointBlock;
  // what a step of most laws leaves alone, the PointHistory; and what a
  // user's law keeps.

  constexpr int block_size = 8;

// the members of a block, from the list of fields
#define CAISSON_LANES(name, ...) double name[block_size];
#define CAISSON_LISTED_LANES(name, n, ...) double name[n][block_size];

  /** The state of up to eight MPs. SI units; volume and mass per radian. */
  struct PointBlock
  {
    CAISSON_BLOCK_FIELDS(CAISSON_LANES, CAISSON_LISTED_LANES, CAISSON_LANES)
  };

  /** What a block keeps of the past of its MPs. SI units, volume per
   * radian. */
  struct PointHistory
  {
    CAISSON_HISTORY_FIELDS(CAISSON_LANES, CAISSON_LISTED_LANES, CAISSON_LANES)
  };
#undef CAISSON_LANES
#undef CAISSON_LISTED_LANES

  /** What the MPs of a block have in common, as numbers of deal.II. */
  struct BlockHeader
  {
    double material;
    double count; // of the MPs, besides padding
  };

  // ----------------------------------------------------- cells and nodes

  // A cell is a trapezoid whose two sides are vertical: r depends on xi only,
  //   r = left + width xi,   z = bottom(xi) + height(xi) eta,
  // with bottom and height linear in xi. Its inverse map is closed form.

  /** A trapezoid with vertical sides; heights of its left and right side. */
  struct alignas(64) CellGeometry
  {
    double left, width;
    double bottom_left, bottom_right;
    double height_left, height_right;
    double padding[2] = {}; // a cache line
  };

  /** The dofs of a cell's corners (0,0), (1,0), (0,1), (1,1). */
  struct CellNodes
  {
    unsigned int node[4];
  };

  /** How many cells may lie beyond a face of a cell, and beyond all four. */
  constexpr int neighbors_per_face = 2,
                neighbors_per_cell = 4 * neighbors_per_face;

  /** Options of the kernels for a cell. */
  enum CellFlags : unsigned char
  {
    next_to_body      = 1,
    at_corner_of_body = 2, // where just one cell of the body meets a node
    // sides that are faces of the body, but for the lid, in the order of
    // GridView::neighbors
    body_to_the_left  = 4,
    body_to_the_right = 8,
    body_below        = 16,
    body_above        = 32
  };

  /** The sums over the MPs of a cell, and what follows from them. */
  struct alignas(64) CellMoments
  {
    // integrals of 1, xi, eta, xi eta, xi2, eta2, xi2 eta, xi eta2, xi2 eta2
    // over the mass: the consistent mass matrix in nine numbers
    double mass[9];
    // integrals of 1, xi, eta, xi eta over the momentum in r, then in z
    double momentum[8];
    union
    {
      // sums for the internal force (kernels/moments.h), which
      // points_to_grid replaces by
      double internal[16];
      // the fit of a full cell: per component value, slope in x, slope in y
      double fit[12];
    };
    double full;    // share of the Gauss points in the integration
    double bounded; // share to which the fit is bounded
    bool   several_materials;
    short  material; // of the first MP
  };

  /** The nodal sums of points_to_grid, interleaved per node. */
  struct alignas(64) NodalSums
  {
    double mass;             // kg per radian
    double momentum[2];      // kg m/s per radian
    double force[2];         // internal + body force, N per radian
    double stiffness;        // bound of sum_J |K_IJ| over partly
                             // filled cells, N/m per radian
    double deformation_mass; // of selective mass scaling, kg per radian
    double padding;
  };

  /** A nodal vector field (r, z), interleaved per node. */
  struct NodalVector
  {
    double value[2];
  };

  // ------------------------------------------------ what kernels work on

  /** Objects at equal distances in memory. */
  template <typename Object>
  struct Rows
  {
    char *begin    = nullptr;
    long  distance = 0; // bytes

    Rows() = default;
    Rows(Object *const array, const long distance = sizeof(Object))
      : begin(reinterpret_cast<char *>(array))
      , distance(distance)
    {}

    Object &
    operator[](const int i) const
    {
      return *reinterpret_cast<Object *>(begin + i * distance);
    }
  };

  /**
   * All MPs of a rank. The view belongs to MaterialPoints::view() and is out
   * of date as soon as points are added, taken out or moved to other cells.
   */
  struct PointsView
  {
    Rows<PointBlock>   blocks;
    Rows<PointHistory> histories; // of the blocks
    Rows<BlockHeader>  headers;   // of the blocks
    const int         *next;      // block of the cell, -1 at the end
    // [n_cells], -1: none. For a ghost cell this is only a flag: 0 = its
    // owner has MPs there, -1 = none
    const int          *first_block;
    const unsigned int *active_cells; // [n_active_cells] cells with MPs
    unsigned int        n_active_cells;
    double             *filled_volume; // [n_cells], of the MPs in it
    unsigned char *changed; // [n_cells], whether MPs came or went: the cell's
                            // moments are not those of its MPs
    // [n_cells], blocks that the return to a yield surface took time for in
    // the last step
    unsigned short *n_yielding;
    // of the blocks [block_size][n_user_state]: what the user's law keeps
    // (UserState), if there is one
    Rows<double> user_state   = {};
    int          n_user_state = 0;

    int
    count(const int block) const
    {
      return static_cast<int>(headers[block].count);
    }
    int
    material(const int block) const
    {
      return static_cast<int>(headers[block].material);
    }
  };

  /** The cells that a rank knows, at one position of the moving grid. */
  struct GridView
  {
    const CellGeometry  *geometry; // [n_cells]
    const CellNodes     *nodes;    // [n_cells]
    const unsigned char *flags;    // [n_cells]
    // [n_cells][4][neighbors_per_face] soil cells left, right, below and
    // above; -1: none
    const int *neighbors;
    double     axisymmetric; // 1, or 0 in plane strain
  };

  /** A corner at which a cell sees another velocity than that of its node:
   * v' = V + (v - V)[free] q, with the velocity V of the body. */
  struct CornerView
  {
    unsigned int cell, corner, free;
    double       q[2], velocity[2];
  };

  /** Whether the slope of the mean stress in a full cell acts on its nodes.
   */
  enum class PressureSlope
  {
    by_dilation, // acts in soil that has not dilated
    acts,
    ignored
  };

  /** How the internal force is integrated. */
  struct IntegrationSettings
  {
    double        full_at_surface; // filled fraction from which a cell is full
    double        full_inside;     // the same away from free surfaces
    bool          has_minimum_nodal_mass; // sum the stiffness bound
    PressureSlope pressure_slope;
  };

  /** How grid_to_points updates the points. */
  struct UpdateSettings
  {
    double time_step;
    double keep_velocity;      // share of the MP's own velocity (FLIP 1)
    bool   mean_volume_change; // B-bar
    double limiter;            // k of |v| <= k H / dt; 0: off
    double stress_filter;      // share of the misfit removed; 0: off
  };

  /** What all kernels of a step work on. They write to the points and to the
   * moments, and read the rest. */
  struct StepContext
  {
    PointsView          points;
    GridView            grid; // at the start of the step
    const Material     *materials;
    IntegrationSettings integration;
    CellMoments        *moments; // [n_cells]
    // [n_nodes], mean filled fraction of the soil cells at a node
    const double *filled_at_node;
    // [n_corners], for grid_to_points
    const CornerView *corners   = nullptr;
    unsigned int      n_corners = 0;
    // [n_cells], excess pore pressure of undrained soil; null: none (Pa)
    const double *pore_pressure = nullptr;
    // [n_cells], by which the mass of the points counts as inertia in a
    // cell; null: 1
    const double *inertia = nullptr;
  };

  /** The factor of the inertia in a cell. */
  inline double
  inertia_in(const StepContext &step, const unsigned int cell)
  {
    return step.inertia != nullptr ? step.inertia[cell] : 1.;
  }

  /** The nodal velocities that update the points, each [n_nodes]. */
  struct NodalFields
  {
    const NodalVector *advection; // moves the MPs
    const NodalVector *transfer;  // added to keep_velocity * velocity
    const NodalVector *strain;    // its gradient strains the MPs
    double transfer_of_body = 1.; // share of the body's velocity in it
  };

  /** What grid_to_points needs besides the context of the step. */
  struct PointUpdate
  {
    GridView       moved; // the grid at the end of the step
    UpdateSettings settings;
    NodalFields    fields;
    // [n_cells], div v that strains the points, in the place of the mean of
    // the field; NaN or no list: that mean (1/s)
    const double *volume_rates = nullptr;
  };

  /** An MP that left its cell. */
  struct LeavingPoint
  {
    unsigned int cell;
    int          block;
    int          lane;
  };

  /** What grid_to_points returns: the MPs that left their cells, in room that
   * the caller provides, and sums over all MPs. */
  struct UpdateResult
  {
    LeavingPoint *leaving;     // [capacity]
    unsigned int  capacity;    // at least the number of all MPs
    unsigned int  n_leaving;   // entries of leaving that are in use
    unsigned int  n_limited;   // MPs whose velocity was cut
    double        stress_work; // of the total stress, J per radian
  };

  // ---------------------------------------------------------- a law of the
  // user

  /** The numbers of a point that the program keeps for a user's law, before
   * the law's own variables: where each of them begins. */
  namespace UserState
  {
    constexpr int modulus   = 0;  // the largest one so far, Pa
    constexpr int strain    = 1;  // rr, zz, tt, rz (engineering)
    constexpr int gradient  = 5;  // F - I: rr, rz, zr, zz, tt
    constexpr int variables = 10; // the law's own
  }                               // namespace UserState

  /** A point in a step. Tensors are rr, zz, tt, rz, in the axes after the
   * turn of the step; SI units. */
  struct UserPoint
  {
    double  stress[4];    // at the start of the step, and then at its end
    double  strain[4];    // the increment; rz is the engineering one
    double  gradient[5];  // dt L in the fixed axes: rr, rz, zr, zz, tt
    double  cosine, sine; // of the turn, from z to r
    double  place[2];     // r, z at the start of the step
    double  cell_size;
    double  id;
    double *state; // see UserState
  };

  /** Take a point to the end of the step; what fails is kept in @p law. */
  using UserLaw = void (*)(void *law, UserPoint &point);

  // -------------------------------------------------------------- the
  // kernels

  /** The kernels, compiled for one instruction set. */
  struct KernelTable
  {
    const char *name;
    int         width;

    /**
     * Add mass, momentum, internal and body force of all MPs to the nodes.
     * @p sums [n_nodes] must be zero on entry. The moments are those left by
     * grid_to_points but in changed cells; on return they are up to date, and
     * say how full the cells are.
     */
    void (*points_to_grid)(const StepContext &, NodalSums *sums);

    /**
     * Add the nodal forces of a pressure to @p out [n_nodes],
     *   out_I += int (grad N_I + e_r kappa N_I / r) p dV,
     * with p = sum_J N_J p_J of the nodal values @p pressure [n_nodes] in Pa,
     * integrated as the stress is: call it after points_to_grid. Units: N per
     * radian.
     */
    void (*pressure_force)(const StepContext &,
                           const double *pressure,
                           NodalVector  *out);

    /**
     * Add the nodal forces of a pore pressure, at the points of all cells, to
     * @p out [n_nodes],
     *   out_I -= sum_p V_p N_I(x_p) grad p(x_p),
     * with the nodal values @p pressure [n_nodes] in Pa. @p filled [n_cells]
     * is the share of the height below the free surface of the water, whose
     * pressure the upper corners of a cut cell have; cells with 0 have no
     * part in it. Units: N per radian.
     */
    void (*pressure_gradient_force)(const StepContext &,
                                    const double *pressure,
                                    const double *filled,
                                    NodalVector  *out);

    /**
     * out += M x with the consistent mass matrix of the MPs, out and x
     * [n_nodes].
     */
    void (*apply_mass)(const StepContext &,
                       const NodalVector *x,
                       NodalVector       *out);

    /**
     * Update velocity, stress, volume and position of all MPs, list those
     * outside their cell of the moved grid, and renew the moments for the
     * next step.
     */
    void (*grid_to_points)(const StepContext &,
                           const PointUpdate &,
                           UpdateResult &);

    /**
     * Raise @p largest to the p-wave modulus of the points of each material
     * whose stiffness varies, without the water. Units: Pa.
     */
    void (*largest_moduli)(const PointsView &,
                           const Material *materials,
                           double         *largest);
  };
} // namespace CaissonMPM::Kernels

#endif
