// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/vtu_file.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <optional>

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

    /** Return an array as one compressed block, after its sizes. */
    template <typename Number>
    std::string
    element(const std::string         &type,
            const std::string         &name,
            const unsigned int         n_components,
            const std::vector<Number> &values)
    {
      const std::size_t          size = values.size() * sizeof(Number);
      uLongf                     n    = compressBound(size);
      std::vector<unsigned char> block(n);
      const int                  error =
        compress2(block.data(),
                  &n,
                  reinterpret_cast<const Bytef *>(values.data()),
                  size,
                  Z_BEST_SPEED);
      AssertThrow(error == Z_OK, ExcInternalError());
      const std::uint32_t all = size, head[] = {1, all, all, std::uint32_t(n)};
      return R"(<DataArray type=")" + type + R"(" Name=")" + name +
             R"(" NumberOfComponents=")" + to_text(n_components) +
             "\" format=\"binary\">\n" + encoded(head, sizeof(head)) +
             encoded(block.data(), n) + "\n</DataArray>\n";
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
  VtuPiece::text() const
  {
    if (n_cells() == 0)
      return "";
    std::string data = elements(of_points);
    if (!ids.empty())
      data += element("Int64", "id", 1, ids);
    return "<Piece NumberOfPoints=\"" + to_text(places.size() / 3) +
           "\" NumberOfCells=\"" + to_text(n_cells()) + "\">\n<Points>\n" +
           element("Float32", "Points", 3, places) + "</Points>\n<Cells>\n" +
           element("Int32", "connectivity", 1, connectivity) +
           element("Int32", "offsets", 1, offsets) +
           element("UInt8", "types", 1, types) + "</Cells>\n<PointData>\n" +
           data + "</PointData>\n<CellData>\n" + elements(of_cells) +
           "</CellData>\n</Piece>\n";
  }

  void
  write_vtu_file(const std::string                           &path,
                 const MPI_Comm                               communicator,
                 const double                                 time,
                 const unsigned int                           n_pieces,
                 const std::function<VtuPiece(unsigned int)> &make)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    std::optional<AtomicFile> file; // of the first rank
    if (rank == 0)
      file.emplace(path).append(
        "<?xml version=\"1.0\"?>\n"
        R"(<VTKFile type="UnstructuredGrid" version="0.1" )"
        R"(compressor="vtkZLibDataCompressor" byte_order="LittleEndian">)"
        "\n<UnstructuredGrid>\n<FieldData>\n"
        R"(<DataArray type="Float64" Name="TIME" NumberOfTuples="1" )"
        "format=\"ascii\">" +
        to_text(time, 17) + "</DataArray>\n</FieldData>\n");
    for (unsigned int i = 0; i < n_pieces; ++i)
      {
        const std::string own = make(i).text();
        const auto sizes = Utilities::MPI::all_gather(communicator, own.size());
        for (unsigned int r = 0; r < sizes.size(); ++r)
          {
            std::string piece = r == rank ? own : std::string(sizes[r], ' ');
            Utilities::MPI::broadcast(piece.data(), sizes[r], r, communicator);
            if (file)
              file->append(piece);
          }
      }
    int error = 0;
    if (file)
      {
        file->append("</UnstructuredGrid>\n</VTKFile>\n");
        error = file->finish();
      }
    error = Utilities::MPI::broadcast(communicator, error);
    if (error != 0)
      report_unwritable(path, error, "the frames so far are kept");
  }
} // namespace CaissonMPM
