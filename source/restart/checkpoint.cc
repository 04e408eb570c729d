// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/domain/point_fields.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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
    const std::string format_name = "caisson_mpm-checkpoint-15";

    std::string
    info_file(const std::string &directory)
    {
      return directory + "/checkpoint.info";
    }

    using Info = Checkpoint::Info;

    /** The text below its first two lines. */
    std::string
    body_of(const Info &info)
    {
      std::ostringstream out;
      out << "file " << info.file << "\nchecksum_of_file "
          << info.checksum_of_file << "\npoints " << info.n_points
          << "\ncolumns " << info.columns << "\nfields\n";
      for (const std::string &name : info.fields)
        out << name << '\n';
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
      read_pairs(in, "fields", [&](const auto &name, const auto &value) {
        entries[name] = value;
      });
      Info info;
      info.file             = entries["file"];
      info.checksum_of_file = entries["checksum_of_file"];
      info.n_points = std::strtoul(entries["points"].c_str(), nullptr, 10);
      info.columns  = entries["columns"];
      info.fields   = read_lines(in, "state");
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

    /** The checksum of all its bytes. */
    std::string
    checksum_of(const std::string &path)
    {
      std::ifstream file(path, std::ios::binary);
      Fingerprint   result;
      std::string   piece(1 << 20, ' ');
      while (file.read(piece.data(), piece.size()), file.gcount() > 0)
        {
          piece.resize(file.gcount());
          result.add(piece);
        }
      return result.digits();
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

    // ---------------------------------------------------------- reading

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
                       " to resume from (checkpoint.info is missing or "
                       "empty). Give the output directory of the run that was "
                       "stopped, or run without --restart.");
      const auto info = parse_info(text);
      if (!info)
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
    info.columns          = names_of_columns(points.n_user_state());
    info.state            = state;
    info.warnings         = warnings;
    info.fingerprint      = fingerprint;
    unsigned long n_bytes = 10000 + info.n_points *
                                      (1 + n_numbers(points.n_user_state())) *
                                      sizeof(double);
    for (const auto &[name, values] : fields)
      {
        info.fields.push_back(name);
        n_bytes += values.size() * sizeof(double);
      }

    const std::string path = directory + "/" + info.file;
    on_first_rank(communicator, directory, [&]() {
      return make_room(path, n_bytes);
    });
    const bool failed =
      Utilities::MPI::max(write_point_file(path, grid, points, fields) ? 0 : 1,
                          communicator) > 0;
    on_first_rank(communicator, directory, [&]() {
      int error = failed ? EIO : synchronize(path);
      if (error == EIO && !has_space(directory, n_bytes))
        error = ENOSPC;
      if (error == 0)
        {
          info.checksum_of_file = checksum_of(path);
          error = try_to_write(info_file(directory), text_of(info));
        }
      if (error != 0)
        OutputDirectory::remove(path);
      return error;
    });
  }

  bool
  Checkpoint::is_in(const std::string &directory)
  {
    return !read_text(info_file(directory)).empty();
  }

  Checkpoint::Checkpoint(const std::string &directory)
    : info(read_info(directory))
    , directory(directory)
  {}

  void
  Checkpoint::check_fingerprint(const std::string &fingerprint) const
  {
    if (info.fingerprint == fingerprint)
      return;
    std::istringstream then(info.fingerprint), now(fingerprint);
    const auto         next_line = [](std::istream &in) {
      std::string line;
      return std::getline(in, line) ? line : "(no further entry)";
    };
    std::string a, b;
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
  Checkpoint::read_fields() const
  {
    const PointFile file(directory + "/" + info.file);
    NamedFields     result;
    for (const std::string &name : info.fields)
      result.emplace_back(name, file.read_field(name));
    if (!file.succeeded())
      report_damaged(directory);
    return result;
  }

  void
  Checkpoint::read_points(const BackgroundGrid &grid,
                          MaterialPoints       &points) const
  {
    const MPI_Comm    communicator = grid.communicator();
    const std::string path         = directory + "/" + info.file;
    const auto        ask_all      = [&](const bool is_fine) {
      if (Utilities::MPI::min(is_fine ? 1 : 0, communicator) == 0)
        report_damaged(directory);
    };
    ask_all(!grid.is_first_rank() ||
            (checksum_of(path) == info.checksum_of_file &&
             info.columns == names_of_columns(points.n_user_state())));

    // all ranks read as often: their pieces are the next rows of the file
    const PointFile     file(path);
    const unsigned long n              = info.n_points;
    const auto          for_each_piece = [&](const auto &action) {
      const unsigned long rank = Utilities::MPI::this_mpi_process(communicator);
      for (unsigned long row = 0; row < n;
           row += grid.n_ranks() * rows_per_piece)
        {
          const unsigned long begin = std::min(n, row + rank * rows_per_piece),
                              end = std::min(n, begin + rows_per_piece);
          action(file.read(begin, end - begin, points.n_user_state()));
        }
    };

    std::vector<unsigned int> n_in_cell(grid.n_global_cells(), 0);
    for_each_piece([&](const std::vector<TravelingPoint> &piece) {
      for (const TravelingPoint &p : piece)
        if (index_of(p.cell) < n_in_cell.size())
          ++n_in_cell[index_of(p.cell)];
    });
    Utilities::MPI::sum(n_in_cell, communicator, n_in_cell);
    ask_all(file.succeeded() &&
            std::accumulate(n_in_cell.begin(), n_in_cell.end(), 0ul) == n);
    points.reset(n_in_cell);
    for_each_piece([&](const std::vector<TravelingPoint> &piece) {
      for (const TravelingPoint &p : send_to_owners(grid, piece))
        points.add(grid.local_number(p.cell), p.point);
    });
    points.settle();
  }
} // namespace CaissonMPM
