// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A run that was made before this one, and which this one goes on after.
#ifndef caisson_mpm_simulation_installation_h
#define caisson_mpm_simulation_installation_h

#include <caisson_mpm/base/section.h>
#include <caisson_mpm/bodies/body_motion.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/simulation/physics_text.h>

#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The checkpoint of a run in another directory, with whose ground, body and
   * water this run begins, while its time and its sums begin at 0. The motion
   * may be another one, and so may everything else that does not decide the
   * state. The files of the other run are only read, so that any number of runs
   * can go on after it. The same on all ranks; not collective.
   */
  class Installation : public Section
  {
  public:
    Installation();

    /** Whether the scene names such a run. */
    bool
    is_given() const
    {
      return !directory_.empty();
    }

    const std::string &
    directory() const
    {
      return directory_;
    }

    /** Read the checkpoint. @p physics are the entries of this run. Throws
     * BadInput where there is no checkpoint, this run would overwrite it in
     * @p output_directory, or entries differ that decide the state. */
    void
    open(const std::string &output_directory, const std::string &physics);

    /** Return the checkpoint, after open(). */
    const Checkpoint &
    checkpoint() const
    {
      return *checkpoint_;
    }

    /** Return how a motion begins after it. */
    BodyMotion::InitialMotion
    end_of_motion() const;

    /** Return what the water was, as Water/Level has it. */
    std::string
    water_level() const;

    /** Return from what @p penetration the run goes on, with which changes, and who
     * computes the phases that follow it, in words. Units: m. */
    std::vector<std::string>
    messages(const double penetration) const;

  private:
    std::string
    changes_in_words() const;

    void
    refuse_changes() const;

    std::string               directory_, phases;
    std::optional<Checkpoint> checkpoint_;
    std::vector<ChangedEntry> changes;
  };
} // namespace CaissonMPM

#endif
