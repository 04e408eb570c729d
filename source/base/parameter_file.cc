// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/parameter_file.h>
#include <caisson_mpm/base/parameter_text.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/parameter_acceptor.h>

#include <boost/algorithm/string/trim.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <stdexcept>

namespace CaissonMPM
{
  using namespace ParameterText;

  namespace
  {
    const std::string list_hint =
      "\n  \"caisson_mpm --print-parameters\" lists all entries.";

    const std::string
      no_softening = "Remove it. Strength falls as sand dilates with Law = "
                     "Mohr-Coulomb by density and stress.",
      no_length    = "Remove it: shear bands are about a cell wide, so compare "
                     "meshes.",
      of_gone_law  = "Remove it: it was of NorSand or modified Cam clay, which "
                     "are gone.";

    /** Entries and values of earlier versions, and what to do instead; k is the
     * number of a layer, or a face. */
    const std::map<std::string, std::string> removed_entries = {
      {"Method/Velocity transfer",
       "Set FLIP fraction: 1 is FLIP, 0 is XPIC, which with XPIC order = 1 is "
       "PIC, and auto is the blend."},
      {"Method/Integration",
       "Gauss in full cells is what the program does; for material points, set "
       "Full cell fraction = 2."},
      {"Method/Full cell fraction inside",
       "Remove it: it is 0.4, or that of the surface where this is less or 2."},
      {"Material points/Path below final depth", "Remove it: it is 0.5 m."},
      {"Method/Velocity limiter",
       "Set Limiter factor = none in the place of false."},
      {"Grid/Upper zone",
       "Remove it: the mesh above the body moves with it. Raise Grid/Top by "
       "the travel."},
      {"Rigid body/Friction coefficient of the k",
       "Set the Friction angle, whose tangent it is."},
      {"Rigid body/Lowering delay", "Remove it: it is 0.02 s."},
      {"Water/Pump delay", "Remove it: it is 0.1 s."},
      {"Water/Suction delay", "Remove it: it is 0.02 s."},
      {"Grid/Refined distance along wall",
       "Remove it: it is the thickness of the wall."},
      {"Output/Error bar",
       "The report finds the error bar of FILE.prm in FILE_error_bar.csv; for "
       "another one, call scripts/caisson report --error-bar CSV DIR."},
      {"Design methods/K tan delta inside",
       "Call scripts/caisson report --k-tan-delta-inside LOW,HIGH DIR."},
      {"Design methods/K tan delta outside",
       "Call scripts/caisson report --k-tan-delta-outside LOW,HIGH DIR."},
      {"Design methods/Plug permeability ratio",
       "Call scripts/caisson report --plug-permeability-ratio X DIR."},
      {"Design methods/Load spread",
       "Call scripts/caisson report --load-spread X DIR."},
      {"Soil/Layer k/Law = Mohr-Coulomb with softening",
       "Set Mohr-Coulomb by density and stress, whose strength falls as sand "
       "dilates; of clay, set Mohr-Coulomb with the residual strength."},
      {"Soil/Layer k/Law = Mohr-Coulomb with stiffness by stress",
       "Set Mohr-Coulomb by density and stress, whose stiffness follows the "
       "stress, too, or set an expression in p as Youngs modulus."},
      {"Soil/Layer k/Law = hypoplastic sand",
       "Set hypoplastic sand with intergranular strain."},
      {"Soil/Layer k/Law = NorSand",
       "Set Mohr-Coulomb by density and stress, or hypoplastic sand with "
       "intergranular strain: their strength follows the density, too."},
      {"Soil/Layer k/Law = modified Cam clay",
       "Set Mohr-Coulomb with the undrained strength as Cohesion, or with the "
       "drained Friction angle; a UMAT of Cam clay runs as user material."},
      {"Soil/Layer k/Residual friction angle", no_softening},
      {"Soil/Layer k/Residual dilatancy angle", no_softening},
      {"Soil/Layer k/Residual cohesion", no_softening},
      {"Soil/Layer k/Softening shape factor", no_softening},
      {"Soil/Layer k/Internal length", no_length},
      {"Soil/Layer k/Internal velocity", no_length},
      {"Soil/Layer k/Slope of compression", of_gone_law},
      {"Soil/Layer k/Slope of swelling", of_gone_law},
      {"Soil/Layer k/Slope of the critical state", of_gone_law},
      {"Soil/Layer k/Critical void ratio at 1 kPa", of_gone_law},
      {"Soil/Layer k/Volumetric coupling", of_gone_law},
      {"Soil/Layer k/State dilatancy", of_gone_law},
      {"Soil/Layer k/Plastic hardening", of_gone_law},
      {"Soil/Layer k/Yield stress ratio", of_gone_law}};

