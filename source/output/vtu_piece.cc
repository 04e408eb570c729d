// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/vtu_piece.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <zlib.h>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    /** Return the bytes in base 64. */
    std::string
    encoded(const void *bytes, const std::size_t size)
    {
      const auto *const first = static_cast<const unsigned char *>(bytes);
      return Utilities::encode_base64(
        std::vector<unsigned char>(first, first + size));
    }

    /** Return the bytes as one compressed block, after its sizes. */
    std::string
    compressed(const void *bytes, const std::size_t size)
    {
      uLongf                     n = compressBound(size);
      std::vector<unsigned char> block(n);
      const int                  error = compress2(block.data(),
                                  &n,
                                  static_cast<const Bytef *>(bytes),
                                  size,
                                  Z_BEST_SPEED);
      AssertThrow(error == Z_OK, ExcInternalError());
      const std::uint32_t all = size, head[] = {1, all, all, std::uint32_t(n)};
      return encoded(head, sizeof(head)) + encoded(block.data(), n);
    }

    template <typename Number>
    std::string
    element(const std::string         &type,
            const std::string         &name,
            const unsigned int         n_components,
            const std::vector<Number> &values)
    {
      return R"(<DataArray type=")" + type + R"(" Name=")" + name +
             R"(" NumberOfComponents=")" + to_text(n_components) +
             "\" format=\"binary\">\n" +
             compressed(values.data(), values.size() * sizeof(Number)) +
             "\n</DataArray>\n";
    }

    std::string
    elements(const std::vector<VtuPiece::Array> &arrays)
    {
      std::string text;
      for (const auto &array : arrays)
        text +=
          element("Float32", array.name, array.n_components, array.values);
      return text;
    }
  } // namespace

  unsigned int
  VtuPiece::add_point(const Point<2> &place)
  {
    for (unsigned int d = 0; d < 2; ++d)
      places.push_back(place[d]);
    places.push_back(0.f);
    return places.size() / 3 - 1;
  }

  void
  VtuPiece::add_cell(const std::vector<unsigned int> &corners)
  {
    constexpr unsigned char vertex = 1, quadrilateral = 9; // of VTK
    if (corners.size() == 1)
      connectivity.push_back(corners[0]);
    else
      for (const unsigned int corner : {0, 1, 3, 2})
        connectivity.push_back(corners[corner]);
    offsets.push_back(connectivity.size());
    types.push_back(corners.size() == 1 ? vertex : quadrilateral);
  }

  std::string
  VtuPiece::text(const double time) const
  {
    std::string data = elements(of_points);
    if (!ids.empty())
      data += element("Int64", "id", 1, ids);
    return "<?xml version=\"1.0\"?>\n"
           R"(<VTKFile type="UnstructuredGrid" version="0.1" )"
           R"(compressor="vtkZLibDataCompressor" byte_order="LittleEndian">)"
           "\n<UnstructuredGrid>\n<FieldData>\n"
           R"(<DataArray type="Float64" Name="TIME" NumberOfTuples="1" )"
           "format=\"ascii\">" +
           to_text(time, 17) +
           "</DataArray>\n</FieldData>\n"
           "<Piece NumberOfPoints=\"" +
           to_text(places.size() / 3) + "\" NumberOfCells=\"" +
           to_text(n_cells()) + "\">\n<Points>\n" +
           element("Float32", "Points", 3, places) + "</Points>\n<Cells>\n" +
           element("Int32", "connectivity", 1, connectivity) +
           element("Int32", "offsets", 1, offsets) +
           element("UInt8", "types", 1, types) + "</Cells>\n<PointData>\n" +
           data + "</PointData>\n<CellData>\n" + elements(of_cells) +
           "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }
} // namespace CaissonMPM
