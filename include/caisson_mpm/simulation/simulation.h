// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The simulation: owns everything, and advances it in time.
#ifndef caisson_mpm_simulation_simulation_h
#define caisson_mpm_simulation_simulation_h

#include <caisson_mpm/base/command_line.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/simulation/recorder.h>
#include <caisson_mpm/simulation/run_cost.h>
#include <caisson_mpm/simulation/simulation_parts.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * One scene from its parameters to its last file.
   *
   * Construct it, fill the parameters (ParameterAcceptor::initialize or
   * parse_all_parameters), and call set_up() and run(). advance() is one time
   * step and reads in the order of the method. Collective over MPI.
   *
   * Each rank works on the cells that it owns and the points in them. Sums over
   * nodes, points and steps are of one rank; see RunTotals.
   */
  class Simulation : public Section, private SimulationParts
  {
  public:
    explicit Simulation(const MPI_Comm communicator);

    /** Declare the entries of a subsection of which a scene may have any
     * number; see read_parameters(). */
    bool
    declare_subsection(const std::string &path)
    {
      return soil.declare_subsection(path);
    }

    /** Report which entries have no effect in this scene; before or after
     * set_up(). */
    void
    name_unused_entries(ParameterOrigins &origins) const override;

    /**
     * Check all parameters and set up the mesh and the points, those of the
     * checkpoint with --restart. Writes no file. Throws BadInput.
     */
    void
    set_up(const CommandLine &command_line, const ParameterOrigins &origins);

    /** Report further warnings of this scene, doubtful values and
     * known limits; after set_up(). Collective. */
    void
    review(ParameterOrigins &origins) const;

    /** Find out how large the run is; after set_up(). Takes some steps: run()
     * does not continue from there. Throws BadInput where a user material
     * fails in them. */
    RunCost
    estimate_cost();

    /**
     * Run the scene that was set up, and print the warnings of its @p input,
     * which run.json gets, too. Throws BadInput where the output directory
     * cannot be used, and RunFailure; returns success, failure (a verification
     * that fails), or stopped (on request, with a checkpoint).
     */
    ExitStatus
    run(const ParameterOrigins &input);

  private:
    /** Run in the directory that the recorder has opened; see run(). */
    ExitStatus
    run_to_end(const ParameterOrigins &input);
    void
    register_totals();
    /** Make the pore water when the parameters are known. */
    void
    choose_water();
    /** Find out how the motion begins, and which travel the mesh was made for,
     * if the run goes on from a checkpoint. */
    void
    find_beginning();
    /** Let the motion begin like this, in the mesh of a checkpoint. */
    void
    begin_at(const BodyMotion::InitialMotion &start, const NamedNumbers &state);
    /** Check all parameters and place the lines of the mesh. */
    void
    check_parameters();
    void
    check_inertia_tolerance() const;
    void
    place_lines();
    void
    make_mesh();
    /** Slow a prescribed motion down to its largest Mach number. */
    void
    slow_body_down();
    /** Throw BadInput where soil begins faster than its waves. Collective. */
    void
    check_initial_speed() const;
    /** Throw BadInput where the steps are too short to come to the end. */
    void
    check_number_of_steps() const;
    /** Return how many steps are left, infinite where it is not known. */
    double
    number_of_steps() const;
    /** What would make a long run shorter, in words. */
    std::vector<std::string>
    ways_to_save(const double n_points) const;
    /** Return the strength of a face: that of the body's entries, or on a wall
     * that of the layer at its depth. */
    FaceStrength
    strength_of_face(const ContactFace &face) const;

    /** Return the speed of compression waves in a material, with mass scaling.
     * Units: m/s. */
    double
    wave_speed(const unsigned int material) const;
    /** Return the speed of compression waves under the tip once the body has
     * travelled so far, or the present one in soil that stiffens, whichever is
     * larger. Units: m; m/s. */
    double
    wave_speed_under_tip(const double travel) const;
    /** Return the least and the largest speed of compression waves in the
     * materials, with mass scaling. Units: m/s. */
    std::pair<double, double>
    slowest_and_fastest_wave() const;
    /** Return the largest work of a rank over the mean of all. @p costs
     * [n_global_cells] are used of the cells of this rank. Collective. */
    double
    imbalance(const std::vector<unsigned int> &costs) const;
    /** Repartition the mesh where the present parts have cost more time by now
     * than this does. Collective. */
    void
    balance();
    /** Give each rank a part of the same costs. Collective. */
    void
    repartition(const std::vector<unsigned int> &costs);
    void
    start();
    void
    resume();
    /** Start with the state of the installation. */
    void
    continue_from_installation();
    void
    advance();
    // the parts of a step, in their order
    /** See TimeStep::follow_tip(); once the body has this travel (m). */
    double
    stress_over_inertia_at_tip(const double travel) const;
    void
    choose_step();
    StepSize
    size_of_step() const;
    /** Move a body whose velocity depends on earlier steps only. */
    void
    move_body_by_itself();
    void
    move_body();
    void
    set_strength_of_walls();
    NodalConstraints
    constraints_of_nodes();
    SoilOnGrid
    soil_on_grid();
    /** Move a body whose velocity depends on the soil in this step. */
    void
    move_body_with_soil();
    void
    correct_velocities();
    void
    constrain_velocities();
    void
    prepare_transfer();
    void
    update_points();
    /** The width and height that points in this cell should have. Units: m. */
    std::array<double, 2>
    wanted_size_of_points(const unsigned int cell) const;
    /** Split and merge points, where it is time to. */
    void
    adapt_points();
    /** Hand the sums of this step to those who keep them. */
    void
    finish_step();
    /** Bring the points to their cells. */
    void
    relocate_points();
    [[noreturn]] void
    report_not_finite() const;

    void
    output();
    /** Return the force of the soil on the body in the last step, in the
     * direction of its travel. Collective. Units: N. */
    double
    find_force_on_body() const;
    /** Whether anything needs that force in each step. */
    bool
    needs_force_on_body() const
    {
      return body.motion().traits.needs_force || water->traits().lid != nullptr;
    }
    /** Whether the caches are to be rebuilt before the next step. */
    bool
    rebuild_is_due() const;
    /** Build again what is kept over steps only to save time, as a restart
     * does: its last digits depend on the steps before. Collective. */
    void
    rebuild_caches();
    bool
    checkpoint_is_due();
    void
    save_checkpoint();
    /** Why a rank has been asked to stop, or an empty text. Collective. */
    std::string
    request_of_any_rank();
    /** The same once it is time to: if that is soon, before a step in which the
     * caches are rebuilt, so that a run that is resumed repeats them. */
    std::string
    reason_to_stop();
    ExitStatus
    stop(const std::string &reason);
    /** Report that a run that was finished has nothing to continue, and leave
     * its files as they are. */
    ExitStatus
    nothing_left();
    /** Report that water ends the run. */
    void
    end_early();
    ExitStatus
    finish();

    // state
    bool is_restart = false, overwrites = false, is_stopping = false;
    const Kernels::KernelTable *kernels   = nullptr;
    unsigned long               n_limited = 0;  // velocities of points
    double                      inflow    = 0.; // of soil into the body, m3
    double since_adaptation = 0.; // of points, in steps of reference
    // in the last step, or that before the last checkpoint; N
    double    force_on_body = 0.;
    NodalWork work_of_step;
    // from up to down, for which a mesh that a checkpoint needs was made; m
    std::optional<std::pair<double, double>> travel_of_mesh;

    // parameters
    std::string           instruction_set     = "auto";
    std::optional<double> checkpoint_interval = 600.;

    Recorder recorder;

    // of the ranks, largest over mean work, after the last cut into parts; and
    // the steps that could have been made since in the time that ranks waited
    double least_imbalance = 1., lost_steps = 0.;
    double last_checkpoint = 0.; // wall time, s
  };
} // namespace CaissonMPM

#endif
