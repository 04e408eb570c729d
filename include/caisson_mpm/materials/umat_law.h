// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A constitutive law that the user has written as a UMAT of Abaqus.
//
// What the UMAT gets, with the components rr, zz, tt, rz in the place of 11,
// 22, 33, 12, SI units but for the unit of stress, and tension positive:
//   STRESS   the effective stress, turned with the soil (Jaumann),
//   DSTRAN, STRAN   the increment of strain and the sum of the turned
//            increments, with the engineering shear strain,
//   DROT     the turn of the step, DFGRD0 and DFGRD1 the deformation gradient
//            before and after it, both in the fixed axes r, z,
//   TIME, DTIME, COORDS, CELENT   time, step, place, and the root of the area
//            of the cell; KINC counts steps, NOEL is the number of the point,
//   SSE, SPD, SCD, TEMP and the like   0.
// A UMAT for six components gets 13 and 23 as zeros.
// It returns STRESS, STATEV, and DDSDDE, from which the time step follows.
#ifndef caisson_mpm_materials_umat_law_h
#define caisson_mpm_materials_umat_law_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/materials/umat_settings.h>
#include <caisson_mpm/materials/user_library.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * Calls a UMAT for one point after the other. Owns the arguments that the
   * UMAT works on, and keeps the first failure; after that it is not called
   * again.
   */
  class UmatLaw : public ForeignCode
  {
  public:
    /** Load the library. @p section is "Soil/Layer k", @p directory that of the
     * scene's file. Throws BadInput. */
    UmatLaw(const UmatSettings &settings,
            const std::string  &section,
            const std::string  &directory);

    UmatLaw(const UmatLaw &) = delete;
    UmatLaw &
    operator=(const UmatLaw &) = delete;

    /**
     * The element test: strain soil with this stress, at this depth (m), a
     * little in all directions. Throws BadInput where the UMAT fails, gives
     * different answers to the same call, does not start from the stress that
     * it is given, or returns a DDSDDE that no time step can follow from.
     * Returns the stiffness.
     */
    UmatStiffness
    test(const Stress &stress, const double depth);

    /** The numbers of a point at the start (Kernels::UserState), and no_state
     * up to @p n of them, which other laws keep. */
    std::vector<double>
    start_of_state(const double p_wave_modulus, const unsigned int n) const;

    /** Let SDVINI, if the library has it, change the numbers of the point with
     * this place (r, z in m) and number at the start. Throws BadInput. */
    void
    initialize(const double r, const double z, const double id, double *state);

    /** The number of numbers that a point keeps. */
    unsigned int
    n_state() const
    {
      return Kernels::UserState::variables + settings.n_variables;
    }

    /** What calls have from now on as TIME, DTIME and KINC. Units: s. */
    void
    begin_step(const double       time,
               const double       step_size,
               const unsigned int step);

    /** Routine and library, for the log: before it is called in a run. */
    std::string
    name() const
    {
      return settings.routine + " of " + settings.library;
    }

    /** Why the UMAT has failed; empty where it has not. */
    const std::string &
    failure() const
    {
      return failure_;
    }

    /** What the element test has found that the law may be meant to do; empty
     * if nothing. */
    const std::string &
    warning() const
    {
      return warning_;
    }

    const std::string &
    checksum() const
    {
      return library.checksum;
    }

    /** See Kernels::UserLaw. */
    static void
    call(void *law, Kernels::UserPoint &point);

    void
    describe(const char       *what,
             char             *text,
             const std::size_t size) const override;

  private:
    using Arguments = UmatArguments;

    void
    update(Kernels::UserPoint &point);
    void
    set_place(const double r, const double z, const double id);
    /** Set the input of the call from the point. */
    void
    prepare(const Kernels::UserPoint &point);
    /** Say what is wrong with what the call has returned; empty if nothing. */
    std::string
    find_fault() const;
    /** Name what has been read or written outside of. */
    std::string
    outside(const std::string &what, const Arguments::Index guard) const;
    /** The numbers that an argument has been returned with, if one of them is
     * not finite; else empty. */
    std::string
    not_finite(const UmatArgument::Index argument) const;
    /** DDSDDE as it has been returned, of rr, zz, tt, rz by columns. Units: Pa.
     */
    std::array<double, 16>
    stiffness() const;
    /** Take the answer over. */
    void
    accept(Kernels::UserPoint &point);

    /** The answer of a call, in the element test. */
    struct Answer
    {
      std::array<double, 4>  stress;
      std::array<double, 16> ddsdde;
      std::vector<double>    variables;
    };

    Answer
    ask(const Stress &stress, const std::array<double, 4> &strain);
    void
    check_reproducible(const Stress &stress);
    /** Warn where SDVINI replaces State at the start. */
    void
    check_start_of_state();
    /** A strain increment of zero must keep a stress, but one that lies outside
     * of a yield surface, of which warning() tells. */
    void
    check_no_strain(const Stress &stress);

    const UmatSettings settings;
    const std::string  section, entry; // entry: with its value
    const UserLibrary  library;
    std::string        failure_, warning_;

    Arguments arguments;

    enum class Phase
    {
      element_test,
      start, // SDVINI
      step
    };
    Phase                     phase = Phase::element_test;
    const Kernels::UserPoint *point = nullptr;    // of the call in progress
    double                    depth_of_test = 0.; // m
    // modulus over the largest entry on the diagonal of DDSDDE
    double modulus_ratio = 1.;
  };
} // namespace CaissonMPM

#endif
