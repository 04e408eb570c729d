// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The material points of the soil.
#ifndef caisson_mpm_bodies_material_points_h
#define caisson_mpm_bodies_material_points_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/bodies/background_grid.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/soil.h>

#include <deal.II/particles/particle_handler.h>

#include <vector>

namespace CaissonMPM
{
  /** One material point, as the code outside the kernels sees it. */
  struct MaterialPoint
  {
    dealii::Point<2> position;
    double           velocity[2]        = {0., 0.};
    Stress           stress             = {{0., 0., 0., 0.}};
    double           mass               = 0.; // scaled, kg per radian
    double           volume             = 0.; // m3 per radian
    double           plastic_deviatoric = 0., plastic_volumetric = 0.;
    StateVariables   state = {}; // of the material law
    dealii::Point<2> initial_position;
    double           initial_volume = 0.;
    double           id             = 0.;
    unsigned int     material       = 0;

    double
    void_ratio(const double initial_void_ratio) const
    {
      return (1. + initial_void_ratio) * volume / initial_volume - 1.;
    }
  };

  /**
   * All material points of the soil.
   *
   * deal.II's Particles::ParticleHandler generates, stores and writes them.
   * Between those moments they lie in blocks of eight per cell and material
   * (kernels/layout.h), and the handler is empty or out of date: load() brings
   * the points from the handler to the blocks, and store() back. Only this
   * class and the kernels know the blocks.
   *
   * Invariants: of the blocks of one cell and material all but the last are
   * full; every point lies in the cell that owns its block, up to round-off;
   * cells of the body hold none. The blocks of a cell may lie anywhere; now and
   * then they are put in the order of the cells.
   */
  class MaterialPoints
  {
  public:
    /** The properties of a particle in the handler, in this order. */
    static constexpr unsigned int n_properties =
      15 + Kernels::n_state_variables;

    explicit MaterialPoints(BackgroundGrid &grid);

    /** Make the handler empty and ready for insert(). */
    void
    clear_handler();

    /** Insert a point of the given cell into the handler. */
    void
    insert(const unsigned int cell, const MaterialPoint &point);

    /** Bring all particles of the handler into blocks. Collective. */
    void
    load();

    /** Bring all points into the handler. The grid's vertices must be written.
     * Collective. */
    void
    store();

    unsigned int
    n_points() const
    {
      return n_points_;
    }

    /** What the kernels work on. Valid until a point is added or moved. */
    Kernels::PointsView
    view();

    /** Room for the points that leave their cells in one step. */
    Kernels::LeavingPoints &
    leaving();

    /**
     * Bring the points listed in leaving() to the cells that they are in now.
     * A point that would enter the body is held back at its surface. Throws
     * RunFailure for a point that left the mesh or is not finite.
     */
    void
    relocate();

    /** Points that were held back at the body's surface, since the start. */
    unsigned long
    n_held_back() const
    {
      return n_held_back_;
    }

    /** Go on counting from here, after a restart. */
    void
    set_n_held_back(const unsigned long n)
    {
      n_held_back_ = n;
    }

    /** Call action(const MaterialPoint &, cell) for every point. */
    template <typename Action>
    void
    for_each(const Action &action) const
    {
      for (const unsigned int cell : active_cells)
        for (int b = first_block[cell]; b >= 0; b = headers[b].next)
          for (int lane = 0; lane < headers[b].count; ++lane)
            action(get(b, lane), cell);
    }

    /** Bytes that the points take, room for growth included. */
    double
    memory_consumption() const;

    dealii::Particles::ParticleHandler<2> handler;

  private:
    void
    add(const unsigned int cell, const MaterialPoint &point);
    MaterialPoint
    get(const int block, const int lane) const;
    void
    set(const int block, const int lane, const MaterialPoint &point);
    void
    copy_lane(const int from,
              const int from_lane,
              const int to,
              const int lane);
    void
    pad(const int block);
    int
    new_block(const unsigned int cell, const int after, const short material);
    void
    remove(const unsigned int cell, const int block, const int lane);
    unsigned int
    find_cell(unsigned int cell, MaterialPoint &point);
    [[noreturn]] void
    report_lost(const MaterialPoint &point) const;
    void
    collect_active_cells();
    void
    use_large_pages();
    void
    put_blocks_in_order();

    BackgroundGrid                    &grid;
    std::vector<Kernels::PointBlock>   blocks;
    std::vector<Kernels::BlockHeader>  headers;
    std::vector<int>                   free_blocks;
    std::vector<int>                   first_block;
    std::vector<unsigned int>          active_cells;
    std::vector<double>                filled_volume; // of the cells
    std::vector<unsigned char>         changed;       // the cells
    unsigned int                       n_relocations        = 0;
    bool                               active_cells_changed = true;
    std::vector<Kernels::LeavingPoint> leaving_storage;
    Kernels::LeavingPoints             leaving_view = {};
    unsigned int                       n_points_    = 0;
    unsigned long                      n_held_back_ = 0;
  };
} // namespace CaissonMPM

#endif
