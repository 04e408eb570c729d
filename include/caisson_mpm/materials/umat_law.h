// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A constitutive law that the user has written as a UMAT of Abaqus.
//
// What the UMAT gets, with the components rr, zz, tt, rz in the place of 11,
// 22, 33, 12, SI units, and tension positive:
//   STRESS   the effective stress, turned with the soil (Jaumann),
//   DSTRAN, STRAN   the increment of strain and the sum of the turned
//            increments, with the engineering shear strain,
//   DROT     the turn of the step, DFGRD0 and DFGRD1 the deformation gradient
//            before and after it, both in the fixed axes r, z,
//   TIME, DTIME, COORDS, CELENT   time, step, place, and the root of the area
//            of the cell; KINC counts steps, NOEL is the number of the point,
//   SSE, SPD, SCD, TEMP and the like   0.
// It returns STRESS, STATEV, and DDSDDE, from which the time step follows.
#ifndef caisson_mpm_materials_umat_law_h
#define caisson_mpm_materials_umat_law_h

#include <caisson_mpm/base/conventions.h>
#include <caisson_mpm/base/fenced_memory.h>
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/kernels/user_point.h>
#include <caisson_mpm/materials/user_library.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What points have in the place of state that their law does not keep. */
  constexpr double no_state = std::numeric_limits<double>::quiet_NaN();

  /** What the user says of a UMAT. */
  struct UmatSettings
  {
    std::string         library; // as the scene has it
    std::vector<double> properties;
    unsigned int        n_variables = 0;
    std::vector<double> variables; // the first of them, at the start
  };

  /** What a UMAT only reads, besides STRAN, DSTRAN and PROPS. */
  struct UmatInput
  {
    double time[2], dtime, temp, dtemp, predef, dpred, coords[3], drot[9],
      celent, dfgrd0[9], dfgrd1[9];
    int ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep[4],
      kinc;
    char cmname[80];
  };

  /** The stiffness of a law in a state, as the time step needs it. */
  struct UmatStiffness
  {
    double p_wave_modulus = 0.; // a bound of rho c^2 of all plane waves, Pa
    double poisson        = 0.;
    bool   varies         = false; // with stress
  };

  /**
   * Calls a UMAT for one point after the other. Owns the memory that the UMAT
   * works on, with a fence behind each array, and keeps the first failure;
   * after that it is not called again.
   */
  class UmatLaw
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
     * The element test: strain soil with this stress a little in all
     * directions. Throws BadInput where the UMAT fails, gives different answers
     * to the same call, does not start from the stress that it is given, or
     * returns a DDSDDE that no time step can follow from. Returns the
     * stiffness.
     */
    UmatStiffness
    test(const Stress &stress);

    /** The numbers of a point at the start (Kernels::UserState), and no_state
     * up to @p n of them, which other laws keep. */
    std::vector<double>
    start_of_state(const double p_wave_modulus, const unsigned int n) const;

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
      return library.checksum();
    }

    /** See Kernels::UserLaw. */
    static void
    call(void *law, Kernels::UserPoint &point);

  private:
    UmatInput &
    given() const
    {
      return *input.own<UmatInput>();
    }
    void
    update(Kernels::UserPoint &point);
    /** Set the input of the call from the point. */
    void
    prepare(const Kernels::UserPoint &point);
    /** Whether the answer is finite, and the step long enough for the UMAT. */
    bool
    is_good() const;
    /** Say what is wrong with the answer. */
    std::string
    find_fault(const EndOfCall end) const;
    /** Say what lies at the address where the UMAT was stopped; empty if
     * nothing of ours. */
    std::string
    beyond_or_read_only(const void *address) const;
    /** Take the answer over. */
    void
    accept(Kernels::UserPoint &point);
    /** "the UMAT ... WHAT, at the point ..., in step ...". */
    std::string
    describe(const std::string &what) const;
    static void
    call_umat(void *law);
    static std::string
    text_of_exit(void *law);

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
    /** A strain increment of zero must keep a stress, but one that lies outside
     * of a yield surface, of which warning() tells. */
    void
    check_no_strain(const Stress &stress);

    const UmatSettings settings;
    const std::string  section, entry; // entry: with its value
    const UserLibrary  library;
    std::string        failure_, warning_;

    // the call in progress
    const Kernels::UserPoint *point      = nullptr;
    bool                      is_testing = true;
    const FencedMemory        props, stran, dstran, input; // read only
    const FencedMemory        stress, statev, ddsdde;
    double                    pnewdt = 1.;
    // modulus over the largest entry on the diagonal of DDSDDE
    double modulus_ratio = 1.;
  };
} // namespace CaissonMPM

#endif
