// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Layers that take the entries of another one.
#ifndef caisson_mpm_materials_like_layer_h
#define caisson_mpm_materials_like_layer_h

#include <caisson_mpm/base/parameter_origins.h>

namespace CaissonMPM
{
  /**
   * Set in each section "Soil/Layer k" with an entry Like layer = j all entries
   * that are set in "Soil/Layer j" and not here, but for Top depth. An entry
   * that is set here also keeps off those of layer j that say the same in
   * another way, such as Porosity and Void ratio. Throws BadInput where j is
   * not the number of a layer above. Not collective.
   */
  void
  fill_like_layers(ParameterOrigins &origins);
} // namespace CaissonMPM

#endif
