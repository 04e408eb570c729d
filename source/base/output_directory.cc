// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/base/text_file.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>

namespace CaissonMPM
{
  namespace
  {
    namespace fs = std::filesystem;

    /** The names of all files that a run writes. */
    const std::regex result_names(
      R"((points|grid|body)_\d{4,}\.vtu(\.tmp)?|)"
      R"((points|grid|body)(_by_penetration)?\.pvd(\.tmp)?|)"
      R"((history|history_error|error_bar|observations|points|wall)\.csv(\.tmp)?|)"
      R"(run\.json(\.of_rank_\d+)?(\.tmp)?|)"
      R"(checkpoint(\.info(\.tmp)?|-[ab]\.h5))");

    /** Those of them that are large, or parts, and not of use to change. */
    const std::regex unrecorded_names(
      R"(\w+_\d{4,}\.vtu|checkpoint.*|.*\.tmp|run\.json\.of_rank_\d+)");

    /** The names of what the Python package makes of them without being told
     * where to. This is the only list of them. */
    const std::regex derived_names(
      R"((forces|stress|displacement|void_ratio|pore_pressure|walls)\.png|)"
      R"(suction\.png|(design|jacked|wall_pressure)\.csv|)"
      R"(vessel\.(html|png|csv)|log_sheet\.(pdf|csv)|springs\.(png|csv)|)"
      R"(state(\.csv|\.vtu|_(abaqus|calculix)\.inp)|)"
      R"(report\.(html|pdf)|(run_key|verdict)\.json|phases\.txt)");

    /** Those of them that are a measured log where somebody has filled them in,
     * or has chosen the name: then they stay. */
    const std::regex names_of_logs(R"((vessel|log_sheet)\.csv)");

    /** Where the program and the Python package have a line with checksum, size
     * and name of each file that they wrote; the last one counts. */
    const char *const record_name = ".caisson";

    std::vector<fs::path>
    files_named(const std::regex &names, const fs::path &directory)
    {
      std::vector<fs::path> found;
      std::error_code       error;
      for (const auto &item : fs::directory_iterator(directory, error))
        if (item.is_regular_file(error) &&
            std::regex_match(item.path().filename().string(), names))
          found.push_back(item.path());
      return found;
    }

    /** The subdirectory earlier_N with the first N after all that are there. */
    fs::path
    place_for_earlier_run(const fs::path &directory)
    {
      unsigned long    number = 0;
      const std::regex pattern(R"(earlier_(\d{1,6}))");
      std::error_code  error;
      for (const auto &item : fs::directory_iterator(directory, error))
        {
          std::smatch       found;
          const std::string name = item.path().filename().string();
          if (std::regex_match(name, found, pattern))
            number = std::max(number, std::stoul(found[1]));
        }
      return directory / ("earlier_" + to_text(number + 1));
    }

    std::string
    line_of_record(const fs::path &file)
    {
      const std::string content = read_text(file.string());
      const auto        sum     = crc32(0,
                             reinterpret_cast<const Bytef *>(content.data()),
                             content.size());
      char              stamp[64];
      std::snprintf(stamp, sizeof(stamp), "%08lx %zu ", sum, content.size());
      return stamp + file.filename().string();
    }

    /** Whether a file is not as the program or the Python package wrote it, as
     * one is that they have not written. */
    bool
    is_of_user(const fs::path &file)
    {
      const std::string name = file.filename().string(), end = " " + name;
      if (std::regex_match(name, unrecorded_names))
        return false;
      std::ifstream record(file.parent_path() / record_name);
      std::string   line, written;
      while (std::getline(record, line))
        if (line.size() > end.size() &&
            line.compare(line.size() - end.size(), end.size(), end) == 0)
          written = line;
      return written.empty() || written != line_of_record(file);
    }

    /** Move the files into a new directory, all or none. */
    std::error_code
    move_to(const fs::path &place, const std::vector<fs::path> &files)
    {
      std::error_code       error, ignored;
      std::vector<fs::path> moved;
      if (!fs::create_directory(place, error) && !error)
        return std::make_error_code(std::errc::file_exists);
      for (const fs::path &file : files)
        if (!error)
          {
            fs::rename(file, place / file.filename(), error);
            if (!error)
              moved.push_back(file);
          }
      if (!error)
        return error;
      for (const fs::path &file : moved)
        fs::rename(place / file.filename(), file, ignored);
      fs::remove(place, ignored);
      return error;
    }

    std::string
    this_process()
    {
      char host[256] = "";
      gethostname(host, sizeof(host) - 1);
      return "process " + to_text(getpid()) + " on " + host;
    }

    /** Lock an open file, unless another process has done so. Some file systems
     * have no locks: then go without. */
    bool
    is_taken(const int file)
    {
      return flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    }

    /** Whether the open file is still the one of this path. */
    bool
    is_file_at(const int file, const std::string &path)
    {
      struct stat by_file, by_path;
      return fstat(file, &by_file) == 0 && stat(path.c_str(), &by_path) == 0 &&
             by_file.st_ino == by_path.st_ino &&
             by_file.st_dev == by_path.st_dev;
    }

