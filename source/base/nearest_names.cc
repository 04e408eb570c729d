// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/nearest_names.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace CaissonMPM
{
  namespace
  {
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

    /** The distance, whether the subsection is another one, and the name. */
    using Candidate = std::tuple<unsigned int, bool, std::string>;

    Candidate
    compare(const std::string &typed, const std::string &known)
    {
      const auto [subsection, last] = split_path(boost::to_lower_copy(typed));
      const auto [known_subsection, known_last] =
        split_path(boost::to_lower_copy(known));
      const unsigned int distance = distance_of_last_parts(last, known_last);
      if (subsection == known_subsection)
        return {distance, false, known};
      return {std::min(edit_distance(typed, known), distance + 2), true, known};
    }
  } // namespace

  unsigned int
  edit_distance(const std::string &first, const std::string &second)
  {
    const std::string a = boost::to_lower_copy(first),
                      b = boost::to_lower_copy(second);

    // that of the first i characters of a and the first j of b
    std::vector<std::vector<unsigned int>> distance(
      a.size() + 1, std::vector<unsigned int>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
      for (std::size_t j = 0; j <= b.size(); ++j)
        {
          unsigned int &least = distance[i][j];
          if (i == 0 || j == 0)
            {
              least = i + j;
              continue;
            }
          least = std::min({distance[i - 1][j] + 1,
                            distance[i][j - 1] + 1,
                            distance[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
          if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
            least = std::min(least, distance[i - 2][j - 2] + 1);
        }
    return distance[a.size()][b.size()];
  }

  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &known_names)
  {
    const std::size_t  length       = split_path(name).second.size();
    const unsigned int max_distance = 2 + length / 4;

    std::set<Candidate> candidates;
    for (const std::string &known : known_names)
      candidates.insert(compare(name, known));

    // Beside a near name, far ones would only distract.
    std::vector<std::string> result;
    for (const auto &[distance, is_elsewhere, known] : candidates)
      if (result.size() < 3 && distance <= max_distance &&
          distance <= std::get<0>(*candidates.begin()) + 1)
        result.push_back(known);
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
    const auto [subsection, symbol] = split_path(boost::to_lower_copy(path));
    const auto whole =
      names.find(boost::to_lower_copy(path)); // may have a slash
    const auto meant = whole != names.end() ? whole : names.find(symbol);
    std::vector<std::string> result;
    for (const std::string &known : known_names)
      {
        const auto [of_known, last] = split_path(known);
        if (meant == names.end() || last != meant->second)
          continue;
        if (boost::to_lower_copy(of_known) == subsection)
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
