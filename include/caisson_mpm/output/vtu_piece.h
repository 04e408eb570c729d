// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The text of a .vtu file with one piece of an unstructured grid.
//
// deal.II writes what belongs to a cell as values of points, and no tensor with
// a component across its plane; hence a writer of our own. The format is that
// of VTK: "VTK File Formats" (Kitware), arrays compressed by zlib.
#ifndef caisson_mpm_output_vtu_piece_h
#define caisson_mpm_output_vtu_piece_h

#include <deal.II/base/point.h>

#include <cstdint>
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

    /** Return the text, with the @p time in it. Units: s. */
    std::string
    text(const double time) const;

    std::vector<Array>        of_points, of_cells;
    std::vector<std::int64_t> ids; // of the points, if there are any

  private:
    std::vector<float>         places; // three for each point
    std::vector<std::int32_t>  connectivity, offsets;
    std::vector<unsigned char> types;
  };
} // namespace CaissonMPM

#endif
