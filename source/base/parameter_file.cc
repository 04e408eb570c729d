// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/parameter_file.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    const std::string list_hint =
      "\n  \"caisson_mpm --print-parameters\" lists all entries.";

    bool
    is_space(const char c)
    {
      return std::isspace(static_cast<unsigned char>(c)) != 0;
    }

    std::string
    trim(const std::string &text)
    {
      std::size_t begin = 0, end = text.size();
      while (begin < end && is_space(text[begin]))
        ++begin;
      while (end > begin && is_space(text[end - 1]))
        --end;
      return text.substr(begin, end - begin);
    }

    /** Trim, and make one space of each run of white space. */
    std::string
    condense(const std::string &text)
    {
      std::string result;
      for (const char c : trim(text))
        if (!is_space(c))
          result += c;
        else if (result.back() != ' ')
          result += ' ';
      return result;
    }

    /** A piece of the user's text, safe to print and in quotation marks. */
    std::string
    quote(const std::string &text)
    {
      std::string result;
      for (const char c : text.substr(0, 60))
        result += std::iscntrl(static_cast<unsigned char>(c)) ? '?' : c;
      return "\"" + result + (text.size() > 60 ? "..." : "") + "\"";
    }

    /** " Soil /  Friction angle" is understood as "Soil/Friction angle". */
    std::string
    normalize_path(const std::string &path)
    {
      std::string        result;
      std::istringstream stream(path);
      for (std::string part; std::getline(stream, part, '/');)
        result += (result.empty() ? "" : "/") + condense(part);
      return result;
    }

    /** The parameter files in the directory of the one that is missing. */
    std::vector<std::string>
    neighbouring_files(const std::filesystem::path &missing_file)
    {
      namespace fs                     = std::filesystem;
      const fs::path           parent  = missing_file.parent_path();
      const fs::path           to_list = parent.empty() ? "." : parent;
      std::vector<std::string> result;
      std::error_code          error;
      for (const auto &item : fs::directory_iterator(to_list, error))
        if (item.path().extension() == ".prm")
          result.push_back((parent / item.path().filename()).string());
      return result;
    }

    std::string
    read_text(const std::string &file_name)
    {
      const std::string file = "The parameter file " + quote(file_name);
      std::error_code   error;
      if (std::filesystem::is_directory(file_name, error))
        throw BadInput(file + " is a directory.\n  Give a file in it.");
      if (!std::filesystem::exists(file_name, error))
        throw BadInput(
          file + " does not exist." +
          did_you_mean(
            nearest_names(file_name, neighbouring_files(file_name))) +
          "\n  A path is relative to the directory in which caisson_mpm is "
          "started.");

      std::ifstream stream(file_name, std::ios::binary);
      if (!stream)
        throw BadInput(file + " cannot be opened.\n  Is reading permitted?");
      std::ostringstream content;
      content << stream.rdbuf();
      std::string text = content.str();
      if (text.find('\0') != std::string::npos)
        throw BadInput(file + " is not a text file.");
      if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) // byte order mark
        text.erase(0, 3);
      return text;
    }

    /** A line of the file, continuation lines joined to it. */
    struct Line
    {
      unsigned int number;
      std::string  text;
    };

    std::vector<Line>
    read_lines(const std::string &content)
    {
      std::vector<Line>  lines;
      std::istringstream stream(content);
      bool               continues = false;
      unsigned int       number    = 0;
      for (std::string raw; std::getline(stream, raw);)
        {
          ++number;
          std::string text = trim(raw.substr(0, raw.find('#')));
          if (!continues)
            lines.push_back({number, ""});
          continues = !text.empty() && text.back() == '\\';
          if (continues)
            text.pop_back();
          lines.back().text += text;
        }
      return lines;
    }

    /**
     * Goes through the statements of the file and of the command line, checks
     * each against the declared entries and sets it in the ParameterHandler.
     */
    class Reader
    {
    public:
      explicit Reader(dealii::ParameterHandler &prm)
        : prm(prm)
        , entries(prm)
      {}

      void
      read_file(const std::string &name);

      void
      read_overrides(const std::vector<std::string> &overrides);

      ParameterOrigins origins;

    private:
      struct OpenSubsection
      {
        std::string  path;
        unsigned int line;
      };

      void
      read_line(const Line &line);
      void
      read_set(const std::string &assignment, const unsigned int line);
      void
      enter_subsection(const std::string &name, const unsigned int line);
      void
      leave_subsection(const std::string &rest, const unsigned int line);

      /** Check and set one entry; @p place is "jack.prm:12" or "--set ...". */
      void
      set(const std::string &path,
          const std::string &value,
          const std::string &place);

      /** The entry itself if the path is another name of it. */
      const DeclaredEntry &
      resolve_alias(const DeclaredEntry &entry, const std::string &place);

      /** The value, or the word where an old special number stands for it. */
      std::string
      present_value(const DeclaredEntry &entry,
                    const std::string   &value,
                    const std::string   &place);

      void
      set_value(const DeclaredEntry &entry,
                const std::string   &value,
                const std::string   &place);

      /** What to say where there is no such entry. */
      std::string
      unknown_entry(const std::string &path, const std::string &place) const;

      std::string
      full_path(const std::string &name) const;

      /** A hint, should this name be known outside the open subsections. */
      std::string
      missing_end_hint(const std::string &name) const;

      std::string
      at(const unsigned int line) const;

      dealii::ParameterHandler          &prm;
      const DeclaredEntries              entries;
      std::string                        file_name;
      std::vector<OpenSubsection>        open;
      std::map<std::string, std::string> place_of_entry;
    };



    std::string
    Reader::at(const unsigned int line) const
    {
      return file_name + ":" + std::to_string(line);
    }



    std::string
    Reader::full_path(const std::string &name) const
    {
      return open.empty() ? name : open.back().path + "/" + name;
    }



    void
    Reader::read_file(const std::string &name)
    {
      file_name = name;
      for (const Line &line : read_lines(read_text(name)))
        read_line(line);
      if (!open.empty())
        throw BadInput(at(open.back().line) + ": subsection " +
                       quote(open.back().path) +
                       " is opened here and never closed.\n  Add \"end\".");
      if (place_of_entry.empty())
        throw BadInput("The parameter file " + quote(name) +
                       " sets no entry.\n  Is it the right file? Start from "
                       "one of the examples in prm/." +
                       list_hint);
    }



    void
    Reader::read_line(const Line &line)
    {
      if (line.text.empty())
        return;
      std::size_t length = 0;
      while (length < line.text.size() && !is_space(line.text[length]))
        ++length;
      const std::string word = line.text.substr(0, length);
      const std::string rest = trim(line.text.substr(length));

      if (word == "set" || word == "SET")
        read_set(rest, line.number);
      else if (word == "subsection" || word == "SUBSECTION")
        enter_subsection(condense(rest), line.number);
      else if (word == "end" || word == "END")
        leave_subsection(rest, line.number);
      else if (word == "include" || word == "INCLUDE")
        throw BadInput(at(line.number) +
                       ": \"include\" is not supported.\n  Copy the entries "
                       "into this file, or give them with --set.");
      else
        throw BadInput(at(line.number) + ": " + quote(line.text) +
                       " cannot be read.\n  A line is \"subsection Name\", "
                       "\"set Name = value\", \"end\", or a comment after "
                       "\"#\".");
    }



    void
    Reader::read_set(const std::string &assignment, const unsigned int line)
    {
      const std::size_t equal_sign = assignment.find('=');
      const std::string name       = condense(assignment.substr(0, equal_sign));
      if (equal_sign == std::string::npos || name.empty())
        throw BadInput(at(line) + ": " + quote("set " + assignment) +
                       " cannot be read.\n  Write \"set Name = value\".");
      const std::string          path  = full_path(name);
      const DeclaredEntry *const entry = entries.find(path);
      if (entry == nullptr)
        throw BadInput(unknown_entry(path, at(line)) + missing_end_hint(name) +
                       list_hint);
      if (entry->name != name)
        throw BadInput(at(line) + ": " + quote(name) +
                       " is a path.\n  In a file, write \"set " + entry->name +
                       " = ...\" between " +
                       quote("subsection " + name.substr(0, name.find('/'))) +
                       " and \"end\".");
      set(path, trim(assignment.substr(equal_sign + 1)), at(line));
    }



    void
    Reader::enter_subsection(const std::string &name, const unsigned int line)
    {
      if (name.empty())
        throw BadInput(at(line) + ": \"subsection\" lacks a name.\n  Write "
                                  "\"subsection Name\".");
      if (name.find('/') != std::string::npos)
        throw BadInput(at(line) + ": " + quote(name) +
                       " is a path.\n  Open one subsection per line.");
      const std::string path = full_path(name);
      if (!entries.has_subsection(path))
        throw BadInput(
          at(line) + ": there is no subsection " + quote(path) + "." +
          did_you_mean(nearest_names(path, entries.subsection_paths())) +
          missing_end_hint(name) + list_hint);
      open.push_back({path, line});
    }



    void
    Reader::leave_subsection(const std::string &rest, const unsigned int line)
    {
      if (!rest.empty())
        throw BadInput(at(line) + ": " + quote("end " + rest) +
                       " cannot be read.\n  \"end\" stands alone on its line; "
                       "a comment begins with \"#\".");
      if (open.empty())
        throw BadInput(at(line) +
                       ": this \"end\" closes no subsection.\n  Remove it, or "
                       "add the \"subsection\" that it belongs to.");
      open.pop_back();
    }



    std::string
    Reader::unknown_entry(const std::string &path,
                          const std::string &place) const
    {
      if (entries.has_subsection(path))
        return place + ": " + quote(path) + " is a subsection, not an entry.";
      return place + ": there is no entry " + quote(path) + "." +
             did_you_mean(nearest_names(path, entries.entry_paths()));
    }



    std::string
    Reader::missing_end_hint(const std::string &name) const
    {
      for (std::size_t n_open = open.size(); n_open > 0; --n_open)
        {
          const std::string outside =
            n_open > 1 ? open[n_open - 2].path + "/" + name : name;
          if (entries.find(outside) != nullptr ||
              entries.has_subsection(outside))
            return "\n  Or is an \"end\" missing? Subsection " +
                   quote(open[n_open - 1].path) + " is open since line " +
                   std::to_string(open[n_open - 1].line) + ".";
        }
      return "";
    }



    void
    Reader::read_overrides(const std::vector<std::string> &overrides)
    {
      // An override replaces what the file says, but not another override.
      place_of_entry.clear();
      for (const std::string &text : overrides)
        {
          const std::string place      = "--set " + quote(text);
          const std::size_t equal_sign = text.find('=');
          if (equal_sign == std::string::npos)
            throw BadInput(place +
                           ": the \"=\" is missing.\n  Write --set "
                           "\"Section/Entry=value\" (mind the quotes).");
          const std::string path = normalize_path(text.substr(0, equal_sign));
          if (entries.find(path) == nullptr)
            throw BadInput(unknown_entry(path, place) + list_hint);
          set(path, trim(text.substr(equal_sign + 1)), place);
        }
    }



    void
    Reader::set(const std::string &path,
                const std::string &value,
                const std::string &place)
    {
      const DeclaredEntry &entry   = resolve_alias(*entries.find(path), place);
      const auto [earlier, is_new] = place_of_entry.insert({entry.path, place});
      if (!is_new)
        throw BadInput(place + ": " + quote(entry.path) +
                       " is set a second time, first at " + earlier->second +
                       ".\n  Remove one of the two.");
      set_value(entry, present_value(entry, value, place), place);
      origins.record(entry.path, place);
    }



    const DeclaredEntry &
    Reader::resolve_alias(const DeclaredEntry &entry, const std::string &place)
    {
      if (entry.alias_of.empty())
        return entry;
      if (entry.is_deprecated)
        origins.add_warning(place + ": " + quote(entry.path) +
                            " is now called " + quote(entry.alias_of) +
                            "; the old name will go.");
      return *entries.find(entry.alias_of);
    }



    std::string
    Reader::present_value(const DeclaredEntry &entry,
                          const std::string   &value,
                          const std::string   &place)
    {
      const auto description = read_word_description(entry.pattern);
      char      *end         = nullptr;
      if (!description || description->old_value.empty() || value.empty() ||
          std::strtod(value.c_str(), &end) !=
            std::strtod(description->old_value.c_str(), nullptr) ||
          *end != '\0')
        return value;
      origins.add_warning(place + ": " + quote(entry.path) + " = " + value +
                          " is now written " + quote(description->word) +
                          "; the number will go.");
      return description->word;
    }



    void
    Reader::set_value(const DeclaredEntry &entry,
                      const std::string   &value,
                      const std::string   &place)
    {
      for (const std::string &subsection : entry.subsections)
        prm.enter_subsection(subsection);

      // deal.II's pattern for an unsigned integer lets -1 through and makes
      // 4294967295 of it.
      bool is_allowed = entry.pattern != "[Integer]" || value[0] != '-';
      try
        {
          if (is_allowed)
            prm.set(entry.name, value);
        }
      catch (const std::exception &)
        {
          is_allowed = false;
        }

      for (std::size_t i = 0; i < entry.subsections.size(); ++i)
        prm.leave_subsection();
      if (!is_allowed)
        throw BadInput(place + ": " + quote(entry.path) + " cannot be " +
                       (value.empty() ? "empty" : quote(value)) +
                       ".\n  Allowed: " + allowed_values(entry.pattern) + "." +
                       (entry.documentation.empty() ?
                          "" :
                          "\n  Meaning: " + entry.documentation));
    }
  } // namespace



  void
  ParameterOrigins::record(const std::string &path, const std::string &place)
  {
    // The quoted text of --set would only repeat what a check says anyway.
    places[path] =
      place.compare(0, 6, "--set ") == 0 ? "by --set" : "in " + place;
  }



  void
  ParameterOrigins::add_warning(const std::string &text)
  {
    notes.push_back(text);
  }



  std::string
  ParameterOrigins::origin(const std::string &path) const
  {
    const auto place = places.find(path);
    return place == places.end() ? "the default" : "set " + place->second;
  }



  bool
  ParameterOrigins::is_set(const std::string &path) const
  {
    return places.count(path) > 0;
  }



  const std::vector<std::string> &
  ParameterOrigins::warnings() const
  {
    return notes;
  }



  ParameterOrigins
  read_parameters(dealii::ParameterHandler       &prm,
                  const std::string              &file_name,
                  const std::vector<std::string> &overrides)
  {
    Reader reader(prm);
    if (!file_name.empty())
      reader.read_file(file_name);
    reader.read_overrides(overrides);
    return reader.origins;
  }
} // namespace CaissonMPM