    /** Return why no directory can be at this path, or nothing. */
    std::string
    obstacle_to(const fs::path &path)
    {
      std::error_code error;
      const auto      status = fs::status(path, error);
      if (status.type() == fs::file_type::not_found && path.has_parent_path() &&
          path != path.parent_path())
        return obstacle_to(path.parent_path());
      if (status.type() == fs::file_type::none)
        return "cannot be created: " + error.message();
      if (status.type() != fs::file_type::directory)
        return "cannot be created: a file is in its place";
      return access(path.c_str(), W_OK | X_OK) == 0 ?
               "" :
               std::string("cannot be written: ") + std::strerror(errno);
    }
  } // namespace

  void
  OutputDirectory::check(const std::string &path, const MPI_Comm communicator)
  {
    const bool is_first =
      dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    if (path.empty())
      throw BadInput("Output/Directory is empty: write the name of a "
                     "directory, for instance results/my_run.");
    refuse(path, is_first ? obstacle_to(fs::absolute(path)) : "", communicator);
  }

  void
  OutputDirectory::refuse(const std::string &path,
                          const std::string &reason,
                          const MPI_Comm     communicator)
  {
    const std::string of_first =
      dealii::Utilities::MPI::broadcast(communicator, reason);
    if (!of_first.empty())
      throw BadInput("the output directory " + path + " " + of_first +
                     ". Choose another one with Output/Directory or "
                     "--output-directory.");
  }

  OutputDirectory::OutputDirectory(const std::string &path,
                                   const MPI_Comm     communicator)
    : path_(path)
  {
    const bool is_first =
      dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    refuse(path, is_first ? prepare() : "", communicator);
  }

  OutputDirectory::~OutputDirectory()
  {
    std::error_code error;
    if (lock_file >= 0)
      fs::remove(path_ + "/.lock", error);
    for (const int file : {lock_file, directory})
      if (file >= 0)
        close(file); // and thereby unlock
  }

  std::string
  OutputDirectory::prepare()
  {
    std::error_code error;
    fs::create_directories(path_, error);
    if (const std::string obstacle = obstacle_to(fs::absolute(path_));
        !obstacle.empty())
      return obstacle;
    return error ? "cannot be created: " + error.message() : lock();
  }

  std::string
  OutputDirectory::lock()
  {
    const std::string path    = path_ + "/.lock";
    const auto        refusal = [&]() {
      const std::string run = read_text(path);
      return "is in use by another run" + (run.empty() ? "" : ", " + run);
    };
    // that of the file alone would be lost with it
    directory = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (is_taken(directory))
      return refusal();
    do
      {
        // a run that ended in between has removed the file that was opened
        if (lock_file >= 0)
          close(lock_file);
        lock_file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (lock_file < 0)
          return std::string("cannot be locked: ") + std::strerror(errno);
        if (is_taken(lock_file))
          {
            close(lock_file);
            lock_file = -1; // that of the other run, which stays
            return refusal();
          }
      }
    while (!is_file_at(lock_file, path));
    const std::string owner = this_process();
    if (ftruncate(lock_file, 0) != 0 ||
        write(lock_file, owner.data(), owner.size()) < 0)
      return std::string("cannot be locked: ") + std::strerror(errno);
    return "";
  }

  bool
  OutputDirectory::is_result(const std::string &name)
  {
    return std::regex_match(name, result_names);
  }

  bool
  OutputDirectory::remove(const std::string &path)
  {
    std::error_code error;
    return is_result(fs::path(path).filename().string()) &&
           fs::remove(path, error);
  }

  OutputDirectory::Room
  OutputDirectory::make_room(const bool     overwrite,
                             const MPI_Comm communicator) const
  {
    Room        room;
    std::string reason;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        auto                  files = files_named(result_names, path_);
        std::vector<fs::path> kept, removed;
        if (overwrite || !files.empty())
          for (const fs::path &file : files_named(derived_names, path_))
            files.push_back(file);
        for (const fs::path &file : files)
          {
            const bool is_log =
              std::regex_match(file.filename().string(), names_of_logs);
            const bool is_theirs = (overwrite || is_log) && is_of_user(file);
            if (!(is_log && is_theirs))
              (overwrite && !is_theirs ? removed : kept).push_back(file);
          }
        std::error_code error;
        if (!kept.empty())
          {
            room.place = place_for_earlier_run(path_).string();
            error      = move_to(room.place, kept);
          }
        if (error)
          reason = "has results of an earlier run, which cannot be moved to " +
                   room.place + ": " + error.message();
        else
          for (const fs::path &file : removed)
            room.n_removed += fs::remove(file, error) ? 1 : 0;
      }
    refuse(path_, reason, communicator);
    return room;
  }

  void
  OutputDirectory::record(const std::vector<std::string> &names) const
  {
    std::string     lines;
    std::error_code error;
    const fs::path  place(path_);
    for (const std::string &name : names)
      if (fs::is_regular_file(place / name, error))
        lines += line_of_record(place / name) + "\n";
    const int file = open((place / record_name).c_str(),
                          O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC,
                          0666);
    if (file < 0)
      return;             // what has no line is kept
    flock(file, LOCK_EX); // the Python package changes it, too
    if (write(file, lines.data(), lines.size()) < 0)
      lines.clear(); // as without the file
    close(file);
  }
} // namespace CaissonMPM