    /** What to do instead of an entry, or of "entry = value"; empty: it is none
     * of an earlier version. */
    std::string
    advice_on_removed(const std::string &name)
    {
      static const std::regex k("(Layer )[0-9]+|(coefficient of the ).*");
      const auto              old =
        removed_entries.find(std::regex_replace(name, k, "$1$2k"));
      return old == removed_entries.end() ? "" : old->second;
    }

    /** Whether there have been entries in this section. */
    bool
    is_removed_section(const std::string &path)
    {
      const auto next = removed_entries.lower_bound(path + "/");
      return next != removed_entries.end() &&
             next->first.compare(0, path.size() + 1, path + "/") == 0;
    }

    /** Set an entry. Throws BadInput where the value is not allowed. */
    void
    set_value(const EntryRecord &entry,
              const std::string &value,
              const std::string &place)
    {
      auto       &prm = dealii::ParameterAcceptor::prm;
      std::string reason;
      for (const std::string &subsection : entry.subsections)
        prm.enter_subsection(subsection);
      try
        {
          // deal.II's pattern for an unsigned integer lets -1 through and makes
          // 4294967295 of it
          if (entry.pattern->description() == "[Integer]" && value[0] == '-')
            throw std::out_of_range(value);
          prm.set(entry.name, value);
        }
      catch (const BadInput &error) // of an expression
        {
          reason = error.what();
        }
      catch (const std::exception &)
        {
          const std::string advice =
            advice_on_removed(entry.path + " = " + value);
          reason =
            !advice.empty() ?
              "there is no " + entry.name + " " + quote(value) +
                " any more.\n  " + advice :
              quote(entry.path) + " cannot be " +
                (value.empty() ? "empty" : quote(value)) + "." +
                did_you_mean(nearest_names(value, choices_of(*entry.pattern)));
        }
      for (std::size_t i = 0; i < entry.subsections.size(); ++i)
        prm.leave_subsection();
      if (!reason.empty())
        throw BadInput(place + ": " + reason +
                       "\n  Allowed: " + allowed_values(*entry.pattern) + "." +
                       (entry.documentation.empty() ?
                          "" :
                          "\n  Meaning: " + entry.documentation));
    }

    /** The path without links; as it is where it has none, as that of a pipe.
     */
    std::filesystem::path
    canonical(const std::string &name)
    {
      std::error_code error;
      const auto      result = std::filesystem::weakly_canonical(name, error);
      return error ? std::filesystem::path(name) : result;
    }

    /**
     * Goes through the statements of the file and of the command line, checks
     * each against the declared entries and sets it in the ParameterHandler.
     */
    class Reader
    {
    public:
      explicit Reader(const DeclareSubsection &declare)
        : declare(declare)
      {}

      /** @p place is the line that includes the file, empty if none. */
      void
      read_file(const std::string &name, const std::string &place = "")
      {
        if (files.empty())
          scene = name;
        const std::string text = read_text(name, place);
        check_new(name, place);
        files.push_back({name, place, true, false, {}, {}});
        for (const Line &line : read_lines(text))
          read_line(line);
        if (!open().empty())
          throw BadInput(at(open().back().line) + ": subsection " +
                         quote(open().back().path) +
                         " is opened here and never closed.\n  Add \"end\".");
        if (files.back().place_of_entry.empty() && !files.back().has_included)
          throw BadInput((place.empty() ? "The" : place + ": the") +
                         " parameter file " + quote(name) +
                         " sets no entry.\n  Is it the right file? Start from "
                         "one of the examples in prm/." +
                         list_hint);
        files.pop_back();
      }

      void
      read_overrides(const std::vector<std::string> &overrides)
      {
        // An override replaces what the file says, but not another override.
        // Its paths are those of the scene.
        files.push_back({});
        files.back().name = scene;
        for (const std::string &written : overrides)
          {
            const std::string text       = with_plain_spaces(written);
            const std::string place      = "--set " + quote(text);
            const std::size_t equal_sign = text.find('=');
            if (equal_sign == std::string::npos)
              throw BadInput(place +
                             ": the \"=\" is missing.\n  Write --set "
                             "\"Section/Entry=value\" (mind the quotes).");
            const std::string path = normalize_path(text.substr(0, equal_sign));
            has_subsection(path.substr(0, path.rfind('/')));
            if (find_entry(path) == nullptr)
              throw BadInput(unknown_entry(path, place) + list_hint);
            set(path, boost::trim_copy(text.substr(equal_sign + 1)), place);
          }
        files.pop_back();
      }

