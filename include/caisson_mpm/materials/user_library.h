// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A shared library with a UMAT, the form in which Abaqus takes a constitutive
// law.
//
// Reference: Abaqus User Subroutines Reference Guide, UMAT.
#ifndef caisson_mpm_materials_user_library_h
#define caisson_mpm_materials_user_library_h

#include <cstddef>
#include <string>

namespace CaissonMPM
{
  /** A UMAT, as a compiler of Fortran passes its arguments: all by reference,
   * and the length of CMNAME behind all of them. */
  using Umat = void (*)(double     *stress,
                        double     *statev,
                        double     *ddsdde,
                        double     *sse,
                        double     *spd,
                        double     *scd,
                        double     *rpl,
                        double     *ddsddt,
                        double     *drplde,
                        double     *drpldt,
                        double     *stran,
                        double     *dstran,
                        double     *time,
                        double     *dtime,
                        double     *temp,
                        double     *dtemp,
                        double     *predef,
                        double     *dpred,
                        char       *cmname,
                        int        *ndi,
                        int        *nshr,
                        int        *ntens,
                        int        *nstatv,
                        double     *props,
                        int        *nprops,
                        double     *coords,
                        double     *drot,
                        double     *pnewdt,
                        double     *celent,
                        double     *dfgrd0,
                        double     *dfgrd1,
                        int        *noel,
                        int        *npt,
                        int        *layer,
                        int        *kspt,
                        int        *jstep,
                        int        *kinc,
                        std::size_t length_of_cmname);

  /**
   * A library that stays loaded until the program ends. It finds XIT,
   * STDB_ABQERR, GETOUTDIR and GETJOBNAME of Abaqus in the program.
   */
  class UserLibrary
  {
  public:
    /** Load the library. @p entry is the entry that names it, with its value,
     * for messages. Throws BadInput where it cannot be loaded, or has no UMAT.
     */
    UserLibrary(const std::string &path, const std::string &entry);

    Umat
    umat() const
    {
      return umat_;
    }

    /** Return digits that differ where the content of the file does. */
    const std::string &
    checksum() const
    {
      return checksum_;
    }

  private:
    Umat        umat_ = nullptr;
    std::string checksum_;
  };
} // namespace CaissonMPM

#endif
