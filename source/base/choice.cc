// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/text.h>

#include <cstdlib>
#include <map>
#include <regex>

namespace CaissonMPM
{
  using dealii::Patterns::PatternBase;

  namespace
  {
    /** Return the number that stands alone in its text, if there is one. */
    std::optional<double>
    number_in(const std::string &text)
    {
      char        *end   = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0')
        return {};
      return value;
    }

    /** By the path of the entry. */
    std::map<std::string, EntryRecord> &
    all_records()
    {
      static std::map<std::string, EntryRecord> records;
      return records;
    }
  } // namespace

  EntryRecord &
  Section::record(const std::string &entry, const std::string &unit)
  {
    entries_.push_back(path_of(entry));
    return all_records()[entries_.back()] = {unit, influence};
  }

  const EntryRecord *
  Section::record_of(const std::string &path)
  {
    const auto found = all_records().find(path);
    return found == all_records().end() ? nullptr : &found->second;
  }

  std::string
  Section::path_of(const std::string &entry) const
  {
    std::string path;
    for (const std::string &section : get_section_path())
      path += section + "/";
    return path + entry;
  }

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
    prm.declare_entry(entry, default_value, pattern, text);
    prm.add_action(entry, set);
    owner.leave_my_subsection(prm);
    return owner.record(entry, unit);
  }

  WordOrNumber::WordOrNumber(const std::string          &word,
                             const std::optional<double> old_value,
                             const PatternBase          &number)
    : word(word)
    , old_value(old_value)
    , number(number.clone())
  {}

  WordOrNumber::WordOrNumber(const WordOrNumber &other)
    : PatternBase(other)
    , word(other.word)
    , old_value(other.old_value)
    , number(other.number->clone())
  {}

  bool
  WordOrNumber::match(const std::string &text) const
  {
    return text == word || number->match(text) ||
           (old_value && number_in(text) == old_value);
  }

  std::string
  WordOrNumber::description(const OutputStyle style) const
  {
    return "[Word " + word +
           (old_value ? ", formerly " + to_text(*old_value) : "") + ", or " +
           number->description(style) + "]";
  }

  std::unique_ptr<PatternBase>
  WordOrNumber::clone() const
  {
    return std::make_unique<WordOrNumber>(*this);
  }

  std::optional<double>
  WordOrNumber::value_of(const std::string &text) const
  {
    const std::optional<double> value = number_in(text);
    return value == old_value ? std::nullopt : value;
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

  std::optional<WordDescription>
  read_word_description(const std::string &pattern)
  {
    static const std::regex description(
      R"(\[Word (.*?)(?:, formerly (.*?))?, or (.*)\])");
    std::smatch part;
    if (!std::regex_match(pattern, part, description))
      return {};
    return WordDescription{part[1], part[2], part[3]};
  }
} // namespace CaissonMPM
