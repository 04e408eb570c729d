// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Material points in an HDF5 file.
#ifndef caisson_mpm_restart_point_file_h
#define caisson_mpm_restart_point_file_h

#include <caisson_mpm/domain/point_exchange.h>

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * A file with one dataset of doubles, "points" [n_points][n_columns]. A row
   * is a point: the global number of its cell, its material, and its fields
   * (kernels/point_fields.h) to the last digit, in SI units, and what a user's
   * law keeps, if there is one. The attribute
   * "columns" of the dataset names the columns; a file with others is not read.
   * Fields of the grid are further datasets [n_places], each with its name.
   *
   * Any number of ranks share a file. To open and to close it is collective; in
   * between each rank writes or reads whichever rows it likes. Nothing throws
   * where the file cannot be written or read: close() reports it, so that all
   * ranks can agree. (deal.II's classes for HDF5 look for errors in Debug mode
   * only.)
   */
  class PointFile
  {
  public:
    enum class Access
    {
      create,
      read
    };

    /** The size of a row. Units: bytes. */
    static unsigned int
    bytes_per_point(const unsigned int n_user_state);

    /** Create a file for so many points, with so many numbers of a user's law
     * each, or open the one that has as many points. Collective. */
    PointFile(const std::string  &path,
              const Access        access,
              const unsigned long n_points,
              const MPI_Comm      communicator,
              const unsigned int  n_user_state = 0);
    ~PointFile();

    PointFile(const PointFile &) = delete;
    PointFile &
    operator=(const PointFile &) = delete;

    /** Write the points to the rows from @p first_row on. */
    void
    write(const unsigned long                first_row,
          const std::vector<TravelingPoint> &points);

    /** The points of @p n rows from @p first_row on. Their contents mean
     * nothing where this fails. */
    std::vector<TravelingPoint>
    read(const unsigned long first_row, const unsigned long n);

    /** Write a field, which every rank passes. Collective. */
    void
    write_field(const std::string &name, const std::vector<double> &values);

    /** Return a field on all ranks, empty where there is none. Collective. */
    std::vector<double>
    read_field(const std::string &name);

    /** The number of numbers that each point has of a user's law. */
    unsigned int
    n_user_state() const;

    /** Bring all to the file and close it. Returns whether all that this rank
     * has done with it succeeded. Collective. */
    bool
    close();

    /**
     * A sum over the rows that this rank has written or read. The sum over
     * ranks differs if a digit of any row does, or its place, but does not
     * depend on who wrote or read which rows.
     */
    std::uint64_t
    checksum() const
    {
      return sum_of_rows;
    }

  private:
    void
    create(const std::string &path, const hid_t access, const hsize_t n_points);
    void
    open(const std::string &path, const hid_t access, const hsize_t n_points);
    void
    name_columns();
    std::string
    read_names_of_columns();
    /** Write or read rows by H5Dwrite or H5Dread, and add their checksum. */
    template <typename Rows, typename Operation>
    void
    transfer(const unsigned long first_row,
             Rows               &rows,
             const Operation    &operation);

    /** Remember a failure. Returns what HDF5 returned. */
    hid_t
    check(const hid_t result);

    unsigned int  n_columns;
    const bool    is_first_rank;
    hid_t         file = -1, dataset = -1, dataspace = -1;
    bool          succeeded   = true;
    std::uint64_t sum_of_rows = 0;
  };
} // namespace CaissonMPM

#endif
