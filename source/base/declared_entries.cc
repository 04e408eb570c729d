// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/property_tree/json_parser.hpp>

#include <limits>
#include <regex>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    using Tree = boost::property_tree::ptree;
    using dealii::ParameterHandler;

    std::string
    join(const std::vector<std::string> &subsections, const std::string &name)
    {
      std::string result;
      for (const std::string &subsection : subsections)
        result += subsection + "/";
      return result + name;
    }

    /** " from 0 to 90" for "0" and "90"; a bound that is none is left out. */
    std::string
    range_in_words(const std::string &lower, const std::string &upper)
    {
      const bool from_below = lower == "-MAX_DOUBLE" || lower == "-2147483648",
                 up_to_any  = upper == "MAX_DOUBLE" || upper == "2147483647";
      if (from_below)
        return up_to_any ? "" : ", at most " + upper;
      return up_to_any ? ", at least " + lower :
                         " from " + lower + " to " + upper;
    }

    std::string
    number_of_items(const std::string &least, const std::string &most)
    {
      if (least == most)
        return least + " items";
      if (most == to_text(std::numeric_limits<unsigned int>::max()))
        return "a list of " + (least == "0" ? "" : "at least " + least + " ") +
               "items";
      return least + " to " + most + " items";
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
    describe_entry(const DeclaredEntry &entry, const std::string &indent)
    {
      const std::string default_value =
        entry.default_value.empty() ? "empty" : entry.default_value;
      return "\n" + as_comment(entry.documentation, indent) +
             as_comment("Allowed: " + allowed_values(entry.pattern) +
                          ". Default: " + default_value,
                        indent) +
             indent + "set " + entry.name + " =" +
             (entry.value.empty() ? "" : " " + entry.value) + "\n";
    }

    /** The "end" and "subsection" lines that lead from one path to another. */
    std::string
    change_subsection(std::vector<std::string>       &open,
                      const std::vector<std::string> &wanted)
    {
      std::size_t n_common = 0;
      while (n_common < open.size() && n_common < wanted.size() &&
             open[n_common] == wanted[n_common])
        ++n_common;

      std::string result;
      while (open.size() > n_common)
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
    describe_entries(const DeclaredEntries &entries, const Accept &accept)
    {
      std::string              result;
      std::vector<std::string> open;
      for (const DeclaredEntry &entry : entries.all())
        if (accept(entry))
          {
            result += change_subsection(open, entry.subsections);
            result += describe_entry(entry, std::string(2 * open.size(), ' '));
          }
      return result + change_subsection(open, {});
    }

    /** What an entry is, whichever of several like sections it stands in. */
    std::string
    meaning_in_any_section(const DeclaredEntry &entry)
    {
      const std::string above =
        entry.subsections.size() > 1 ? entry.subsections.front() : entry.path;
      return above + '\n' + entry.name + '\n' + entry.documentation;
    }
  } // namespace

  DeclaredEntries::DeclaredEntries(const ParameterHandler &prm)
  {
    std::stringstream text;
    prm.print_parameters(text,
                         ParameterHandler::JSON |
                           ParameterHandler::KeepDeclarationOrder);
    Tree               tree;
    std::istringstream readable(as_utf8(text.str()));
    boost::property_tree::read_json(readable, tree);
    collect(tree, {});
  }

  void
  DeclaredEntries::collect(const Tree                     &tree,
                           const std::vector<std::string> &above)
  {
    for (const auto &[name, node] : tree)
      {
        const std::string path = join(above, name);
        if (node.count("value") > 0)
          {
            const auto text = [&tree_of_entry = node](const char *key) {
              return tree_of_entry.get<std::string>(key, "");
            };
            const EntryRecord &record = *Section::record_of(path);
            index[path]               = entries.size();
            entries.push_back(
              {above,
               name,
               path,
               text("value"),
               text("default_value"),
               text("documentation") +
                 (record.unit.empty() ? "" : " Units: " + record.unit + "."),
               record.unit,
               text("pattern_description"),
               record.influence});
          }
        else
          {
            std::vector<std::string> below = above;
            below.push_back(name);
            subsections.insert(path);
            collect(node, below);
          }
      }
  }

  const DeclaredEntry *
  DeclaredEntries::find(const std::string &path) const
  {
    const auto found = index.find(path);
    return found == index.end() ? nullptr : &entries[found->second];
  }

  std::vector<std::string>
  DeclaredEntries::entry_paths() const
  {
    std::vector<std::string> result;
    for (const DeclaredEntry &entry : entries)
      result.push_back(entry.path);
    return result;
  }

  std::vector<std::string>
  choices_of(const std::string &pattern)
  {
    static const std::regex selection(R"(\[Selection (.*)\])");
    std::smatch             part;
    if (!std::regex_match(pattern, part, selection))
      return {};
    return dealii::Utilities::split_string_list(part[1], '|');
  }

  // deal.II has words of its own, but writes the bounds of unbounded numbers
  // ("-MAX_DOUBLE <= v"), and pattern_factory() misreads a list of lists.
  std::string
  allowed_values(const std::string &pattern)
  {
    static const std::regex //
      number(R"(\[(Double|Integer range) (.+)\.\.\.(.+) \(inclusive\)\])"),
      profile(R"(\[Profile (.*)\])"),
      list(R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\))"
           R"((?: separated by <(.*)>)?\])");
    std::smatch part;
    if (const auto word = read_word_description(pattern))
      return word->word + ", or " + allowed_values(word->number);
    if (std::regex_match(pattern, part, profile))
      return allowed_values(part[1]) +
             ", or an expression in d (the depth, m), s and p (the effective "
             "vertical and mean stress at the start, Pa)";
    if (std::regex_match(pattern, part, number))
      return (part[1] == "Double" ? "a number" : "a whole number") +
             range_in_words(part[2], part[3]);
    if (std::regex_match(pattern, part, list))
      return part[2] == "1" && part[3] == "1" ?
               allowed_values(part[1]) :
               number_of_items(part[2], part[3]) + " separated by " +
                 (part[4].matched ? "\"" + part[4].str() + "\"" : "commas") +
                 ", each " + allowed_values(part[1]);
    if (pattern == "[Integer]") // deal.II's name of an unsigned integer
      return "a whole number, at least 0";
    if (pattern == "[Bool]")
      return "true or false";
    if (pattern == "[Anything]")
      return "any text";
    std::string names;
    for (const std::string &choice : choices_of(pattern))
      names += (names.empty() ? "one of: " : ", ") + choice;
    return names.empty() ? pattern : names;
  }

  std::string
  describe_parameters(const ParameterHandler &prm)
  {
    return "# All entries of caisson_mpm and the values in effect.\n" +
           describe_entries(DeclaredEntries(prm),
                            [](const DeclaredEntry &) { return true; });
  }

  std::string
  describe_parameters(const ParameterHandler &prm, const std::string &word)
  {
    const DeclaredEntries entries(prm);
    const auto            meant = names_of_symbol(word, entries.entry_paths());
    using Entry                 = DeclaredEntry;
    for (const auto text_of :
         {+[](const Entry &entry) { return entry.path; },
          +[](const Entry &entry) { return entry.documentation; },
          +[](const Entry &entry) {
            return boost::join(choices_of(entry.pattern), ", ");
          }})
      {
        std::set<std::string> explained;
        const std::string     found =
          describe_entries(entries, [&](const DeclaredEntry &entry) {
            return boost::icontains(text_of(entry), word) &&
                   (explained.insert(meaning_in_any_section(entry)).second ||
                    entry.value != entry.default_value);
          });
        std::string others;
        for (const std::string &path : meant)
          if (explained.count(meaning_in_any_section(*entries.find(path))) == 0)
            others += "# See also " + path + ".\n";
        if (!found.empty())
          return "# Entries of caisson_mpm with \"" + word +
                 "\", and the values in effect.\n" + others + found;
      }
    throw BadInput("No entry has \"" + word + "\" in its name or meaning." +
                   did_you_mean(!meant.empty() ?
                                  meant :
                                  nearest_names(word, entries.entry_paths())) +
                   "\n  \"caisson_mpm --print-parameters\" lists all entries.");
  }
} // namespace CaissonMPM
