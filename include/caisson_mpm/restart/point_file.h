// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Material points and fields of the grid in an HDF5 file: the dataset "points"
// [n_points][n_columns] of doubles, and one dataset [n_places] for each field.
// A row is a point: the global number of its cell, its material, its fields
// (kernels/point_fields.h) to the last digit, in SI units, and what a user's
// law keeps, if there is one. The attribute "columns" of "points" names the
// columns.
#ifndef caisson_mpm_restart_point_file_h
#define caisson_mpm_restart_point_file_h

#include <caisson_mpm/domain/grid_fields.h>
#include <caisson_mpm/domain/material_points.h>
#include <caisson_mpm/domain/point_exchange.h>

#include <hdf5.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Notes that a function of HDF5 has failed, instead of printing it. deal.II
   * looks for errors of HDF5 in Debug mode only. */
  class Hdf5Errors
  {
  public:
    Hdf5Errors()
    {
      const auto note = [](const hid_t, void *const any) -> herr_t {
        *static_cast<bool *>(any) = true;
        return 0;
      };
      H5Eset_auto2(H5E_DEFAULT, note, &any_);
    }

    ~Hdf5Errors()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    bool
    any() const
    {
      return any_;
    }

  private:
    bool any_ = false;
  };

  /** Points that a rank reads or writes at once. */
  constexpr unsigned long rows_per_piece = 20000;

  /** Return the names of the columns, separated by blanks, for points with so
   * many numbers of a user's law. */
  std::string
  names_of_columns(const unsigned int n_user_state);

  /** Write the points of all ranks, one rank's after the other's, each in the
   * order of its cells, and the fields of the first rank. Returns whether this
   * rank has met no error. Collective. */
  bool
  write_point_file(const std::string    &path,
                   const BackgroundGrid &grid,
                   const MaterialPoints &points,
                   const NamedFields    &fields);

  /** A file of points that is read, by each rank on its own. Where something
   * cannot be read, succeeded() is false, and the values mean nothing. */
  class PointFile
  {
  public:
    explicit PointFile(const std::string &path);

    ~PointFile();

    PointFile(const PointFile &) = delete;
    PointFile &
    operator=(const PointFile &) = delete;

    /** Return the points of @p n rows from @p first_row on. */
    std::vector<TravelingPoint>
    read(const unsigned long first_row,
         const unsigned long n,
         const unsigned int  n_user_state) const;

    /** Return a field of so many places. */
    std::vector<double>
    read_field(const std::string &name) const;

    bool
    succeeded() const
    {
      return !errors.any();
    }

  private:
    const Hdf5Errors errors;
    hid_t            file;
  };
} // namespace CaissonMPM

#endif
