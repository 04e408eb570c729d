// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the kernels hand to a law that the user has written, for one point.
#ifndef caisson_mpm_kernels_user_point_h
#define caisson_mpm_kernels_user_point_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** The numbers of a point that the program keeps for a user's law, before
     * the law's own variables: where each of them begins. */
    namespace UserState
    {
      constexpr int modulus   = 0;  // the largest one so far, Pa
      constexpr int strain    = 1;  // rr, zz, tt, rz (engineering)
      constexpr int gradient  = 5;  // F - I: rr, rz, zr, zz, tt
      constexpr int variables = 10; // the law's own
    }                               // namespace UserState

    /** A point in a step. Tensors are rr, zz, tt, rz, in the axes after the
     * turn of the step; SI units. */
    struct UserPoint
    {
      double  stress[4];    // at the start of the step, and then at its end
      double  strain[4];    // the increment; rz is the engineering one
      double  gradient[5];  // dt L in the fixed axes: rr, rz, zr, zz, tt
      double  cosine, sine; // of the turn, from z to r
      double  place[2];     // r, z at the start of the step
      double  cell_size;
      double  id;
      double *state; // see UserState
    };

    /** Take a point to the end of the step; what fails is kept in @p law. */
    using UserLaw = void (*)(void *law, UserPoint &point);
  } // namespace Kernels
} // namespace CaissonMPM

#endif
