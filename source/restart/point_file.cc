// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstring>

namespace CaissonMPM
{
  namespace
  {
    // the cell is a column besides the numbers of the point
    constexpr unsigned int least_columns = 1 + n_numbers(0);

    // by value: a damaged file may contain anything
    unsigned int
    whole_number(const double x)
    {
      return x >= 0. && x < 4294967296. ? static_cast<unsigned int>(x) : 0u;
    }

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

    /** Every step can be undone, so that no single change is lost. */
    std::uint64_t
    checksum_of(const std::uint64_t row,
                const double       *values,
                const unsigned int  n_columns)
    {
      std::uint64_t result = row;
      for (unsigned int c = 0; c < n_columns; ++c)
        {
          std::uint64_t bits;
          std::memcpy(&bits, values + c, sizeof(bits));
          result = (result ^ bits) * 0x9e3779b97f4a7c15u; // odd
          result ^= result >> 32;
        }
      return result;
    }

    std::uint64_t
    checksum_of(const std::uint64_t        first_row,
                const std::vector<double> &rows,
                const unsigned int         n_columns)
    {
      std::uint64_t sum = 0;
      for (std::size_t i = 0; i < rows.size() / n_columns; ++i)
        sum +=
          checksum_of(first_row + i, rows.data() + i * n_columns, n_columns);
      return sum;
    }
  } // namespace

  unsigned int
  PointFile::bytes_per_point(const unsigned int n_user_state)
  {
    return (least_columns + n_user_state) * sizeof(double);
  }



