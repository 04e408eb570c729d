// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/nearest_names.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <limits>
#include <sstream>

namespace CaissonMPM
{
  namespace
  {
    using Tree = boost::property_tree::ptree;
    using dealii::ParameterHandler;

    Tree
    tree_of(const ParameterHandler &prm)
    {
      std::stringstream xml;
      prm.print_parameters(xml,
                           ParameterHandler::XML |
                             ParameterHandler::KeepDeclarationOrder);
      Tree tree;
      boost::property_tree::read_xml(xml, tree);
      return tree.get_child("ParameterHandler");
    }

    /** Turn "Layer_201" back into "Layer 1": _XX is a hexadecimal code. */
    std::string
    unmangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '_' && i + 2 < name.size())
          {
            result +=
              static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          result += name[i];
      return result;
    }

    std::string
    join(const std::vector<std::string> &subsections, const std::string &name)
    {
      std::string result;
      for (const std::string &subsection : subsections)
        result += subsection + "/";
      return result + name;
    }

    /** Of an entry without a unit users need no such note. */
    std::string
    without_empty_unit(const std::string &documentation)
    {
      const auto unit = documentation.rfind(" Units: none");
      return documentation.substr(0, unit);
    }

    DeclaredEntry
    read_entry(const Tree                     &node,
               const std::vector<std::string> &subsections,
               const std::string              &name)
    {
      DeclaredEntry entry;
      entry.subsections   = subsections;
      entry.name          = name;
      entry.path          = join(subsections, name);
      entry.value         = node.get<std::string>("value", "");
      entry.default_value = node.get<std::string>("default_value", "");
      entry.documentation =
        without_empty_unit(node.get<std::string>("documentation", ""));
      entry.pattern = node.get<std::string>("pattern_description", "");
      entry.is_deprecated =
        node.get<std::string>("deprecation_status", "") == "true";
      if (const auto alias = node.get_optional<std::string>("alias"))
        entry.alias_of = join(subsections, *alias);
      return entry;
    }

    /** Add all that the tree holds below the subsections named by @p path. */
    void
    collect(const Tree                     &tree,
            const std::vector<std::string> &path,
            std::vector<DeclaredEntry>     &entries,
            std::set<std::string>          &subsections)
    {
      for (const auto &[mangled_name, node] : tree)
        {
          const std::string name = unmangle(mangled_name);
          if (node.count("value") > 0 || node.count("alias") > 0)
            entries.push_back(read_entry(node, path, name));
          else
            {
              std::vector<std::string> path_of_node = path;
              path_of_node.push_back(name);
              subsections.insert(join(path, name));
              collect(node, path_of_node, entries, subsections);
            }
        }
    }

    /** The text between two marks, from the front; empty if there is none. */
    std::string
    between(const std::string &text,
            const std::string &begin,
            const std::string &end)
    {
      const std::size_t first = text.find(begin);
      if (first == std::string::npos)
        return "";
      const std::size_t start = first + begin.size();
      return text.substr(start, text.find(end, start) - start);
    }

    bool
    starts_with(const std::string &text, const std::string &beginning)
    {
      return text.compare(0, beginning.size(), beginning) == 0;
    }

    /** " from 0 to 90" for "0...90"; a bound that is no bound is left out. */
    std::string
    range_in_words(const std::string &range,
                   const std::string &no_lower_bound,
                   const std::string &no_upper_bound)
    {
      const std::size_t dots = range.find("...");
      if (dots == std::string::npos)
        return "";
      const std::string lower = range.substr(0, dots);
      const std::string upper = range.substr(dots + 3);
      if (lower != no_lower_bound && upper != no_upper_bound)
        return " from " + lower + " to " + upper;
      if (lower != no_lower_bound)
        return ", at least " + lower;
      if (upper != no_upper_bound)
        return ", at most " + upper;
      return "";
    }

    std::string
    allowed_integers(const std::string &pattern)
    {
      // deal.II describes an unsigned integer as an integer without a range.
      if (pattern == "[Integer]")
        return "a whole number, at least 0";
      using Limits = std::numeric_limits<int>;
      return "a whole number" +
             range_in_words(between(pattern, "[Integer range ", " (inclusive)"),
                            to_text(Limits::min()),
                            to_text(Limits::max()));
    }

    std::string
    allowed_numbers(const std::string &pattern)
    {
      return "a number" +
             range_in_words(between(pattern, "[Double ", " (inclusive)"),
                            "-MAX_DOUBLE",
                            "MAX_DOUBLE");
    }

    std::string
    choices(const std::string &pattern, const std::string &kind)
    {
      std::string names = between(pattern, kind, "]");
      names = dealii::Utilities::replace_in_string(names, "|", ", ");
      return dealii::Utilities::trim(names);
    }

    std::string
    number_of_items(const std::string &range)
    {
      const std::size_t dots  = range.find("...");
      const std::string least = range.substr(0, dots);
      const std::string most  = range.substr(dots + 3);
      const bool        no_upper_bound =
        most == to_text(std::numeric_limits<unsigned int>::max());
      if (least == most)
        return least + " items";
      if (no_upper_bound)
        return least == "0" ? "a list of items" :
                              "a list of at least " + least + " items";
      return least + " to " + most + " items";
    }

