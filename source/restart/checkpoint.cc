// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::string format_name = "caisson_mpm-checkpoint-14";

    // what a rank has in memory at a time besides its own
    constexpr unsigned long rows_per_piece = 20000;

    std::string
    info_file(const std::string &directory)
    {
      return directory + "/checkpoint.info";
    }

    /** What checkpoint.info says. */
    struct Info
    {
      std::string   file; // checkpoint-a.h5 or checkpoint-b.h5
      unsigned long n_points = 0;
      unsigned long n_bytes  = 0; // of the file
      std::uint64_t checksum = 0; // of the points
      std::vector<Checkpoint::FieldSum> fields;
      NamedNumbers                      state;
      std::vector<std::string>          warnings;
      std::string                       fingerprint;
    };

    /** The text below its first two lines. */
    std::string
    body_of(const Info &info)
    {
      std::ostringstream out;
      out << "file " << info.file << "\npoints " << info.n_points << "\nbytes "
          << info.n_bytes << "\nchecksum_of_points " << info.checksum
          << "\nfields\n";
      for (const auto &[name, sum] : info.fields)
        out << name << ' ' << sum << '\n';
      out << "state\n";
      for (const auto &[name, value] : info.state)
        out << name << ' ' << to_text(value, 17) << '\n';
      out << "warnings\n";
      for (std::string warning : info.warnings)
        {
          std::replace(warning.begin(), warning.end(), '\n', ' ');
          out << warning << '\n';
        }
      out << "fingerprint\n" << info.fingerprint;
      return out.str();
    }

    std::string
    text_of(const Info &info)
    {
      const std::string body = body_of(info);
      return "format " + format_name + "\nchecksum_of_text " +
             fingerprint_of(body) + "\n" + body;
    }

    /** Return the lines up to this one. */
    std::vector<std::string>
    read_lines(std::istream &in, const std::string &end)
    {
      std::vector<std::string> lines;
      for (std::string line; std::getline(in, line) && line != end;)
        lines.push_back(line);
      return lines;
    }

    /** Call action(name, value) for the lines up to this one. */
    template <typename Action>
    void
    read_pairs(std::istream &in, const std::string &end, const Action &action)
    {
      for (const std::string &line : read_lines(in, end))
        action(line.substr(0, line.find(' ')), line.substr(line.find(' ') + 1));
    }

    /** No value for a text that is damaged or of another version. */
    std::optional<Info>
    parse_info(const std::string &text)
    {
      std::istringstream in(text);
      std::string        format, checksum;
      std::getline(in, format);
      std::getline(in, checksum);
      const std::string body =
        in ? text.substr(format.size() + checksum.size() + 2) : std::string();
      if (format != "format " + format_name ||
          checksum != "checksum_of_text " + fingerprint_of(body))
        return {};
      std::map<std::string, std::string> entries;
      Info                               info;
      read_pairs(in, "fields", [&](const auto &name, const auto &value) {
        entries[name] = value;
      });
      read_pairs(in, "state", [&](const auto &name, const auto &value) {
        info.fields.emplace_back(name, value);
      });
      const auto count = [&](const std::string &name) {
        return std::strtoul(entries[name].c_str(), nullptr, 10);
      };
      info.file     = entries["file"];
      info.n_points = count("points");
      info.n_bytes  = count("bytes");
      info.checksum = count("checksum_of_points");
      read_pairs(in, "warnings", [&](const auto &name, const auto &value) {
        info.state.emplace_back(name, std::strtod(value.c_str(), nullptr));
      });
      info.warnings = read_lines(in, "fingerprint");
      std::ostringstream rest;
      rest << in.rdbuf();
      info.fingerprint = rest.str();
      return info;
    }



    // ---------------------------------------------------------- files

    unsigned long
    size_of(const fs::path &file)
    {
      std::error_code error;
      const auto      size = fs::file_size(file, error);
      return error ? 0 : size;
    }

    /** Bring the file to the disk; 0 or an errno. */
    int
    synchronize(const fs::path &file)
    {
      const int descriptor = open(file.c_str(), O_RDONLY);
      if (descriptor < 0)
        return errno;
      const int error = fsync(descriptor) == 0 ? 0 : errno;
      close(descriptor);
      return error;
    }

    bool
    has_space(const std::string &directory, const unsigned long n_bytes)
    {
      std::error_code error; // then it is the largest number
      return fs::space(directory, error).available >= n_bytes;
    }

    /** Remove an older checkpoint of this name, and see whether a new one can
     * become as large as that; 0 or an errno. HDF5 must not find out: if it
     * cannot close a file, it crashes when the program ends. */
    int
    make_room(const fs::path &file, const unsigned long n_bytes)
    {
      OutputDirectory::remove(file.string());
      const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT, 0666);
      if (descriptor < 0)
        return errno;
      int error = fallocate(descriptor, 0, 0, n_bytes) == 0 ? 0 : errno;
      if (error == EOPNOTSUPP) // by this file system
        error = has_space(file.parent_path(), n_bytes) ? 0 : ENOSPC;
      close(descriptor);
      OutputDirectory::remove(file.string());
      return error;
    }

    /** Call action() on the first rank; all throw where it returns an errno. */
    template <typename Action>
    void
    on_first_rank(const MPI_Comm     communicator,
                  const std::string &directory,
                  const Action      &action)
    {
      const bool first = Utilities::MPI::this_mpi_process(communicator) == 0;
      const int error = Utilities::MPI::max(first ? action() : 0, communicator);
      if (error != 0)
        report_unwritable("the checkpoint in " + directory,
                          error,
                          "the one before it, if any, is still valid");
    }



    // ---------------------------------------------------------- points

    /** Close the file. The checksum of all ranks' rows, unless one has failed.
     * Collective. */
    std::optional<std::uint64_t>
    finish(PointFile &file, const MPI_Comm communicator)
    {
      const bool succeeded =
        Utilities::MPI::min(file.close() ? 1 : 0, communicator) == 1;
      const auto sum = Utilities::MPI::sum(file.checksum(), communicator);
      return succeeded ? std::make_optional(sum) : std::nullopt;
    }

    std::string
    checksum_of(const std::vector<double> &values)
    {
      return fingerprint_of(
        std::string(reinterpret_cast<const char *>(values.data()),
                    values.size() * sizeof(double)));
    }

    std::vector<Checkpoint::FieldSum>
    checksums_of(const NamedFields &fields)
    {
      std::vector<Checkpoint::FieldSum> result;
      for (const auto &[name, values] : fields)
        result.emplace_back(name, checksum_of(values));
      return result;
    }

    /** Write the fields, and the points of all ranks, one rank's after the
     * other's, each in the order of its cells. Returns as finish(). Collective.
     */
    std::optional<std::uint64_t>
    write_data(const std::string    &path,
               const BackgroundGrid &grid,
               const MaterialPoints &points,
               const NamedFields    &fields)
    {
      const MPI_Comm communicator = grid.communicator();
      const auto     n            = Utilities::MPI::all_gather(
        communicator, static_cast<unsigned long>(points.n_points()));
      const auto own =
        n.begin() + Utilities::MPI::this_mpi_process(communicator);
      unsigned long               row = std::accumulate(n.begin(), own, 0ul);
      PointFile                   file(path,
                     PointFile::Access::create,
                     std::accumulate(n.begin(), n.end(), 0ul),
                     communicator,
                     points.n_user_state());
      std::vector<TravelingPoint> piece;
      piece.reserve(std::min(*own, rows_per_piece));
      const auto write_piece = [&]() {
        file.write(row, piece);
        row += piece.size();
        piece.clear();
      };
      points.for_each([&](const MaterialPoint &point, const unsigned int cell) {
        piece.push_back({grid.global_number(cell), point});
        if (piece.size() == rows_per_piece)
          write_piece();
      });
      write_piece();
      for (const auto &[name, values] : fields)
        file.write_field(name, values);
      return finish(file, communicator);
    }

    /** Read the fields of these names; their values mean nothing where this
     * fails. Collective. */
    NamedFields
    read_all_fields(const std::string                       &path,
                    const unsigned long                      n_points,
                    const std::vector<Checkpoint::FieldSum> &fields,
                    const MPI_Comm                           communicator)
    {
      NamedFields result;
      PointFile   file(path, PointFile::Access::read, n_points, communicator);
      for (const auto &[name, sum] : fields)
        result.emplace_back(name, file.read_field(name));
      return result;
    }

    /**
     * Read all points and call action(points) for each piece, as often on all
     * ranks: the pieces of all of them, one rank's after the other's, are the
     * next rows of the file. Returns as finish(). Collective.
     */
    template <typename Action>
    std::optional<std::uint64_t>
    read_all_points(const std::string  &path,
                    const unsigned long n_points,
                    const MPI_Comm      communicator,
                    const Action       &action)
    {
      PointFile  file(path, PointFile::Access::read, n_points, communicator);
      const auto n_ranks = Utilities::MPI::n_mpi_processes(communicator),
                 rank    = Utilities::MPI::this_mpi_process(communicator);
      for (unsigned long row = 0; row < n_points;
           row += n_ranks * rows_per_piece)
        {
          const unsigned long begin =
                                std::min(n_points, row + rank * rows_per_piece),
                              end = std::min(n_points, begin + rows_per_piece);
          action(file.read(begin, end - begin));
        }
      return finish(file, communicator);
    }



    // ---------------------------------------------------------- reading

    std::string
    next_line(std::istream &in)
    {
      std::string line;
      return std::getline(in, line) ? line : "(no further entry)";
    }

    [[noreturn]] void
    report_damaged(const std::string &directory)
    {
      throw BadInput(
        "the checkpoint in " + directory +
        " is damaged, or was written by another version. Compute the run that "
        "wrote it again, without --restart: its results so far are moved to a "
        "subdirectory earlier_N.");
    }

    Info
    read_info(const std::string &directory)
    {
      const std::string text = read_text(info_file(directory));
      if (text.empty())
        throw BadInput("there is no checkpoint in " + directory +
                       " to resume from (no file checkpoint.info). Give the "
                       "output directory of the run that was stopped, or run "
                       "without --restart.");
      const auto info = parse_info(text);
      if (!info || size_of(directory + "/" + info->file) != info->n_bytes)
        report_damaged(directory);
      return *info;
    }
  } // namespace



  void
  write_checkpoint(const std::string              &directory,
                   const BackgroundGrid           &grid,
                   const MaterialPoints           &points,
                   const NamedFields              &fields,
                   const NamedNumbers             &state,
                   const std::vector<std::string> &warnings,
                   const std::string              &fingerprint)
  {
    const MPI_Comm communicator = grid.communicator();
    Info           info;
    const auto     valid      = parse_info(read_text(info_file(directory)));
    const bool     a_is_valid = valid && valid->file == "checkpoint-a.h5";
    info.file = Utilities::MPI::broadcast(communicator, a_is_valid ? 1 : 0) ?
                  "checkpoint-b.h5" :
                  "checkpoint-a.h5";
    info.n_points =
      Utilities::MPI::sum<unsigned long>(points.n_points(), communicator);
    info.fields            = checksums_of(fields);
    info.state             = state;
    info.warnings          = warnings;
    info.fingerprint       = fingerprint;
    const std::string path = directory + "/" + info.file;
    unsigned long     n_bytes =
      info.n_points * PointFile::bytes_per_point(points.n_user_state());
    for (const auto &field : fields)
      n_bytes += field.second.size() * sizeof(double);
    const auto on_failure = [&]() {
      const int error = has_space(directory, n_bytes) ? EIO : ENOSPC;
      OutputDirectory::remove(path);
      return error;
    };
    on_first_rank(communicator, directory, [&]() {
      return make_room(path, n_bytes + 10000);
    });

    const auto written = write_data(path, grid, points, fields);
    on_first_rank(communicator, directory, [&]() {
      return written ? synchronize(path) : on_failure();
    });

    // see that all is there: a full disk is not always reported
    const auto found =
      read_all_points(path, info.n_points, communicator, [](const auto &) {});
    const NamedFields found_fields =
      read_all_fields(path, info.n_points, info.fields, communicator);
    on_first_rank(communicator, directory, [&]() {
      if (found != written || checksums_of(found_fields) != info.fields)
        return on_failure();
      info.n_bytes  = size_of(path);
      info.checksum = *written;
      return try_to_write(info_file(directory), text_of(info));
    });
  }



  bool
  Checkpoint::is_in(const std::string &directory)
  {
    return !read_text(info_file(directory)).empty();
  }



  Checkpoint::Checkpoint(const std::string &directory)
    : directory(directory)
  {
    const Info info = read_info(directory);
    file            = info.file;
    n_points        = info.n_points;
    checksum        = info.checksum;
    fields          = info.fields;
    state_          = info.state;
    warnings_       = info.warnings;
    fingerprint_    = info.fingerprint;
  }



  void
  Checkpoint::check_fingerprint(const std::string &fingerprint) const
  {
    if (fingerprint_ == fingerprint)
      return;
    std::istringstream then(fingerprint_), now(fingerprint);
    std::string        a, b;
    while (a == b && (then || now))
      {
        a = next_line(then);
        b = next_line(now);
      }
    throw BadInput("the checkpoint in " + directory + " was written with\n  " +
                   a + "\nand cannot be used with\n  " + b +
                   "\nSet it back, or start the run again, without "
                   "--restart, in another directory.");
  }



  NamedFields
  Checkpoint::read_fields(const MPI_Comm communicator) const
  {
    const NamedFields result =
      read_all_fields(directory + "/" + file, n_points, fields, communicator);
    const bool are_whole = checksums_of(result) == fields;
    if (Utilities::MPI::min(are_whole ? 1 : 0, communicator) == 0)
      report_damaged(directory);
    return result;
  }



  void
  Checkpoint::read_points(const BackgroundGrid &grid,
                          MaterialPoints       &points) const
  {
    const MPI_Comm communicator   = grid.communicator();
    const auto     for_each_piece = [&](const auto &action) {
      if (read_all_points(
            directory + "/" + file, n_points, communicator, action) != checksum)
        report_damaged(directory);
    };

    // first see that all is there, and how many points go where
    std::vector<unsigned int> n_in_cell(grid.n_global_cells(), 0);
    for_each_piece([&](const std::vector<TravelingPoint> &piece) {
      for (const TravelingPoint &p : piece)
        if (index_of(p.cell) < n_in_cell.size() &&
            p.point.user_state.size() == points.n_user_state())
          ++n_in_cell[index_of(p.cell)];
    });
    Utilities::MPI::sum(n_in_cell, communicator, n_in_cell);
    if (std::accumulate(n_in_cell.begin(), n_in_cell.end(), 0ul) != n_points)
      report_damaged(directory);

    points.reset(n_in_cell);
    for_each_piece([&](const std::vector<TravelingPoint> &piece) {
      for (const TravelingPoint &p : send_to_owners(grid, piece))
        points.add(grid.local_number(p.cell), p.point);
    });
    points.settle();
  }
} // namespace CaissonMPM
