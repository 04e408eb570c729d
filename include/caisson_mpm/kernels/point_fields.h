// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The one list of the fields of a material point (MP). A line here is all that
// a field needs: it gets its place in the blocks and in MaterialPoint, moves
// with its MP from cell to cell and from rank to rank, is split and merged, is
// kept in checkpoints, can be observed, and is drawn if the line says so.
//
// Every line names the member of the block, what it is one component of
// (PART), or how its components are called (LIST), the unit, how the value of
// two MPs that become one follows from theirs, whether frames show it, and what
// it means where the name does not say it. The merges are
//   sum        the sum, of which two halves of an MP have half each,
//   by_mass    the mean, weighted by mass,
//   by_volume  the mean, weighted by volume,
//   smallest   the smaller one.
// Stresses are effective and positive in tension; base/conventions.h has the
// order of the components. Of "rad": per radian, or per meter in plane strain.
#ifndef caisson_mpm_kernels_point_fields_h
#define caisson_mpm_kernels_point_fields_h

/** What every step reads and writes. */
#define CAISSON_BLOCK_FIELDS(PART, LIST, FIELD)            \
  PART(r, position, 0, "m", by_mass, not_drawn, "")        \
  PART(z, position, 1, "m", by_mass, not_drawn, "")        \
  PART(velocity_r, velocity, 0, "m/s", by_mass, drawn, "") \
  PART(velocity_z, velocity, 1, "m/s", by_mass, drawn, "") \
  LIST(stress, 4, tensor, "Pa", by_volume, drawn, "")      \
  FIELD(mass, "kg/rad", sum, not_drawn, "scaled")          \
  FIELD(volume, "m3/rad", sum, not_drawn, "")              \
  FIELD(plastic_deviatoric, "none", by_mass, drawn, "")    \
  FIELD(plastic_volumetric, "none", by_mass, drawn, "growth positive")

/** What a step of most laws leaves alone: the past of the MPs. */
#define CAISSON_HISTORY_FIELDS(PART, LIST, FIELD)                          \
  LIST(state, n_state_variables, numbered, "none", by_mass, not_drawn, "") \
  PART(initial_r, initial_position, 0, "m", by_mass, not_drawn, "")        \
  PART(initial_z, initial_position, 1, "m", by_mass, not_drawn, "")        \
  FIELD(initial_volume, "m3/rad", sum, not_drawn, "")                      \
  FIELD(id, "none", smallest, not_drawn, "")                               \
  PART(size_r, size, 0, "m", by_mass, not_drawn, "as stretched")           \
  PART(size_z, size, 1, "m", by_mass, not_drawn, "as stretched")           \
  FIELD(pore_pressure, "Pa", by_volume, not_drawn, "excess, at the last output")

#endif
