// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Frames of the material points and of the background grid for ParaView.
//
// The quantities of points are those of output/point_quantities.h that are
// drawn: SI units, stresses effective and positive in tension,
//   mean_stress = (rr + zz + tt) / 3,
//   deviator    = sqrt(3 J2),  J2 = s:s / 2.
// The void ratio follows from the initial porosity n of the point's layer and
// its change of volume J: e = (1 + e0) J - 1 with e0 = n / (1 - n).
// whole_volume (m3) is the volume of a point for the whole circumference, in
// plane strain per meter.
#ifndef caisson_mpm_output_visualization_h
#define caisson_mpm_output_visualization_h

#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/body_points.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/materials/soil.h>

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * Writes points_0000.vtu and grid_0000.vtu, points_0001.vtu, ..., and the
   * series points.pvd and grid.pvd that list them with their times.
   *
   * A frame is listed only when both of its files are complete, and the
   * series are replaced at once: what a .pvd file names can be read, also
   * after a run that was killed. With several ranks each writes its own piece
   * (points_0000.1.vtu), and the series names the .pvtu file that collects
   * them.
   *
   * The points of the body are written among those of the soil, with
   * material -1.
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
     * Write one frame of the state at @p time. @p body_points are those at the start. Writes the grid's
     * vertices. Throws RunFailure naming the file that cannot be written.
     * Collective.
     */
    void
    write_frame(BackgroundGrid               &grid,
                const MaterialPoints         &points,
                const RigidBody              &body,
                const Soil                   &soil,
                const std::vector<BodyPoint> &body_points,
                const bool                    with_pore_pressure,
                const double                  time);

  private:
    using Frames = std::vector<std::pair<double, std::string>>;

    /** Forget the frames at and after this time. */
    void
    drop_frames_from(const double time);

    /** The number of the next frame: one more than that of the last one. */
    unsigned int
    next_number() const;

    void
    write_series(const std::string &name, const Frames &frames) const;

    std::string directory;
    Frames      point_frames, grid_frames;
  };
} // namespace CaissonMPM

#endif
