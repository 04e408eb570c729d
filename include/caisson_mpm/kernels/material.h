// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A material of the soil, as the kernels see it.
#ifndef caisson_mpm_kernels_material_h
#define caisson_mpm_kernels_material_h

namespace CaissonMPM
{
  namespace Kernels
  {
    /** What a material law may keep of a point besides its plastic strains. */
    constexpr int n_state_variables = 4;

    /** What plastic shear does to the volume of a soil. */
    enum class VolumeInShear : unsigned char
    {
      kept,
      gained,
      by_state // or it has no plastic shear
    };

    /** The stress that elasticity is a law for: that of the present area, or
     * J times that, J being the volume over that at the start. */
    enum class StressMeasure : unsigned char
    {
      cauchy,
      kirchhoff
    };

    /**
     * A soil material as the kernels see it. Which law reads the parameters
     * is chosen once per block.
     */
    struct Material
    {
      int    law;
      double body_force[2]; // acceleration of the scaled mass (m/s2)
      // lambda + 2 mu, the largest of all points, and water_modulus (Pa)
      double        p_wave_modulus;
      double        water_modulus  = 0.; // of the water in undrained soil (Pa)
      double        volume_damping = 0.; // 0 to 1: see find_mean_divergence()
      VolumeInShear volume_in_shear;
      bool          is_frictionless   = false; // no strength from pressure
      bool          has_loosest_state = false; // kernels/loosest_state.h
      StressMeasure stress_measure    = StressMeasure::cauchy;
      double        initial_void_ratio;
      double        initial_density; // of the scaled mass, kg/m3
      alignas(16) unsigned char parameters[384];
    };
  } // namespace Kernels
} // namespace CaissonMPM

#endif