  PointFile::PointFile(const std::string  &path,
                       const Access        access,
                       const unsigned long n_points,
                       const MPI_Comm      communicator,
                       const unsigned int  n_user_state)
    : n_columns(least_columns + n_user_state)
    , is_first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    // close() reports errors; HDF5 shall not print them
    check(H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr));
    const hid_t properties = check(H5Pcreate(H5P_FILE_ACCESS));
    check(H5Pset_fapl_mpio(properties, communicator, MPI_INFO_NULL));
    check(H5Pset_fclose_degree(properties, H5F_CLOSE_STRONG));
    // from this version on the structure of the file has checksums
    check(H5Pset_libver_bounds(properties, H5F_LIBVER_V18, H5F_LIBVER_LATEST));
    if (access == Access::create)
      create(path, properties, n_points);
    else
      open(path, properties, n_points);
    check(H5Pclose(properties));
  }



  PointFile::~PointFile()
  {
    close();
  }



  void
  PointFile::create(const std::string &path,
                    const hid_t        access,
                    const hsize_t      n_points)
  {
    file = check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
    const hsize_t dimensions[2] = {n_points, n_columns};
    dataspace              = check(H5Screate_simple(2, dimensions, nullptr));
    const hid_t properties = check(H5Pcreate(H5P_DATASET_CREATE));
    check(H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER));
    dataset = check(H5Dcreate2(file,
                               "points",
                               H5T_IEEE_F64LE,
                               dataspace,
                               H5P_DEFAULT,
                               properties,
                               H5P_DEFAULT));
    check(H5Pclose(properties));
    name_columns();
  }



  void
  PointFile::name_columns()
  {
    const std::string names = names_of_columns(n_user_state());
    const hid_t       type  = check(H5Tcopy(H5T_C_S1));
    check(H5Tset_size(type, names.size() + 1));
    const hid_t space     = check(H5Screate(H5S_SCALAR));
    const hid_t attribute = check(
      H5Acreate2(dataset, "columns", type, space, H5P_DEFAULT, H5P_DEFAULT));
    check(H5Awrite(attribute, type, names.c_str()));
    check(H5Aclose(attribute));
    check(H5Sclose(space));
    check(H5Tclose(type));
  }



  void
  PointFile::open(const std::string &path,
                  const hid_t        access,
                  const hsize_t      n_points)
  {
    file      = check(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access));
    dataset   = check(H5Dopen2(file, "points", H5P_DEFAULT));
    dataspace = check(H5Dget_space(dataset));
    if (H5Sget_simple_extent_ndims(dataspace) != 2)
      {
        succeeded = false;
        return;
      }
    hsize_t dimensions[2] = {0, 0};
    check(H5Sget_simple_extent_dims(dataspace, dimensions, nullptr));
    n_columns = std::max<hsize_t>(dimensions[1], least_columns);
    if (dimensions[0] != n_points || dimensions[1] != n_columns ||
        read_names_of_columns() != names_of_columns(n_user_state()))
      succeeded = false;
  }



  std::string
  PointFile::read_names_of_columns()
  {
    const hid_t attribute = check(H5Aopen(dataset, "columns", H5P_DEFAULT));
    if (!succeeded)
      return "";
    const hid_t type = check(H5Aget_type(attribute));
    std::string names(H5Tget_size(type), ' ');
    check(H5Aread(attribute, type, &names[0]));
    check(H5Tclose(type));
    check(H5Aclose(attribute));
    return names.substr(0, names.find('\0'));
  }



  template <typename Rows, typename Operation>
  void
  PointFile::transfer(const unsigned long first_row,
                      Rows               &rows,
                      const Operation    &operation)
  {
    if (rows.empty())
      return;
    const hsize_t start[2] = {first_row, 0},
                  count[2] = {rows.size() / n_columns, n_columns};
    const hid_t memory     = check(H5Screate_simple(2, count, nullptr));
    check(H5Sselect_hyperslab(
      dataspace, H5S_SELECT_SET, start, nullptr, count, nullptr));
    check(operation(
      dataset, H5T_NATIVE_DOUBLE, memory, dataspace, H5P_DEFAULT, rows.data()));
    check(H5Sclose(memory));
    sum_of_rows += checksum_of(first_row, rows, n_columns);
  }



  void
  PointFile::write(const unsigned long                first_row,
                   const std::vector<TravelingPoint> &points)
  {
    std::vector<double> rows;
    rows.reserve(points.size() * n_columns);
    for (const TravelingPoint &p : points)
      {
        AssertDimension(p.point.user_state.size(), n_user_state());
        rows.push_back(index_of(p.cell));
        append_numbers(p.point, rows);
      }
    transfer(first_row, rows, H5Dwrite);
  }



  std::vector<TravelingPoint>
  PointFile::read(const unsigned long first_row, const unsigned long n)
  {
    std::vector<double> rows(n * n_columns);
    transfer(first_row, rows, H5Dread);
    std::vector<TravelingPoint> points;
    points.reserve(n);
    for (std::size_t i = 0; i < rows.size(); i += n_columns)
      points.push_back({GlobalCell(whole_number(rows[i])),
                        point_of_numbers(rows.data() + i + 1, n_user_state())});
    return points;
  }



  void
  PointFile::write_field(const std::string         &name,
                         const std::vector<double> &values)
  {
    const hsize_t n     = values.size();
    const hid_t   space = check(H5Screate_simple(1, &n, nullptr));
    const hid_t   field = check(H5Dcreate2(file,
                                         name.c_str(),
                                         H5T_IEEE_F64LE,
                                         space,
                                         H5P_DEFAULT,
                                         H5P_DEFAULT,
                                         H5P_DEFAULT));
    if (is_first_rank)
      check(H5Dwrite(field,
                     H5T_NATIVE_DOUBLE,
                     H5S_ALL,
                     H5S_ALL,
                     H5P_DEFAULT,
                     values.data()));
    check(H5Dclose(field));
    check(H5Sclose(space));
  }



  std::vector<double>
  PointFile::read_field(const std::string &name)
  {
    const hid_t field = check(H5Dopen2(file, name.c_str(), H5P_DEFAULT));
    if (!succeeded)
      return {};
    const hid_t    space = check(H5Dget_space(field));
    const hssize_t n     = H5Sget_simple_extent_npoints(space);
    check(n);
    std::vector<double> values(std::max<hssize_t>(n, 0));
    check(H5Dread(
      field, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
    check(H5Sclose(space));
    check(H5Dclose(field));
    return values;
  }



  unsigned int
  PointFile::n_user_state() const
  {
    return n_columns - least_columns;
  }



  bool
  PointFile::close()
  {
    if (file >= 0) // for other ranks that read it
      check(H5Fflush(file, H5F_SCOPE_GLOBAL));
    if (dataspace >= 0)
      check(H5Sclose(dataspace));
    if (dataset >= 0)
      check(H5Dclose(dataset));
    if (file >= 0)
      check(H5Fclose(file));
    dataspace = dataset = file = -1;
    return succeeded;
  }



  hid_t
  PointFile::check(const hid_t result)
  {
    succeeded = succeeded && result >= 0;
    return result;
  }
} // namespace CaissonMPM
