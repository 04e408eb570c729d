// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A .vtu file with an unstructured grid in pieces.
//
// deal.II writes what belongs to a cell as values of points, and no tensor with
// a component across its plane; hence a writer of our own. The format is that
// of VTK: "VTK File Formats" (Kitware), arrays compressed by zlib.
#ifndef caisson_mpm_output_vtu_file_h
#define caisson_mpm_output_vtu_file_h

#include <deal.II/base/point.h>

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Points or quadrilaterals in the plane of r and z, with their values. */
  class VtuPiece
  {
  public:
    /** An array of values, those of one point or cell after another. */
    struct Array
    {
      std::string        name; // with its unit
      unsigned int       n_components = 1;
      std::vector<float> values;
    };

    /** Add a point, and return its number. Units: m. */
    unsigned int
    add_point(const dealii::Point<2> &place);

    /** Add a cell of one point, or of four in the order of deal.II. */
    void
    add_cell(const std::vector<unsigned int> &corners);

    unsigned int
    n_cells() const
    {
      return offsets.size();
    }

    /** Return the element of the file; nothing where there is no cell. */
    std::string
    text() const;

    std::vector<Array>        of_points, of_cells;
    std::vector<std::int64_t> ids; // of the points, if there are any

  private:
    std::vector<float>         places; // three for each point
    std::vector<std::int32_t>  connectivity, offsets;
    std::vector<unsigned char> types;
  };

  /**
   * Write one file with the pieces make(i) of all ranks, @p n_pieces of each:
   * its form is the same on any number of ranks and for any number of pieces.
   * One piece of each rank is in the memory of the first one at a time. Throws
   * RunFailure on all ranks where the file cannot be written. Collective.
   * Units: s.
   */
  void
  write_vtu_file(const std::string                           &path,
                 const MPI_Comm                               communicator,
                 const double                                 time,
                 const unsigned int                           n_pieces,
                 const std::function<VtuPiece(unsigned int)> &make);
} // namespace CaissonMPM

#endif
