// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace CaissonMPM
{
  using namespace dealii;

  std::string
  names_of_columns(const unsigned int n_user_state)
  {
    std::string         names = "cell material";
    const MaterialPoint any;
    for_each_value(any, [&](const PointField &field, const double) {
      names += " " + field.name();
    });
    for (unsigned int i = 0; i < n_user_state; ++i)
      names += " user_state_" + to_text(i);
    return names;
  }

  bool
  write_point_file(const std::string    &path,
                   const BackgroundGrid &grid,
                   const MaterialPoints &points,
                   const NamedFields    &fields)
  {
    const MPI_Comm communicator = grid.communicator();
    const auto     n_of_ranks =
      Utilities::MPI::all_gather(communicator,
                                 static_cast<hsize_t>(points.n_points()));
    const auto own =
      n_of_ranks.begin() + Utilities::MPI::this_mpi_process(communicator);
    const hsize_t    n_columns = 1 + n_numbers(points.n_user_state());
    const Hdf5Errors errors;
    HDF5::File file(path, HDF5::File::FileAccessMode::create, communicator);

    auto table = file.create_dataset<double>(
      "points",
      {std::accumulate(n_of_ranks.begin(), n_of_ranks.end(), hsize_t(0)),
       n_columns});
    table.set_attribute("columns", names_of_columns(points.n_user_state()));
    hsize_t row = std::accumulate(n_of_ranks.begin(), own, hsize_t(0));
    std::vector<double> rows;
    unsigned long       n_written = 0;
    const auto          write     = [&]() { // collective
      const hsize_t n = rows.size() / n_columns;
      if (n > 0)
        table.write_hyperslab(rows, {row, 0}, {n, n_columns});
      else
        table.write_none<double>();
      row += n;
      rows.clear();
      ++n_written;
    };
    points.for_each([&](const MaterialPoint &point, const unsigned int cell) {
      rows.push_back(index_of(grid.global_number(cell)));
      append_numbers(point, rows);
      if (rows.size() == rows_per_piece * n_columns)
        write();
    });
    const hsize_t most =
      *std::max_element(n_of_ranks.begin(), n_of_ranks.end());
    while (n_written < most / rows_per_piece + 1)
      write();

    for (const auto &[name, values] : fields)
      {
        auto field = file.create_dataset<double>(name, {values.size()});
        if (grid.is_first_rank())
          field.write_hyperslab(values, {0}, {values.size()});
        else
          field.write_none<double>();
      }
    return !errors.any();
  }

  PointFile::PointFile(const std::string &path)
  {
    // deal.II would open it for writing, too, and a user may not be allowed to
    const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_mpio(properties, MPI_COMM_SELF, MPI_INFO_NULL);
    file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, properties);
    H5Pclose(properties);
  }

  PointFile::~PointFile()
  {
    H5Fclose(file);
  }

  std::vector<TravelingPoint>
  PointFile::read(const unsigned long first_row,
                  const unsigned long n,
                  const unsigned int  n_user_state) const
  {
    if (n == 0)
      return {};
    const unsigned int  n_columns = 1 + n_numbers(n_user_state);
    std::vector<double> rows(n * n_columns);
    const hsize_t       start[2] = {first_row, 0}, count[2] = {n, n_columns};
    const hid_t         points = H5Dopen2(file, "points", H5P_DEFAULT),
                space          = H5Dget_space(points),
                memory         = H5Screate_simple(2, count, nullptr);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
    H5Dread(points, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, rows.data());
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(points);
    std::vector<TravelingPoint> result;
    result.reserve(n);
    for (std::size_t i = 0; i < rows.size(); i += n_columns)
      result.push_back({GlobalCell(static_cast<unsigned int>(rows[i])),
                        point_of_numbers(rows.data() + i + 1, n_user_state)});
    return result;
  }

  std::vector<double>
  PointFile::read_field(const std::string &name) const
  {
    const hid_t field = H5Dopen2(file, name.c_str(), H5P_DEFAULT),
                space = H5Dget_space(field);
    std::vector<double> values(
      std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0));
    H5Dread(
      field, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(field);
    return values;
  }
} // namespace CaissonMPM
