// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/nearest_names.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

namespace CaissonMPM
{
  namespace
  {
    std::string
    lower_case(std::string text)
    {
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return text;
    }

    /** Split a path into its subsection ("" at top level) and last part. */
    std::pair<std::string, std::string>
    split_path(const std::string &path)
    {
      const std::size_t slash = path.rfind('/');
      if (slash == std::string::npos)
        return {"", path};
      return {path.substr(0, slash), path.substr(slash + 1)};
    }

    /** The distance of last parts; a word of a longer name is close to it. */
    unsigned int
    distance_of_last_parts(const std::string &a, const std::string &b)
    {
      const unsigned int distance = edit_distance(a, b);
      const std::string &longer   = a.size() > b.size() ? a : b;
      const std::string &shorter  = a.size() > b.size() ? b : a;
      const bool         is_word =
        shorter.size() >= 4 && longer.find(shorter) != std::string::npos;
      return is_word ? std::min(distance, 1u) : distance;
    }

    struct Candidate
    {
      unsigned int distance;
      bool         other_subsection;
      std::string  name;

      bool
      operator<(const Candidate &other) const
      {
        return std::tie(distance, other_subsection, name) <
               std::tie(other.distance, other.other_subsection, other.name);
      }
    };

    Candidate
    compare(const std::string &typed, const std::string &known)
    {
      const auto [subsection, last]             = split_path(lower_case(typed));
      const auto [known_subsection, known_last] = split_path(lower_case(known));
      const unsigned int distance = distance_of_last_parts(last, known_last);
      if (subsection == known_subsection)
        return {distance, false, known};
      return {std::min(edit_distance(typed, known), distance + 2), true, known};
    }
  } // namespace

  unsigned int
  edit_distance(const std::string &first, const std::string &second)
  {
    const std::string a = lower_case(first), b = lower_case(second);

    // Row i holds the distances of the first i characters of a to the first j
    // of b; three rows are enough to see swapped neighbors.
    std::vector<unsigned int> before(b.size() + 1), last(b.size() + 1),
      row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
      row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
      {
        before.swap(last);
        last.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
          {
            const bool equal = a[i - 1] == b[j - 1];
            row[j]           = std::min(
              {last[j] + 1, row[j - 1] + 1, last[j - 1] + (equal ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
              row[j] = std::min(row[j], before[j - 2] + 1);
          }
      }
    return row[b.size()];
  }

  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &known_names)
  {
    const std::size_t  length       = split_path(name).second.size();
    const unsigned int max_distance = 2 + length / 4;

    std::vector<Candidate> candidates;
    for (const std::string &known : known_names)
      candidates.push_back(compare(name, known));
    std::sort(candidates.begin(), candidates.end());

    // Beside a near name, far ones would only distract.
    std::vector<std::string> result;
    for (const Candidate &candidate : candidates)
      if (result.size() < 3 && candidate.distance <= max_distance &&
          candidate.distance <= candidates.front().distance + 1)
        result.push_back(candidate.name);
    return result;
  }

  std::vector<std::string>
  names_of_symbol(const std::string              &path,
                  const std::vector<std::string> &known_names)
  {
    static const std::map<std::string, std::string> names = {
      {"boiling", "Water depth"},
      {"c", "Cohesion"},
      {"cavitation", "Water depth"},
      {"cfl", "Courant number"},
      {"d", "Outer diameter"},
      {"delta", "Friction angle of the outer wall"},
      {"dr", "Relative density"},
      {"dt", "Time step"},
      {"e", "Youngs modulus"},
      {"g", "Gravity"},
      {"gamma", "Solid density"},
      {"k", "Permeability"},
      {"l", "Skirt length"},
      {"m", "Critical friction angle"},
      {"n", "Porosity"},
      {"nu", "Poisson ratio"},
      {"ocr", "Overconsolidation ratio"},
      {"phi", "Friction angle"},
      {"psi", "Dilatancy angle"},
      {"pull", "Suction control"},
      {"sd/sua", "Direct shear strength ratio"},
      {"sp/sua", "Passive strength ratio"},
      {"su", "Cohesion"},
      {"sua", "Active strength"},
      {"t", "Wall thickness"},
      {"tension", "Suction control"},
      {"unit weight", "Solid density"},
      {"wall friction", "Friction angle of the outer wall"}};
    const auto [subsection, symbol] = split_path(lower_case(path));
    const auto whole = names.find(lower_case(path)); // may have a slash
    const auto meant = whole != names.end() ? whole : names.find(symbol);
    std::vector<std::string> result;
    for (const std::string &known : known_names)
      {
        const auto [of_known, last] = split_path(known);
        if (meant == names.end() || last != meant->second)
          continue;
        if (lower_case(of_known) == subsection)
          return {known};
        if (result.empty())
          result = {known};
      }
    return result;
  }

  std::string
  did_you_mean(const std::vector<std::string> &names)
  {
    if (names.empty())
      return "";
    if (names.size() == 1)
      return "\n  Did you mean \"" + names.front() + "\"?";
    std::string result = "\n  Did you mean one of these?";
    for (const std::string &name : names)
      result += "\n    " + name;
    return result;
  }
} // namespace CaissonMPM
