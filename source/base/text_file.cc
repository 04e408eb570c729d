// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text_file.h>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

namespace CaissonMPM
{
  void
  report_unwritable(const std::string &path,
                    const int          error,
                    const std::string &consequence)
  {
    throw RunFailure("cannot write " + path + ": " + std::strerror(error) +
                     (consequence.empty() ? "" : "; " + consequence));
  }

  // C streams: errno is reliable with them, and the data can be synchronized
  AtomicFile::AtomicFile(const std::string &path)
    : path(path)
    , temporary(path + ".tmp")
    , file(std::fopen(temporary.c_str(), "wb"))
  {
    if (file == nullptr)
      error = errno;
  }

  AtomicFile::~AtomicFile()
  {
    if (file == nullptr)
      return;
    std::fclose(file);
    std::remove(temporary.c_str());
  }

  void
  AtomicFile::append(const std::string &text)
  {
    if (error == 0 &&
        std::fwrite(text.data(), 1, text.size(), file) != text.size())
      error = errno;
  }

  int
  AtomicFile::finish()
  {
    if (file == nullptr)
      return error;
    if (error == 0 && (std::fflush(file) != 0 || fsync(fileno(file)) != 0))
      error = errno;
    if (std::fclose(file) != 0 && error == 0)
      error = errno;
    file = nullptr;
    if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0)
      error = errno;
    if (error != 0)
      std::remove(temporary.c_str());
    return error;
  }

  int
  try_to_write(const std::string &path, const std::string &text)
  {
    AtomicFile file(path);
    file.append(text);
    return file.finish();
  }

  void
  write_atomically(const std::string &path, const std::string &text)
  {
    if (const int error = try_to_write(path, text))
      report_unwritable(path, error);
  }

  std::string
  read_text(const std::string &path)
  {
    std::ifstream      file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return file.is_open() ? text.str() : std::string();
  }
} // namespace CaissonMPM
