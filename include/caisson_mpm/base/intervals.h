// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How often things are done that not every step needs.
#ifndef caisson_mpm_base_intervals_h
#define caisson_mpm_base_intervals_h

namespace CaissonMPM
{
  /** Numbers of steps. What has a period is done in the steps whose number it
   * divides, or when so many steps have passed since the last time. */
  namespace Intervals
  {
    // What is kept over steps only to save time is built again, as a restart
    // builds it, and only then a run writes checkpoints: a restart then repeats
    // it to the last bit.
    constexpr unsigned int rebuild = 400;
    // A run that is asked to stop does so earlier if that takes longer: batch
    // systems end it some 10 s after they ask. Units: s of wall time.
    constexpr double longest_wait = 5.;
    // Ranks agree on what each sees for itself; rarely, since that is
    // collective.
    constexpr unsigned int agreement = 20;
    // Ranks compare their work, and may repartition the mesh.
    constexpr unsigned int balance = 200;
    // Points are sorted again by their places in memory.
    constexpr unsigned int ordering = 200;
    // The time step looks for the smallest limit in all cells again.
    constexpr unsigned int time_step = 20;
    // Seepage looks whether the mudline has moved.
    constexpr unsigned int mudline = 10;
    // Coupled water takes permeability and density from the points again,
    constexpr unsigned int soil_of_water = 20;
    // and sets its equations up: the soil moves by a small part of a cell.
    constexpr unsigned int equations_of_water = 4;
    // Points are split and merged, in steps of the reference: between two of
    // these the mesh moves by less than the finest cell.
    constexpr double adaptation = 25.;

    // A checkpoint is agreed on in a step in which the caches are rebuilt.
    static_assert(rebuild % agreement == 0);
    // Counters that start at a rebuild have come round at the next one.
    static_assert(rebuild % balance == 0 && rebuild % ordering == 0 &&
                  rebuild % time_step == 0 && rebuild % mudline == 0 &&
                  rebuild % soil_of_water == 0);
    static_assert(soil_of_water % equations_of_water == 0);
    // So does the search for the time step at a stop.
    static_assert(agreement % time_step == 0);
  } // namespace Intervals
} // namespace CaissonMPM

#endif
