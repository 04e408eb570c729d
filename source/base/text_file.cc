// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text_file.h>

#include <unistd.h>

#include <cerrno>
#include <cstdio>
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



  int
  try_to_write(const std::string &path, const std::string &text)
  {
    // C streams: errno is reliable with them, and the data can be synchronized
    const std::string temporary = path + ".tmp";
    std::FILE        *file      = std::fopen(temporary.c_str(), "wb");
    if (file == nullptr)
      return errno;
    int error = 0;
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size() ||
        std::fflush(file) != 0 || fsync(fileno(file)) != 0)
      error = errno;
    if (std::fclose(file) != 0 && error == 0)
      error = errno;
    if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0)
      error = errno;
    if (error != 0)
      std::remove(temporary.c_str());
    return error;
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
