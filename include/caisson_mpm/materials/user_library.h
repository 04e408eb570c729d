// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A shared library with a UMAT, the form in which Abaqus takes a constitutive
// law.
#ifndef caisson_mpm_materials_user_library_h
#define caisson_mpm_materials_user_library_h

#include <caisson_mpm/materials/umat_arguments.h>

#include <string>

namespace CaissonMPM
{
  /**
   * A library that stays loaded until the program ends. It finds the routines
   * of abaqus_routines.cc in the program.
   */
  class UserLibrary
  {
  public:
    /** Load the library. @p routine is the name of its UMAT, or MODULE::NAME;
     * @p entry is the entry that names the library, with its value, for
     * messages. Throws BadInput where it cannot be loaded, or has no such
     * routine.
     */
    UserLibrary(const std::string &path,
                const std::string &routine,
                const std::string &entry);

    Routine
    umat() const
    {
      return umat_;
    }

    /** SDVINI, which sets the STATEV of a point at the start; null without. */
    Routine
    sdvini() const
    {
      return sdvini_;
    }

    /** Return digits that differ where the content of the file does. */
    const std::string &
    checksum() const
    {
      return checksum_;
    }

  private:
    Routine     umat_, sdvini_;
    std::string checksum_;
  };
} // namespace CaissonMPM

#endif
