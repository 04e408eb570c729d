// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a run reports while it proceeds: rows, observations, frames, progress.
#ifndef caisson_mpm_simulation_recorder_h
#define caisson_mpm_simulation_recorder_h

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/operators/wall_forces.h>
#include <caisson_mpm/output/observations.h>
#include <caisson_mpm/output/row_file.h>
#include <caisson_mpm/output/visualization.h>
#include <caisson_mpm/output/wall_file.h>
#include <caisson_mpm/simulation/run_report.h>
#include <caisson_mpm/simulation/simulation_parts.h>

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Owns the terminal and the files of a run, except the checkpoint, and knows
   * what has happened since the last record. add_step() is called in each step
   * and is not collective; all other functions are. The first rank prints and
   * writes.
   */
  class Recorder : public Section
  {
  public:
    explicit Recorder(SimulationParts &parts);

    /** Throw BadInput for observations that cannot be understood. */
    void
    check_parameters();

    /** Let a directory that is not empty replace the parameter. */
    void
    set_output_directory(const std::string &of_command_line);

    /**
     * Learn what is run; the wall time begins. @p scene_file is for messages,
     * @p fingerprint is that of the physics, and @p installation the directory
     * of the run after which this one goes on, or empty. Throws BadInput where
     * the output directory cannot be used. Writes
     * nothing.
     */
    void
    describe(const std::string          &scene_file,
             const std::string          &command_words,
             const std::string          &fingerprint,
             const std::string          &installation,
             const Kernels::KernelTable &kernels);

    /** Throw BadInput where an observation finds no material point. Collective.
     */
    void
    try_observations() const;

    /** Prepare the directory. Throws BadInput where it cannot be used. */
    void
    open();

    /** Report what is done before the first step; after describe(). */
    void
    report_progress(const std::string &text);

    /** Begin new files. The results of an earlier run are put aside, or removed
     * with @p overwrite. */
    void
    start(const bool overwrite);

    /** Continue the files of the run whose totals have been resumed. Throws
     * BadInput where they lack rows, or only warns with @p overwrite. */
    void
    resume(const bool overwrite);

    /** Register what is summed up between records. */
    void
    register_totals(RunTotals &totals);

    /** Find the walls of a body that moves up and down, when the mesh or the
     * parts of the ranks are new. Collective. */
    void
    find_walls();

    /** Register the sums along the walls, after find_walls(). */
    void
    register_walls(RunTotals &totals);

    /** Let the next record write the walls. */
    void
    request_walls();

    /** Let the time that is left follow from the number of steps that are
     * left, infinite where it is not known. The step grows with the depth, so
     * that the first part of the way takes more than its share of the time. */
    void
    follow_steps(const std::function<double()> &steps_left)
    {
      this->steps_left = steps_left;
    }

    /** Print what is run, and the warnings of its scene. */
    void
    print_header(const ParameterOrigins &input);

    /** Add a step: the impulses of this rank's nodes, for the whole
     * circumference, and what the water has borne of the body. Units: N s. */
    void
    add_step(const SurfaceForces &on_body, const Vector2 &on_prescribed_soil);

    void
    record();

    void
    write_frame();

    /** Write points.csv, if the checks of the scene need it. */
    void
    write_points();

    /** Write run.json and the error bar. */
    void
    write_summary(const std::string &status);

    /** Write run.json with the reason of a failure, if there is room for it;
     * not collective. */
    void
    write_failure(const std::string &reason) noexcept;

    /** Print sums and energies. */
    void
    print_report();

    /** Print what came out, where it is, and what can be done with it. */
    void
    print_result();

    void
    message(const std::string &text);

    const std::string &
    output_directory() const
    {
      return directory;
    }

    /** Wall time of the run, that before a restart included. Units: s. */
    double
    seconds_running() const;

    /** Return what the run has said of its results, for a checkpoint, and take
     * the time. */
    std::vector<std::string>
    prepare_checkpoint();

    /** Let print_header() repeat the @p warnings of a checkpoint. */
    void
    remember(const std::vector<std::string> &warnings)
    {
      earlier_warnings = warnings;
    }

    /** Count that the parts of the ranks have been changed. */
    void
    count_repartition()
    {
      ++known.n_repartitions;
    }

  private:
    /** A column of history.csv: its name with the unit, whether the scene has
     * it, and the value of the present record. */
    struct Column
    {
      std::string             name;
      bool                    is_present;
      std::function<double()> value;
    };

    /** All columns but those of RunTotals and of the pore water. */
    std::vector<Column>
    columns() const;
    /** Whether the scene has a number of RunTotals. */
    bool
    has_count(const std::string &name) const;
    std::vector<std::string>
    column_names() const;
    /** The row of the present record. Collective. */
    NamedNumbers
    find_row() const;
    Console::Verbosity
    verbosity() const;
    void
    begin();
    /** Take the fingerprints of the files as they are. */
    void
    store_file_hashes();
    /** Throw BadInput, or warn, where history.csv lacks rows of the run that
     * goes on. */
    void
    check_for_lost_rows(const bool may_be_lost);
    /** Warn where the files are not as the checkpoint knows them. */
    void
    warn_of_changed_files();
    /** Find the mean forces since the last record. */
    void
    find_forces();
    /** Whether there is a wall.csv. */
    bool
    has_walls() const;
    /** Write the walls if they are requested: before the end of the interval is
     * forgotten. Collective. */
    void
    record_walls();
    /** The pressure on a cylinder that expands. Units: Pa. */
    double
    cavity_pressure(const double interval) const;
    /** Find the sums over the points, and close the balance of energy.
     * Collective. */
    void
    find_sums_over_points();
    std::vector<double>
    observed_values() const;
    void
    warn_of_lid();
    /** Say once where a body that its loads move came to rest. */
    void
    report_rest();
    /** Say once where the weight no longer suffices. */
    void
    report_suction(const NamedNumbers &row);
    void
    print_record(const NamedNumbers &row);
    /** Note how the tables and run.json of a run that ends are; not collective.
     */
    void
    record_files() const;
    /** Write run.json of a run that has not ended; not collective. */
    void
    write_progress(const double fraction_done, const double eta_seconds) const;
    /** The wall time that is left. Units: s. */
    double
    seconds_left(const double fraction_done) const;
    void
    warn_of_no_rest();
    /** What a report needs. Collective. */
    RunFacts
    facts(const std::string &status) const;
    /** The same without the sums over ranks; not collective. */
    RunFacts
    own_facts(const std::string &status) const;

    SimulationParts &parts;

    Observations observations;

    enum class Terminal
    {
      full,
      plain,
      silent
    };
    std::string directory            = "results";
    Terminal    terminal             = Terminal::full;
    bool        walls_at_each_record = false;

    std::unique_ptr<OutputDirectory> locked_directory;
    std::unique_ptr<Console>         console;
    // history.csv and, where there are observations, observations.csv
    std::unique_ptr<RowFile>              history, observed;
    std::unique_ptr<Visualization>        visualization;
    std::unique_ptr<WallFile>             wall_file;
    RunFacts                              known; // since the start
    std::vector<std::string>              earlier_warnings;
    std::function<double()>               steps_left;
    unsigned int                          n_lanes = 0; // of the kernels
    std::chrono::steady_clock::time_point start_time;

    // since the last record
    SurfaceForces impulse_on_body  = {};
    double        impulse_of_water = 0.; // upward, the same on all ranks
    Vector2       impulse_on_soil  = Vector2();
    double        last_record      = 0.;
    double        last_frame       = 0.; // of all, before a stop
    double        travel_at_record = 0.;
    WallForces    walls;
    bool          wants_walls = false;

    // of the present record, SI units, forces on the body positive upward
    std::array<double, n_surfaces> recorded_forces         = {};
    double                         recorded_force_of_water = 0.;
    double                         pressure_of_cavity      = 0.;
    Vector2                        force_on_soil = Vector2(); // prescribed one
    double                         max_speed     = 0.;        // of points
    unsigned int                   n_in_body     = 0;         // points
    PointEnergies                  energies;

    double point_steps = 0.; // of this rank
    double wall_time   = 0.; // at the last checkpoint, s

    // since the start of this process
    double        seconds_at_start  = 0.;
    double        fraction_at_start = 0.;
    double        fraction_printed  = 0.;
    double        last_progress     = -std::numeric_limits<double>::infinity();
    unsigned long first_step        = 0;

    // fingerprints; of the first rank
    struct Files
    {
      double history      = 0.;
      double observations = 0.;
      double frames       = 0.;
    };
    Files files;

    bool at_lid            = false;
    bool has_reported_rest = false;
    // of the last record, if it had a lid: m, Pa
    double last_depth           = 0.;
    double last_suction         = 1.;
    bool   has_reported_suction = false;
  };
} // namespace CaissonMPM

#endif
