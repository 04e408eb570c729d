// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Reading a parameter file (and --set) into the declared entries, with messages
// from which the user can repair the input.
#ifndef caisson_mpm_base_parameter_file_h
#define caisson_mpm_base_parameter_file_h

#include <caisson_mpm/base/parameter_origins.h>

#include <functional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** Declares the entries of a subsection of which a scene may have any number,
   * as "Soil/Layer 7"; returns whether there can be one with this path. */
  using DeclareSubsection = std::function<bool(const std::string &path)>;

  /**
   * Read the file and then the overrides ("Section/Sub/Entry=value") into
   * the entries that the sections have declared. An empty file name reads the
   * overrides only. An override replaces the file's value. Where a subsection
   * is not declared, @p declare is asked to do so.
   *
   * The syntax is deal.II's (subsection, set, end, include; "#" begins a
   * comment, "\" at the end of a line continues it), with three differences
   * that keep mistakes from passing silently: "include other.prm" stands
   * before everything else in a file, and its path is relative to that file;
   * a file may set an entry only once, and replaces what the files that it
   * includes have set; a comment always ends with its line.
   *
   * Throws BadInput at the first thing that is wrong: a file that cannot be
   * read, that sets nothing or that is included twice, a line that cannot be
   * read, an unknown subsection or entry (with the nearest known ones), a
   * value that is not allowed (with those that are, and the entry's
   * documentation), an entry set twice, an unbalanced subsection. A place in
   * an included file is followed by the line that includes it. Not collective:
   * every rank reads the file and comes to the same result.
   */
  ParameterOrigins
  read_parameters(const std::string              &file_name,
                  const std::vector<std::string> &overrides = {},
                  const DeclareSubsection        &declare   = {});
} // namespace CaissonMPM

#endif
