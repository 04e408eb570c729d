// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/output_directory.h>

#include <filesystem>
#include <fstream>

namespace CaissonMPM
{
  void
  prepare_output_directory(const std::string &directory)
  {
    const std::string advice =
      " Choose another one with Output/Directory or --output-directory.";
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (!std::filesystem::is_directory(directory))
      throw BadInput("the output directory " + directory + " cannot be made: " +
                     (error ? error.message() : "a file is in its place") +
                     "." + advice);
    const std::string probe = directory + "/.writable";
    std::ofstream     file(probe);
    file << "writable" << std::endl;
    if (!file)
      throw BadInput("the output directory " + directory +
                     " cannot be written." + advice);
    file.close();
    std::filesystem::remove(probe, error);
  }
} // namespace CaissonMPM
