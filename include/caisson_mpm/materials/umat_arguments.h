// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The arguments of a UMAT, with guard words between them.
//
// Reference: Abaqus User Subroutines Reference Guide, UMAT and SDVINI.
#ifndef caisson_mpm_materials_umat_arguments_h
#define caisson_mpm_materials_umat_arguments_h

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

namespace CaissonMPM
{
  /** The arguments in the order of the call; NCRDS is that of SDVINI. */
  namespace UmatArgument
  {
    enum Index : unsigned int
    {
      // clang-format off
      stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt,
      stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname,
      ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent,
      dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc,
      n_of_umat, ncrds = n_of_umat,
      n_arguments, around_all // what is around all of them
                 // clang-format on
    };
    constexpr std::size_t length_of_cmname = 80;

    /** "STRESS" and so on. */
    const char *
    name(const unsigned int argument);
  } // namespace UmatArgument

  /** A routine of a library. */
  using Routine = void (*)();

  /**
   * The arguments of the calls. A call gets a copy of all of them, which it may
   * change as it likes, with guard words before and behind each array: numbers
   * that are not finite, and say by their bits which argument they guard. The
   * copy fills pages of its own, and a mebibyte on both sides can be neither
   * read nor written: a call that tries it has crashed.
   */
  class UmatArguments
  {
  public:
    using Index = UmatArgument::Index;

    /** Zeros. */
    UmatArguments(const unsigned int n_components,
                  const unsigned int n_variables,
                  const unsigned int n_properties);

    UmatArguments(const UmatArguments &) = delete;
    UmatArguments &
    operator=(const UmatArguments &) = delete;

    /** The numbers that the next call gets. */
    double *
    given(const Index argument)
    {
      return own.data() + places[argument];
    }
    const double *
    given(const Index argument) const
    {
      return own.data() + places[argument];
    }

    /** Set an argument to an integer, or return it. */
    void
    give(const Index argument, const int value)
    {
      std::memcpy(given(argument), &value, sizeof(value));
    }
    int
    given_integer(const Index argument) const
    {
      int value;
      std::memcpy(&value, given(argument), sizeof(value));
      return value;
    }

    /** What the last call has made of the argument. */
    const double *
    returned(const Index argument) const
    {
      return lent.get() + places[argument];
    }

    std::size_t
    size(const Index argument) const
    {
      return sizes[argument];
    }

    /** Call umat(STRESS, STATEV, ...) or sdvini(STATEV, COORDS, NSTATV, NCRDS,
     * NOEL, NPT, LAYER, KSPT), as a compiler of Fortran does: by reference,
     * with the length of CMNAME behind all. */
    void
    call_umat(const Routine umat);
    void
    call_sdvini(const Routine sdvini);

    /** The argument whose guard the last call has written to; n_arguments if
     * none. */
    Index
    written_guard() const;

    /** The argument whose guard was read, if the number is computed with it;
     * n_arguments else. */
    static Index
    guard_in(const double number);

  private:
    std::array<std::size_t, UmatArgument::n_arguments> sizes, places;
    std::vector<unsigned int> guard_words; // where they are
    std::size_t               end;         // of the arguments; guards follow
    std::vector<double>       own;
    std::shared_ptr<double>   lent;
  };
} // namespace CaissonMPM

#endif
