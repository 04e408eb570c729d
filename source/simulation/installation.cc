// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/simulation/installation.h>

#include <filesystem>
#include <system_error>

namespace CaissonMPM
{
  namespace
  {
    std::string
    line_of(const ChangedEntry &entry)
    {
      const auto word = [](const std::string &value) {
        return value.empty() ? "empty" : value;
      };
      return "\n  " + entry.path + " = " + word(entry.now) + ", there " +
             word(entry.before);
    }
  } // namespace

  Installation::Installation()
    : Section("/Installation", Influence::motion)
  {
    add_parameter(
      "Directory",
      directory_,
      "",
      "The run begins with the ground, the body and the water in the last "
      "checkpoint of another run, which has this output directory. Its motion "
      "may be another one; time and sums begin at 0. With an empty one, the "
      "run begins with soil in its initial stress.");
    add_parameter(
      "Phases",
      phases,
      "",
      "What follows this run, separated by commas, as in rest 30 d, retrieval "
      "to 0.5 m: caisson run computes each of them from where the one before "
      "ended. The program alone does not. They are rest TIME, pull drained, "
      "pull undrained, push and retrieval; all but a rest may end with to "
      "DEPTH.")
      .influence = Influence::none;
  }

  void
  Installation::open(const std::string &output_directory,
                     const std::string &physics)
  {
    const std::string entry = "Installation/Directory = " + directory_;
    std::error_code   is_missing;
    if (std::filesystem::equivalent(directory_, output_directory, is_missing))
      throw BadInput(entry +
                     " is the output directory of this run, too, whose results "
                     "would replace those of the installation. Choose another "
                     "one with Output/Directory or --output-directory.");
    if (!Checkpoint::is_in(directory_))
      throw BadInput(entry +
                     " has no checkpoint (no file checkpoint.info). Run the "
                     "installation first: it writes one at its end.");
    checkpoint_.emplace(directory_);
    changes = changes_between(checkpoint_->info.fingerprint, physics);
    refuse_changes();
  }

  void
  Installation::refuse_changes() const
  {
    std::string lines;
    for (const ChangedEntry &entry : changes)
      {
        const EntryRecord *const about = find_entry(entry.path);
        if (about == nullptr || about->influence != Influence::motion)
          lines += line_of(entry);
        if (entry.path == "Water/Level" &&
            (entry.now == "undrained" ||
             (entry.before == "undrained" && entry.now != "drained")))
          throw BadInput(
            "Water/Level was " + entry.before + " in the installation and is " +
            entry.now +
            ": the pressure of undrained soil follows from all of its volume "
            "change, and is no pressure at the nodes. Set Level = coupled and "
            "a low permeability of the layers in both runs.");
        if (entry.path == "Water/Bulk modulus" && water_level() == "undrained")
          throw BadInput("Water/Bulk modulus was " + entry.before +
                         " Pa in the undrained installation and is " +
                         entry.now +
                         ": all excess pressures would change with it. Set it "
                         "back.");
      }
    if (lines.empty())
      return;
    throw BadInput(
      "Installation/Directory = " + directory_ +
      " has the checkpoint of a run with other entries, which decide the state "
      "of the ground:" +
      lines +
      "\nSet them back, or run the installation again with them. Only the "
      "motion of the body, its weight and friction, water, permeabilities, loads, the "
      "time step, the end and the output may differ.");
  }

  BodyMotion::InitialMotion
  Installation::end_of_motion() const
  {
    const auto number = [this](const std::string &name) {
      return number_named(name, checkpoint_->info.state).value_or(0.);
    };
    return {number("motion_travel"),
            number("motion_velocity"),
            -number("force_on_body")};
  }

  std::string
  Installation::water_level() const
  {
    return value_of("Water/Level", checkpoint_->info.fingerprint);
  }

  std::vector<std::string>
  Installation::messages(const double penetration) const
  {
    std::vector<std::string> texts;
    if (is_given())
      texts.push_back("continuing at a penetration of " +
                      to_text(penetration, 6) + " m" + changes_in_words());
    if (!phases.empty())
      texts.emplace_back("Installation/Phases: caisson run computes them after "
                         "this run, the program alone does not");
    return texts;
  }

  std::string
  Installation::changes_in_words() const
  {
    std::string lines;
    for (const ChangedEntry &entry : changes)
      if (entry.path != "Title" && entry.path != "Installation/Directory")
        lines += line_of(entry);
    return lines.empty() ? " with the entries of the installation" :
                           " with other entries than the installation:" + lines;
  }
} // namespace CaissonMPM
