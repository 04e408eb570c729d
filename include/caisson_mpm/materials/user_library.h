// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A shared library with a UMAT, the form in which Abaqus takes a constitutive
// law.
#ifndef caisson_mpm_materials_user_library_h
#define caisson_mpm_materials_user_library_h

#include <caisson_mpm/materials/umat_arguments.h>
#include <caisson_mpm/materials/umat_settings.h>

#include <string>

namespace CaissonMPM
{
  /** A library that stays loaded until the program ends. */
  struct UserLibrary
  {
    Routine umat;
    Routine sdvini; // sets the STATEV of a point at the start; null without
    std::string
      checksum; // digits that differ where the content of the file does
  };

  /**
   * Load the library of the settings, whose path is relative to @p directory. It
   * finds the routines of abaqus_routines.cc in the program. @p entry is the
   * entry that names it, with its value, for messages. Throws BadInput where it
   * cannot be loaded, or has no routine of the name in the settings.
   */
  UserLibrary
  load_user_library(const UmatSettings &settings,
                    const std::string  &directory,
                    const std::string  &entry);
} // namespace CaissonMPM

#endif
