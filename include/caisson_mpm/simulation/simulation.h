// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The simulation: owns everything, and advances it in time.
#ifndef caisson_mpm_simulation_simulation_h
#define caisson_mpm_simulation_simulation_h

#include <caisson_mpm/base/console.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/timing.h>
#include <caisson_mpm/bodies/rigid_body.h>
#include <caisson_mpm/checks/verification.h>
#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/body_points.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_generator.h>
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/materials/soil.h>
#include <caisson_mpm/operators/boundary_conditions.h>
#include <caisson_mpm/operators/contact.h>
#include <caisson_mpm/operators/energy_balance.h>
#include <caisson_mpm/operators/loads.h>
#include <caisson_mpm/operators/nodal_motion.h>
#include <caisson_mpm/operators/time_step.h>
#include <caisson_mpm/output/error_bar.h>
#include <caisson_mpm/output/observations.h>
#include <caisson_mpm/output/records.h>
#include <caisson_mpm/output/visualization.h>
#include <caisson_mpm/restart/checkpoint.h>

#include <deal.II/base/parameter_acceptor.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * One scene from its parameters to its last file.
   *
   * Construct it, fill the parameters (ParameterAcceptor::initialize or
   * parse_all_parameters), and call run(). advance() is one time step and reads
   * in the order of the method. Collective over MPI.
   *
   * Each rank works on the cells that it owns and the points in them. Sums over
   * nodes, points and steps are of one rank until bring_sums_to_first_rank();
   * the first rank prints and writes.
   */
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    explicit Simulation(const MPI_Comm communicator);

    /**
     * Run the scene. @p scene_file is for messages; a non-empty
     * @p output_directory replaces the parameter. Throws BadInput and
     * RunFailure; returns success, failure (a verification that fails), or
     * stopped (on request, with a checkpoint).
     */
    ExitStatus
    run(const std::string &scene_file,
        const std::string &output_directory,
        const bool         restart);

    /** Check all parameters and the mesh, without running. Throws BadInput. */
    void
    validate();

  private:
    void
    set_up(const std::string &output_directory, const bool restart);
    /** Set up what knows the cells or nodes of this rank. */
    void
    set_up_part();
    /** Even out the work of the ranks if it differs much. */
    void
    balance();
    void
    schedule_frames();
    void
    start();
    void
    resume();
    void
    print_header(const std::string &scene_file);

    double
    choose_step();
    void
    advance();
    template <typename Action>
    void
    timed(const char *section, const Action &action);
    void
    update_points(const Kernels::GridView &view);
    void
    adapt_points();
    void
    report_not_finite() const;
    std::string
    reason_to_stop();
    bool
    verify();

    void
    output();
    bool
    checkpoint_is_due();
    void
    bring_sums_to_first_rank();
    void
    record();
    void
    add_forces(HistoryRow &row);
    void
    warn_of_lid(const HistoryRow &row);
    void
    add_sums_over_points(HistoryRow &row);
    PointEnergies
    point_energies() const;
    void
    print_record(const HistoryRow &row);
    void
    write_frame();
    void
    save_checkpoint();
    void
    resume_sums(const CheckpointState &state);
    void
    write_summary(const std::string &status);
    void
    print_counts();
    void
    print_energies();
    void
    print_times();
    std::string
    fingerprint() const;
    std::string
    changed_physics() const;
    double
    end_time() const;
    double
    seconds_running() const;

    // the mesh moves less than the finest cell in so many steps
    static constexpr unsigned int steps_between_adaptions = 25;

    // in the order of their sections in a .prm file
    GridLines          lines;
    Soil               soil;
    RigidBody          body;
    PointGenerator     generator;
    BoundaryConditions boundary_conditions;
    Loads              loads;
    NodalMotion        nodal_motion;
    TimeStep           time_step;
    Observations       observations;
    Verification       verification;
    ErrorBar           error_bar;
    StopRequest        stop_request;

    BackgroundGrid                 grid;
    MaterialPoints                 points;
    std::vector<BodyPoint>         body_points;
    Contact                        contact;
    std::vector<Kernels::Material> materials;
    const Kernels::KernelTable    *kernels = nullptr;

    // parameters
    std::string         title            = "a scene";
    std::string         instruction_set  = "auto";
    double              last_time        = 0.;
    double              last_penetration = 0.;
    std::string         directory        = "results";
    std::string         terminal         = "full";
    double              record_interval  = 0.1;
    double              frame_interval   = 0.;
    std::vector<double> frame_penetrations;
    double              checkpoint_interval = 600.;

    // state
    double        time = 0., dt = 0.;
    unsigned long step = 0, n_limited = 0;
    EnergyBalance energy;

    // of several ranks
    double       accepted_imbalance = 1.1; // largest over mean work
    unsigned int n_repartitions     = 0;

    // output
    std::unique_ptr<Console>       console;
    std::unique_ptr<Records>       records;
    std::unique_ptr<Visualization> visualization;
    SectionTimer                   timer;
    std::vector<double>            frame_times;
    std::string                    scene, wrong_error_bar;
    double        next_record = 0., last_record = 0., next_checkpoint = 0.;
    double        last_printed          = 0.;
    unsigned int  next_frame            = 0;
    unsigned long first_step            = 0; // of this run
    double        start_of_run          = 0.;
    double        travel_of_last_record = 0.;
    unsigned int  max_in_body           = 0;
    bool          at_lid                = false;
    double        point_steps           = 0.;
    std::chrono::steady_clock::time_point start_time;
  };
} // namespace CaissonMPM

#endif
