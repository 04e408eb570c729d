// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The directory that a run writes to.
#ifndef caisson_mpm_base_output_directory_h
#define caisson_mpm_base_output_directory_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The output directory while a run uses it. Two runs in one directory would
   * mix their files, so the first rank locks it, and the file ".lock" in it,
   * which names the run. The system drops the locks when the process ends,
   * however it ends: a file that was left behind locks nothing.
   *
   * Construction, check() and make_room() are collective, the rest is not.
   */
  class OutputDirectory
  {
  public:
    /** Throw BadInput on all ranks where no directory can be at this path.
     * Writes nothing. Collective. */
    static void
    check(const std::string &path, const MPI_Comm communicator);

    /**
     * Create the directory if it does not exist, and lock it with a file in it.
     * Throws BadInput on all ranks if one of these fails.
     */
    OutputDirectory(const std::string &path, const MPI_Comm communicator);

    ~OutputDirectory();

    OutputDirectory(const OutputDirectory &) = delete;
    OutputDirectory &
    operator=(const OutputDirectory &) = delete;

    /** Whether a run writes a file of this name. What has another name is the
     * user's, and stays. */
    static bool
    is_result(const std::string &name);

    /** Remove a file that a run writes. Returns whether it was there. */
    static bool
    remove(const std::string &path);

    struct Room
    {
      std::string  place; // of what was moved; empty where nothing was
      unsigned int n_removed = 0;
    };

    /**
     * Move the files of an earlier run, and the pictures and reports of them,
     * to a new subdirectory earlier_1, earlier_2, ...; with @p overwrite remove
     * those that are as they were written, and move the others. A measured log
     * stays. Returns what was done on the first rank, and nothing on others.
     * Throws BadInput on all ranks where the files cannot be moved; then all
     * stay. Collective.
     */
    Room
    make_room(const bool overwrite, const MPI_Comm communicator) const;

    /** Note how the files of these names are now, by which make_room() knows
     * that nobody has changed them since. For the first rank. */
    void
    record(const std::vector<std::string> &names) const;

    const std::string &
    path() const
    {
      return path_;
    }

  private:
    /** Throw BadInput on all ranks where the first one has a @p reason why the
     * directory at this path cannot be used. Collective. */
    static void
    refuse(const std::string &path,
           const std::string &reason,
           const MPI_Comm     communicator);

    /** Return why the directory cannot be used, or nothing. */
    std::string
    prepare();

    /** Return why it cannot be locked, or nothing. */
    std::string
    lock();

    const std::string path_;
    int               directory = -1, lock_file = -1; // open, and locked
  };
} // namespace CaissonMPM

#endif