      const ParameterOrigins &
      get_origins() const
      {
        return origins;
      }

    private:
      struct OpenSubsection
      {
        std::string  path;
        unsigned int line;
      };

      /** A file that is being read; below it are those that include it. */
      struct OpenFile
      {
        std::string                        name;
        std::string                        included_at;
        bool                               may_include  = true;
        bool                               has_included = false;
        std::vector<OpenSubsection>        open;
        std::map<std::string, std::string> place_of_entry;
      };

      void
      read_line(const Line &line)
      {
        if (line.text.empty())
          return;
        const std::size_t length =
          std::min(line.text.find_first_of(" \t\v\f"), line.text.size());
        const std::string word = line.text.substr(0, length);
        const std::string rest = boost::trim_copy(line.text.substr(length));

        if (word == "include" || word == "INCLUDE")
          return include(rest, line.number);
        files.back().may_include = false;
        if (word == "set" || word == "SET")
          read_set(rest, line);
        else if (word == "subsection" || word == "SUBSECTION")
          enter_subsection(condense(rest), line.number);
        else if (word == "end" || word == "END")
          leave_subsection(rest, line.number);
        else
          throw BadInput(at(line.number) + ": " + quote(line.text) +
                         " cannot be read.\n  A line is \"subsection Name\", "
                         "\"set Name = value\", \"end\", \"include FILE\", or "
                         "a comment after \"#\".");
      }

      void
      include(const std::string &name, const unsigned int line)
      {
        const std::string place = at(line);
        if (name.empty())
          throw BadInput(place + ": \"include\" needs a file name.\n  Write "
                                 "\"include other.prm\".");
        if (!files.back().may_include)
          throw BadInput(place +
                         ": \"include\" must come before the first \"set\" and "
                         "\"subsection\".\n  A file then changes what it "
                         "includes, and not the other way round.");
        const auto directory = std::filesystem::path(files.back().name);
        read_file((directory.parent_path() / name).lexically_normal().string(),
                  place);
        files.back().has_included = true;
      }

      void
      read_set(const std::string &assignment, const Line &at_line)
      {
        const unsigned int line       = at_line.number;
        const std::size_t  equal_sign = assignment.find('=');
        const std::string  name = condense(assignment.substr(0, equal_sign));
        if (equal_sign == std::string::npos || name.empty())
          throw BadInput(at(line) + ": " + quote("set " + assignment) +
                         " cannot be read.\n  Write \"set Name = value\".");
        const std::string        path  = full_path(name);
        const EntryRecord *const entry = find_entry(path);
        if (entry == nullptr)
          throw BadInput(unknown_entry(path, at(line)) +
                         missing_end_hint(name) + list_hint);
        if (entry->name != name)
          throw BadInput(at(line) + ": " + quote(name) +
                         " is a path.\n  In a file, write \"set " +
                         entry->name + " = ...\" between " +
                         quote("subsection " + name.substr(0, name.find('/'))) +
                         " and \"end\".");
        set(path,
            boost::trim_copy(assignment.substr(equal_sign + 1)),
            at(line),
            at_line.comment.find("ASSUMED") != std::string::npos);
      }

      void
      enter_subsection(const std::string &name, const unsigned int line)
      {
        if (name.empty())
          throw BadInput(at(line) + ": \"subsection\" needs a name.\n  Write "
                                    "\"subsection Name\".");
        if (name.find('/') != std::string::npos)
          throw BadInput(at(line) + ": " + quote(name) +
                         " is a path.\n  Open one subsection per line.");
        const std::string path = full_path(name);
        if (!has_subsection(path))
          throw BadInput(at(line) + ": there is no subsection " + quote(path) +
                         "." +
                         did_you_mean(nearest_names(path, section_paths())) +
                         missing_end_hint(name) + list_hint);
        open().push_back({path, line});
      }

      void
      leave_subsection(const std::string &rest, const unsigned int line)
      {
        if (!rest.empty())
          throw BadInput(at(line) + ": " + quote("end " + rest) +
                         " cannot be read.\n  \"end\" must be alone on its "
                         "line; a comment begins with \"#\".");
        if (open().empty())
          throw BadInput(
            at(line) + ": this \"end\" closes no subsection.\n  Remove it, or "
                       "add the \"subsection\" that it belongs to.");
        open().pop_back();
      }

