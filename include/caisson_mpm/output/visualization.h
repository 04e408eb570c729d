// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Frames of the material points, of the background grid and of the rigid body
// for ParaView: output/frame_data.h describes what is in them.
#ifndef caisson_mpm_output_visualization_h
#define caisson_mpm_output_visualization_h

#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/water/pore_water.h>

#include <array>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Writes points_0000.vtu, grid_0000.vtu and body_0000.vtu, points_0001.vtu,
   * ..., and the series points.pvd, grid.pvd and body.pvd that list them with
   * their times, and points_by_penetration.pvd and so on with the penetration
   * in the place of the time. Without a body the last of each and those by
   * penetration are missing. The files are the same on any number of ranks.
   *
   * A frame is listed only when all of its files are complete, and the series
   * are replaced at once: what a .pvd file names can be read, also after a run
   * that was killed.
   */
  class Visualization
  {
  public:
    /** The directory must exist. */
    explicit Visualization(const std::string &directory);

    /** Keep the frames of a previous run up to this time. Units: s. */
    void
    resume(const double time);

    /** Tells the lists of frames from others. */
    double
    fingerprint() const;

    /**
     * Write one frame of the state at @p time. Writes the grid's vertices. Throws
     * RunFailure naming the file that cannot be written. Collective.
     */
    void
    write_frame(const BackgroundGrid &grid,
                const MaterialPoints &points,
                const RigidBody      &body,
                const Soil           &soil,
                const PoreWater      &water,
                const double          time);

  private:
    struct Frame
    {
      double      time; // s
      std::string file;
      double      penetration; // m; nan: unknown, or there is no body
    };
    struct Series
    {
      std::string        name;
      std::vector<Frame> frames;
    };

    /** Forget the frames at and after this time. */
    void
    drop_frames_from(const double time);

    /** The number of the next frame: one more than that of the last one. */
    unsigned int
    next_number() const;

    void
    write_series(const Series &series) const;

    std::string           directory;
    std::array<Series, 3> all_series; // of points, grid and body
  };
} // namespace CaissonMPM

#endif
