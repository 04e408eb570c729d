// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/section.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <set>

namespace CaissonMPM
{
  namespace
  {
    std::list<EntryRecord> &
    records()
    {
      static std::list<EntryRecord> all;
      return all;
    }

    /** How many subsections are the same, from the outermost one on. */
    std::size_t
    n_common(const std::vector<std::string> &a,
             const std::vector<std::string> &b)
    {
      return std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first -
             a.begin();
    }

    /** Put a record in the place of that with its path, or else behind those of
     * its section or, if there are none, of the nearest one around it. */
    EntryRecord &
    keep(const EntryRecord &record)
    {
      auto        place = records().end();
      std::size_t most  = 1;
      for (auto other = records().begin(); other != records().end(); ++other)
        {
          if (other->path == record.path)
            return *other = record;
          const auto n = n_common(other->subsections, record.subsections);
          if (n >= most)
            {
              most  = n;
              place = std::next(other);
            }
        }
      return *records().insert(place, record);
    }

    /** Comment lines, broken at 78 characters. */
    std::string
    as_comment(const std::string &text, const std::string &indent)
    {
      std::string result;
      for (const std::string &line :
           dealii::Utilities::break_text_into_lines(text, 76 - indent.size()))
        result += indent + "# " + line + "\n";
      return result;
    }

    std::string
    describe_entry(const EntryRecord &entry, const std::string &indent)
    {
      const std::string value         = entry.value(),
                        default_value = entry.default_value.empty() ?
                                          "empty" :
                                          entry.default_value;
      return "\n" + as_comment(entry.documentation, indent) +
             as_comment("Allowed: " + allowed_values(*entry.pattern) +
                          ". Default: " + default_value,
                        indent) +
             indent + "set " + entry.name + " =" +
             (value.empty() ? "" : " " + value) + "\n";
    }

    /** The "end" and "subsection" lines that lead from one path to another. */
    std::string
    change_subsection(std::vector<std::string>       &open,
                      const std::vector<std::string> &wanted)
    {
      const std::size_t n_kept = n_common(open, wanted);
      std::string       result;
      while (open.size() > n_kept)
        {
          open.pop_back();
          result += std::string(2 * open.size(), ' ') + "end\n";
        }
      while (open.size() < wanted.size())
        {
          result += "\n" + std::string(2 * open.size(), ' ') + "subsection " +
                    wanted[open.size()] + "\n";
          open.push_back(wanted[open.size()]);
        }
      return result;
    }

    /** The entries that an action accepts, with their subsections. */
    template <typename Accept>
    std::string
    describe_entries(const Accept &accept)
    {
      std::string              result;
      std::vector<std::string> open;
      for (const EntryRecord &entry : records())
        if (accept(entry))
          {
            result += change_subsection(open, entry.subsections);
            result += describe_entry(entry, std::string(2 * open.size(), ' '));
          }
      return result + change_subsection(open, {});
    }

    /** What an entry is, whichever of several like sections it stands in. */
    std::string
    meaning_in_any_section(const EntryRecord &entry)
    {
      const std::string above =
        entry.subsections.size() > 1 ? entry.subsections.front() : entry.path;
      return above + '\n' + entry.name + '\n' + entry.documentation;
    }
  } // namespace

  Section::~Section()
  {
    records().remove_if(
      [this](const EntryRecord &record) { return record.owner == this; });
  }

  EntryRecord &
  Section::record(const std::string                   &entry,
                  const std::string                   &unit,
                  const std::string                   &text,
                  const dealii::Patterns::PatternBase &pattern)
  {
    entries_.push_back(path_of(entry));
    return keep({this,
                 get_section_path(),
                 entry,
                 entries_.back(),
                 prm.get(get_section_path(), entry),
                 unit,
                 text + (unit.empty() ? "" : " Units: " + unit + "."),
                 influence,
                 pattern.clone()});
  }

  std::string
  Section::path_of(const std::string &entry) const
  {
    std::string path;
    for (const std::string &section : get_section_path())
      path += section + "/";
    return path + entry;
  }

  std::string
  EntryRecord::value() const
  {
    return as_utf8(dealii::ParameterAcceptor::prm.get(subsections, name));
  }

  const std::list<EntryRecord> &
  declared_entries()
  {
    return records();
  }

  const EntryRecord *
  find_entry(const std::string &path)
  {
    const auto found = std::find_if(records().begin(),
                                    records().end(),
                                    [&path](const EntryRecord &entry) {
                                      return entry.path == path;
                                    });
    return found == records().end() ? nullptr : &*found;
  }

  std::vector<std::string>
  entry_paths()
  {
    std::vector<std::string> result;
    for (const EntryRecord &entry : records())
      result.push_back(entry.path);
    return result;
  }

  std::vector<std::string>
  section_paths()
  {
    std::set<std::string> result;
    for (std::string path : entry_paths())
      while (path.find('/') != std::string::npos)
        result.insert(path = path.substr(0, path.rfind('/')));
    return {result.begin(), result.end()};
  }

  bool
  has_section(const std::string &path)
  {
    return std::any_of(records().begin(),
                       records().end(),
                       [&path](const EntryRecord &entry) {
                         return boost::starts_with(entry.path, path + "/");
                       });
  }

  std::string
  describe_parameters()
  {
    return "# All entries of caisson_mpm and the values in effect.\n" +
           describe_entries([](const EntryRecord &) { return true; });
  }

  std::string
  describe_parameters(const std::string &word)
  {
    const auto meant = names_of_symbol(word, entry_paths());
    using Entry      = EntryRecord;
    for (const auto text_of :
         {+[](const Entry &entry) { return entry.path; },
          +[](const Entry &entry) { return entry.documentation; },
          +[](const Entry &entry) {
            return boost::join(choices_of(*entry.pattern), ", ");
          }})
      {
        std::set<std::string> explained;
        const std::string     found =
          describe_entries([&](const EntryRecord &entry) {
            return boost::icontains(text_of(entry), word) &&
                   (explained.insert(meaning_in_any_section(entry)).second ||
                    entry.value() != entry.default_value);
          });
        std::string others;
        for (const std::string &path : meant)
          if (explained.count(meaning_in_any_section(*find_entry(path))) == 0)
            others += "# See also " + path + ".\n";
        if (!found.empty())
          return "# Entries of caisson_mpm with \"" + word +
                 "\", and the values in effect.\n" + others + found;
      }
    throw BadInput("No entry has \"" + word + "\" in its name or meaning." +
                   did_you_mean(!meant.empty() ?
                                  meant :
                                  nearest_names(word, entry_paths())) +
                   "\n  \"caisson_mpm --print-parameters\" lists all entries.");
  }
} // namespace CaissonMPM
