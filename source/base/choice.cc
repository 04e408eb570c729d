// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <limits>

namespace CaissonMPM
{
  using dealii::Patterns::PatternBase;

  namespace
  {
    /** "0" and "90" of "[Double 0...90 (inclusive)]": deal.II tells no bounds
     * in another way. Those of a list are the last ones. */
    std::pair<std::string, std::string>
    bounds_in(const std::string &description)
    {
      const std::size_t dots  = description.rfind("..."),
                        begin = description.rfind(' ', dots) + 1,
                        end   = description.find(' ', dots);
      return {description.substr(begin, dots - begin),
              description.substr(dots + 3, end - dots - 3)};
    }

    /** " from 0 to 90"; a bound that is none is left out. */
    std::string
    range_in_words(const std::string &description)
    {
      const auto [lower, upper] = bounds_in(description);
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

    std::string
    list_in_words(const dealii::Patterns::List &list)
    {
      const auto [least, most] = bounds_in(list.description());
      const std::string each   = allowed_values(list.get_base_pattern()),
                        mark   = list.get_separator();
      if (least == "1" && most == "1")
        return each;
      return number_of_items(least, most) + " separated by " +
             (mark == "," ? "commas" : "\"" + mark + "\"") + ", each " + each;
    }
  } // namespace

  EntryRecord &
  add_entry(Section                                        &owner,
            const std::string                              &entry,
            const std::string                              &default_value,
            const std::string                              &unit,
            const std::string                              &text,
            const PatternBase                              &pattern,
            const std::function<void(const std::string &)> &set)
  {
    auto &prm = Section::prm;
    owner.enter_my_subsection(prm);
    prm.declare_entry(entry, default_value, pattern);
    prm.add_action(entry, set);
    owner.leave_my_subsection(prm);
    return owner.record(entry, unit, text, pattern);
  }

  WordOrNumber::WordOrNumber(const std::string          &word,
                             const std::optional<double> old_value,
                             const PatternBase          &number)
    : word(word)
    , old_value(old_value)
    , number(number.clone())
  {}

  bool
  WordOrNumber::match(const std::string &text) const
  {
    return text == word || number->match(text) || is_old_value(text);
  }

  std::string
  WordOrNumber::description(const OutputStyle) const
  {
    return word + ", or " + allowed_values(*number);
  }

  std::unique_ptr<PatternBase>
  WordOrNumber::clone() const
  {
    return std::make_unique<WordOrNumber>(*this);
  }

  bool
  WordOrNumber::is_old_value(const std::string &text) const
  {
    return old_value && number_in(text) == old_value;
  }

  std::optional<double>
  WordOrNumber::value_of(const std::string &text) const
  {
    return is_old_value(text) ? std::nullopt : number_in(text);
  }

  EntryRecord &
  add_word_or_number(Section                    &owner,
                     const std::string          &entry,
                     std::optional<double>      &value,
                     const std::string          &word,
                     const std::optional<double> old_value,
                     const std::string          &unit,
                     const std::string          &text,
                     const PatternBase          &number)
  {
    const WordOrNumber pattern(word, old_value, number);
    return add_entry(owner,
                     entry,
                     value ? to_text(*value) : word,
                     unit,
                     text,
                     pattern,
                     [&value, pattern](const std::string &setting) {
                       value = pattern.value_of(setting);
                     });
  }

  std::vector<std::string>
  choices_of(const PatternBase &pattern)
  {
    const std::string description = pattern.description(),
                      begin       = "[Selection ";
    if (!boost::starts_with(description, begin))
      return {};
    return dealii::Utilities::split_string_list(
      description.substr(begin.size(), description.size() - begin.size() - 1),
      '|');
  }

  // deal.II has words of its own, but writes the bounds of unbounded numbers:
  // "-MAX_DOUBLE <= v"
  std::string
  allowed_values(const PatternBase &pattern)
  {
    if (const auto *list =
          dynamic_cast<const dealii::Patterns::List *>(&pattern))
      return list_in_words(*list);
    const std::string description = pattern.description();
    if (boost::starts_with(description, "[Double "))
      return "a number" + range_in_words(description);
    if (boost::starts_with(description, "[Integer range "))
      return "a whole number" + range_in_words(description);
    if (description == "[Integer]") // deal.II's name of an unsigned integer
      return "a whole number, at least 0";
    if (description == "[Bool]")
      return "true or false";
    if (description == "[Anything]")
      return "any text";
    const auto choices = choices_of(pattern);
    return choices.empty() ? description :
                             "one of: " + boost::join(choices, ", ");
  }
} // namespace CaissonMPM