      /** Check and set one entry; @p place is "jack.prm:12" or "--set ...". */
      void
      set(const std::string &path,
          const std::string &value,
          const std::string &place,
          const bool         is_assumed = false)
      {
        const EntryRecord &entry = *find_entry(path);
        const auto [earlier, is_new] =
          files.back().place_of_entry.insert({entry.path, place});
        if (!is_new)
          throw BadInput(place + ": " + quote(entry.path) +
                         " is set a second time, first at " + earlier->second +
                         ".\n  Remove one of the two.");
        const std::string present =
          present_value(entry, in_one_line(value, entry.path, place), place);
        set_value(entry, present, place);
        const bool is_included = files.size() > 1;
        origins.record(
          entry.path,
          place,
          is_included || present == entry.default_value,
          is_assumed,
          std::filesystem::path(files.back().name).parent_path().string());
      }

      /** The value, or the word where an old special number stands for it. */
      std::string
      present_value(const EntryRecord &entry,
                    const std::string &value,
                    const std::string &place)
      {
        const auto *either =
          dynamic_cast<const WordOrNumber *>(entry.pattern.get());
        if (either == nullptr || !either->is_old_value(value))
          return value;
        origins.add_warning(place + ": " + quote(entry.path) + " = " + value +
                            " is now written " + quote(either->word) +
                            "; the number will no longer be accepted.");
        return either->word;
      }

      /** What to say where there is no such entry. */
      std::string
      unknown_entry(const std::string &path, const std::string &place) const
      {
        if (has_section(path))
          return place + ": " + quote(path) + " is a subsection, not an entry.";
        if (const std::string advice = advice_on_removed(path); !advice.empty())
          return place + ": there is no entry " + quote(path) +
                 " any more.\n  " + advice;
        std::vector<std::string> names = names_of_symbol(path, entry_paths());
        if (names.empty())
          names = nearest_names(path, entry_paths());
        return place + ": there is no entry " + quote(path) + "." +
               did_you_mean(names);
      }

      std::string
      full_path(const std::string &name) const
      {
        return open().empty() ? name : open().back().path + "/" + name;
      }

      /** A hint, should this name be known outside the open subsections. */
      std::string
      missing_end_hint(const std::string &name) const
      {
        for (std::size_t n_open = open().size(); n_open > 0; --n_open)
          {
            const std::string outside =
              n_open > 1 ? open()[n_open - 2].path + "/" + name : name;
            if (find_entry(outside) != nullptr || has_section(outside))
              return "\n  Or is an \"end\" missing? Subsection " +
                     quote(open()[n_open - 1].path) + " is open since line " +
                     to_text(open()[n_open - 1].line) + ".";
          }
        return "";
      }

      /** The line's place, and that of the "include" that leads to it. */
      std::string
      at(const unsigned int line) const
      {
        const OpenFile &file = files.back();
        return file.name + ":" + to_text(line) +
               (file.included_at.empty() ? "" :
                                           ", included by " + file.included_at);
      }

      /** Refuse a file that has been read before. */
      void
      check_new(const std::string &name, const std::string &place)
      {
        const auto key             = canonical(name);
        const auto [entry, is_new] = place_of_include.insert({key, place});
        if (is_new)
          return;
        for (const OpenFile &file : files)
          if (canonical(file.name) == key)
            throw BadInput(place + ": the file " + quote(name) +
                           " includes itself.\n  Remove one of the \"include\" "
                           "lines on the way.");
        throw BadInput(
          place + ": the file " + quote(name) +
          " is included a second time, first at " + entry->second +
          ".\n  It would undo the settings made since then. Remove "
          "one of the two.");
      }

      /** The subsections that are open in the present file. */
      std::vector<OpenSubsection> &
      open()
      {
        return files.back().open;
      }

      const std::vector<OpenSubsection> &
      open() const
      {
        return files.back().open;
      }

      /** Whether there is such a subsection, or one could be declared. */
      bool
      has_subsection(const std::string &path)
      {
        return has_section(path) || is_removed_section(path) ||
               (declare && declare(path));
      }

      const DeclareSubsection           &declare;
      ParameterOrigins                   origins;
      std::vector<OpenFile>              files;
      std::string                        scene; // the file that includes others
      std::map<std::string, std::string> place_of_include;
    };
  } // namespace

  ParameterOrigins
  read_parameters(const std::string              &file_name,
                  const std::vector<std::string> &overrides,
                  const DeclareSubsection        &declare)
  {
    Reader reader(declare);
    if (!file_name.empty())
      reader.read_file(file_name);
    reader.read_overrides(overrides);
    return reader.get_origins();
  }
} // namespace CaissonMPM