    /** "[List of <...> of length 2...2 (inclusive) separated by <;>]" */
    std::string
    allowed_lists(const std::string &pattern)
    {
      const std::size_t inner_begin = pattern.find('<') + 1;
      const std::size_t inner_end   = pattern.rfind("> of length ");
      const std::string inner =
        pattern.substr(inner_begin, inner_end - inner_begin);
      const std::string rest      = pattern.substr(inner_end);
      const std::string separator = between(rest, "separated by <", ">]");
      const std::string length    = between(rest, "of length ", " (inclusive)");
      if (length == "1...1")
        return allowed_values(inner);
      return number_of_items(length) + " separated by " +
             (separator.empty() ? "commas" : "\"" + separator + "\"") +
             ", each " + allowed_values(inner);
    }

    /** "[Map of <...>:<...> of length 0...3 (inclusive)]" */
    std::string
    allowed_maps(const std::string &pattern)
    {
      const std::size_t inner_end = pattern.rfind("> of length ");
      const std::size_t colon     = pattern.rfind(">:<", inner_end);
      const std::size_t key_begin = pattern.find('<') + 1;
      const std::string key = pattern.substr(key_begin, colon - key_begin);
      const std::string value =
        pattern.substr(colon + 3, inner_end - colon - 3);
      const std::string rest      = pattern.substr(inner_end);
      const std::string separator = between(rest, "separated by <", ">]");
      return number_of_items(between(rest, "of length ", " (inclusive)")) +
             " \"name : value\" separated by " +
             (separator.empty() ? "commas" : "\"" + separator + "\"") +
             ", each name " + allowed_values(key) + " and each value " +
             allowed_values(value);
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
        if (entry.alias_of.empty() && accept(entry))
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
    collect(tree_of(prm), {}, entries, subsections);
    for (std::size_t i = 0; i < entries.size(); ++i)
      index[entries[i].path] = i;
  }



  const DeclaredEntry *
  DeclaredEntries::find(const std::string &path) const
  {
    const auto found = index.find(path);
    return found == index.end() ? nullptr : &entries[found->second];
  }



  bool
  DeclaredEntries::has_subsection(const std::string &path) const
  {
    return subsections.count(path) > 0;
  }



  std::vector<std::string>
  DeclaredEntries::entry_paths() const
  {
    std::vector<std::string> result;
    for (const DeclaredEntry &entry : entries)
      if (entry.alias_of.empty())
        result.push_back(entry.path);
    return result;
  }



  std::vector<std::string>
  DeclaredEntries::subsection_paths() const
  {
    return {subsections.begin(), subsections.end()};
  }



  const std::vector<DeclaredEntry> &
  DeclaredEntries::all() const
  {
    return entries;
  }



  std::vector<std::string>
  choices_of(const std::string &pattern)
  {
    if (!starts_with(pattern, "[Selection"))
      return {};
    return dealii::Utilities::split_string_list(
      between(pattern, "[Selection ", "]"), '|');
  }



  // deal.II has words of its own, but writes the bounds of unbounded numbers
  // ("-MAX_DOUBLE <= v"), and pattern_factory() misreads a list of lists.
  std::string
  allowed_values(const std::string &pattern)
  {
    if (const auto word = read_word_description(pattern))
      return word->word + ", or " + allowed_values(word->number);
    if (starts_with(pattern, "[Profile "))
      return allowed_numbers(pattern) +
             ", or an expression in d (the depth, m), s and p (the effective "
             "vertical and mean stress at the start, Pa)";
    if (starts_with(pattern, "[Integer"))
      return allowed_integers(pattern);
    if (starts_with(pattern, "[Double"))
      return allowed_numbers(pattern);
    if (starts_with(pattern, "[Selection"))
      return "one of: " + choices(pattern, "[Selection ");
    if (starts_with(pattern, "[MultipleSelection"))
      return "any of: " + choices(pattern, "[MultipleSelection ") +
             " (separated by commas)";
    if (starts_with(pattern, "[Bool"))
      return "true or false";
    if (starts_with(pattern, "[List of <"))
      return allowed_lists(pattern);
    if (starts_with(pattern, "[Map of <"))
      return allowed_maps(pattern);
    if (starts_with(pattern, "[Anything"))
      return "any text";
    if (starts_with(pattern, "[FileName"))
      return "a file name";
    if (starts_with(pattern, "[DirectoryName"))
      return "a directory name";
    return pattern;
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
    for (const auto text :
         {&DeclaredEntry::path, &DeclaredEntry::documentation})
      {
        std::set<std::string> explained;
        const std::string     found =
          describe_entries(entries, [&](const DeclaredEntry &entry) {
            return boost::icontains(entry.*text, word) &&
                   (explained.insert(meaning_in_any_section(entry)).second ||
                    entry.value != entry.default_value);
          });
        if (!found.empty())
          return "# Entries of caisson_mpm with \"" + word +
                 "\", and the values in effect.\n" + found;
      }
    throw BadInput("No entry has \"" + word + "\" in its name or meaning." +
                   did_you_mean(nearest_names(word, entries.entry_paths())) +
                   "\n  \"caisson_mpm --print-parameters\" lists all entries.");
  }
} // namespace CaissonMPM
