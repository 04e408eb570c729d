// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The state of a run on disk, from which it can be resumed.
//
// Files in the output directory: points and fields in checkpoint-a.h5 or
// checkpoint-b.h5 in turn (point_file.h), and the text checkpoint.info, which
// says which of the two is valid and has the rest of the state by name, with
// checksums of that file and of its own text. The text is replaced last and at
// once, so that a run that is killed at any time leaves one complete
// checkpoint. The mesh follows from the parameters and the travel. Memory: some
// megabytes, however many points there are.
#ifndef caisson_mpm_restart_checkpoint_h
#define caisson_mpm_restart_checkpoint_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/domain/grid_fields.h>
#include <caisson_mpm/domain/material_points.h>

#include <string>

namespace CaissonMPM
{
  /**
   * Write the points, @p fields of the grid, and @p state, whatever else the run
   * must know: values of all ranks, of which the first one's are written. @p
   * warnings is what the run has said, one line each. @p
   * fingerprint is the text of all parameters that must be the same when the
   * run is resumed, one per line. Throws RunFailure where the file
   * cannot be written; the previous checkpoint is still valid
   * then. Collective.
   */
  void
  write_checkpoint(const std::string              &directory,
                   const BackgroundGrid           &grid,
                   const MaterialPoints           &points,
                   const NamedFields              &fields,
                   const NamedNumbers             &state,
                   const std::vector<std::string> &warnings,
                   const std::string              &fingerprint);

  /** A checkpoint in a directory, which is only read. */
  class Checkpoint
  {
  public:
    /** Whether the directory has one, which may be damaged. */
    static bool
    is_in(const std::string &directory);

    /** Read all but points and fields. Throws BadInput where there is no
     * checkpoint, or its text is damaged. */
    explicit Checkpoint(const std::string &directory);

    /** What checkpoint.info says. */
    struct Info
    {
      std::string              file; // checkpoint-a.h5 or checkpoint-b.h5
      std::string              checksum_of_file;
      unsigned long            n_points = 0;
      std::string              columns; // of the table of points
      std::vector<std::string> fields;  // their names
      NamedNumbers             state;   // the numbers that were written
      std::vector<std::string> warnings;
      std::string              fingerprint; // that it was written with
    };

    /** Throw BadInput, with the first line that differs, where @p fingerprint
     * is not the one it was written with. */
    void
    check_fingerprint(const std::string &fingerprint) const;

    /**
     * Bring the points to the state of the checkpoint; from the rest of it, the
     * caller moves the grid. The mesh of the same scene must have been created,
     * on as many ranks as you like; @p points are replaced. Points of a cell
     * keep their order. Throws BadInput where the file of points and fields is
     * damaged. Collective.
     */
    void
    read_points(const BackgroundGrid &grid, MaterialPoints &points) const;

    /** Return the fields, after read_points(). */
    NamedFields
    read_fields() const;

    const Info info;

  private:
    const std::string directory;
  };
} // namespace CaissonMPM

#endif
