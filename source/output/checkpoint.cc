// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/output/checkpoint.h>
#include <caisson_mpm/output/text_file.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace CaissonMPM
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::string format_name = "caisson_mpm-checkpoint-5";

    // a particle in the file: its id, location, reference location, properties
    constexpr unsigned long bytes_per_point =
      sizeof(types::particle_index) +
      sizeof(double) * (2 + 2 + MaterialPoints::n_properties);

    std::string
    info_file(const std::string &directory)
    {
      return directory + "/checkpoint.info";
    }

    /** What checkpoint.info says. */
    struct Info
    {
      std::string     files; // checkpoint-a or checkpoint-b
      unsigned long   n_points = 0;
      unsigned long   n_bytes  = 0; // of all files
      CheckpointState state;
      std::string     fingerprint;
    };

    std::string
    to_text(const Info &info)
    {
      const auto exact = [](const double x) {
        return CaissonMPM::to_text(x, 17);
      };
      const CheckpointState &s = info.state;
      std::ostringstream     out;
      out << "format " << format_name << "\nfiles " << info.files << "\npoints "
          << info.n_points << "\nbytes " << info.n_bytes << "\ntime "
          << exact(s.time) << "\ntravel " << exact(s.travel) << "\nstep "
          << s.step << "\nlimiter_count " << s.limiter_count << "\nheld_back "
          << s.held_back << "\nexternal_work " << exact(s.external_work)
          << "\nmore";
      for (const double value : s.more)
        out << ' ' << exact(value);
      out << "\nfingerprint\n" << info.fingerprint;
      return out.str();
    }

    Info
    parse_info(const std::string &text)
    {
      std::map<std::string, std::vector<std::string>> entries;
      std::istringstream                              in(text);
      for (std::string line; std::getline(in, line) && line != "fingerprint";)
        {
          std::istringstream words(line);
          std::string        name;
          words >> name;
          for (std::string word; words >> word;)
            entries[name].push_back(word);
        }
      const auto entry = [&](const std::string &name) {
        return entries[name].empty() ? std::string() : entries[name][0];
      };
      const auto real = [&](const std::string &name) {
        return std::strtod(entry(name).c_str(), nullptr);
      };
      const auto count = [&](const std::string &name) {
        return std::strtoul(entry(name).c_str(), nullptr, 10);
      };
      Info info;
      if (entry("format") != format_name)
        return info;
      info.files    = entry("files");
      info.n_points = count("points");
      info.n_bytes  = count("bytes");
      info.state    = {real("time"),
                       real("travel"),
                       count("step"),
                       count("limiter_count"),
                       count("held_back"),
                       real("external_work"),
                       {}};
      for (const std::string &word : entries["more"])
        info.state.more.push_back(std::strtod(word.c_str(), nullptr));
      std::ostringstream rest;
      rest << in.rdbuf();
      info.fingerprint = rest.str();
      return info;
    }



    // ---------------------------------------------------------- files

    /** The files that deal.II wrote under this name. */
    std::vector<fs::path>
    files_of(const std::string &directory, const std::string &name)
    {
      std::vector<fs::path> result;
      std::error_code       error;
      for (const auto &entry : fs::directory_iterator(directory, error))
        if (entry.path().filename().string().compare(0, name.size(), name) == 0)
          result.push_back(entry.path());
      return result;
    }

    unsigned long
    total_size(const std::vector<fs::path> &files)
    {
      unsigned long   sum = 0;
      std::error_code error;
      for (const fs::path &file : files)
        {
          const auto size = fs::file_size(file, error);
          sum += error ? 0 : size;
        }
      return sum;
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

    /**
     * Remove what is left of an older checkpoint of this name, and see that
     * there is room for the new one: p4est aborts the program where a disk is
     * full. Returns 0 or an errno.
     */
    int
    make_room(const std::string  &directory,
              const std::string  &name,
              const unsigned long n_bytes)
    {
      std::error_code error;
      for (const fs::path &file : files_of(directory, name))
        fs::remove(file, error);
      const auto space = fs::space(directory, error);
      if (error)
        return error.value();
      return space.available < n_bytes ? ENOSPC : 0;
    }

    /** See that all was written: deal.II and MPI may pass over a full disk. */
    int
    make_durable(const std::string  &directory,
                 const std::string  &name,
                 const unsigned long n_points)
    {
      const auto files = files_of(directory, name);
      for (const fs::path &file : files)
        if (const int error = synchronize(file))
          return error;
      return total_size(files) < n_points * bytes_per_point ? ENOSPC : 0;
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

    std::string
    next_line(std::istream &in)
    {
      std::string line;
      return std::getline(in, line) ? line : "(no further entry)";
    }

    void
    check_fingerprint(const std::string &directory,
                      const std::string &written,
                      const std::string &current)
    {
      if (written == current)
        return;
      std::istringstream then(written), now(current);
      std::string        a, b;
      while (a == b && (then || now))
        {
          a = next_line(then);
          b = next_line(now);
        }
      throw BadInput("the checkpoint in " + directory +
                     " was written with\n  " + a +
                     "\nand cannot be used with\n  " + b +
                     "\nSet it back, or run without --restart.");
    }

    Info
    read_info(const std::string &directory)
    {
      const std::string text = read_text(info_file(directory));
      if (text.empty())
        throw BadInput("there is no checkpoint in " + directory +
                       " to go on from (no file checkpoint.info). Give the "
                       "output directory of the run that was stopped, or run "
                       "without --restart.");
      const Info info = parse_info(text);
      if (info.files.empty() ||
          total_size(files_of(directory, info.files)) != info.n_bytes)
        throw BadInput("the checkpoint in " + directory +
                       " is damaged, or was written by another version. Run "
                       "without --restart.");
      return info;
    }
  } // namespace



  void
  write_checkpoint(const std::string     &directory,
                   BackgroundGrid        &grid,
                   MaterialPoints        &points,
                   const CheckpointState &state,
                   const std::string     &fingerprint)
  {
    const MPI_Comm communicator = grid.communicator();
    Info           info;
    const bool     a_is_valid =
      parse_info(read_text(info_file(directory))).files == "checkpoint-a";
    info.files = Utilities::MPI::broadcast(communicator, a_is_valid ? 1 : 0) ?
                   "checkpoint-b" :
                   "checkpoint-a";
    info.n_points =
      Utilities::MPI::sum<unsigned long>(points.n_points(), communicator);
    info.state       = state;
    info.fingerprint = fingerprint;
    on_first_rank(communicator, directory, [&]() {
      const unsigned long expected =
        info.n_points * bytes_per_point +
        200 * grid.triangulation.n_global_active_cells();
      return make_room(directory, info.files, expected + expected / 10);
    });

    grid.write_vertices();
    points.store();
    points.handler.prepare_for_serialization();
    grid.triangulation.save(directory + "/" + info.files);
    points.clear_handler();

    on_first_rank(communicator, directory, [&]() {
      if (const int error = make_durable(directory, info.files, info.n_points))
        return error;
      info.n_bytes = total_size(files_of(directory, info.files));
      return try_to_write(info_file(directory), to_text(info));
    });
  }



  CheckpointState
  read_checkpoint(const std::string &directory,
                  BackgroundGrid    &grid,
                  MaterialPoints    &points,
                  const std::string &fingerprint)
  {
    const Info info = read_info(directory);
    check_fingerprint(directory, info.fingerprint, fingerprint);

    points.clear_handler();
    // The mesh is never refined, so that cells and vertices stay in place; but
    // ranks may be more or fewer than before.
    grid.triangulation.load(directory + "/" + info.files);
    grid.set_up_part();
    grid.prepare_motion(info.state.travel);
    grid.advance();
    grid.write_vertices();
    points.handler.deserialize();
    points.load();

    const unsigned long n_points =
      Utilities::MPI::sum<unsigned long>(points.n_points(),
                                         grid.communicator());
    if (n_points != info.n_points)
      throw BadInput("the checkpoint in " + directory + " has " +
                     std::to_string(n_points) + " material points instead of " +
                     std::to_string(info.n_points) +
                     ": it is damaged. Run without --restart.");
    return info.state;
  }
} // namespace CaissonMPM
