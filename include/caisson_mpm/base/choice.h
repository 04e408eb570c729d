// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Entries whose text is parsed once, when it is set: a name that chooses one
// value of an enumeration, and a word that stands in the place of a number;
// and what a pattern allows, in words.
#ifndef caisson_mpm_base_choice_h
#define caisson_mpm_base_choice_h

#include <caisson_mpm/base/section.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/patterns.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * Declare an entry in the section of @p owner, and call @p set with the text
   * whenever the entry is set to a value that matches @p pattern.
   */
  EntryRecord &
  add_entry(Section                                        &owner,
            const std::string                              &entry,
            const std::string                              &default_value,
            const std::string                              &unit,
            const std::string                              &text,
            const dealii::Patterns::PatternBase            &pattern,
            const std::function<void(const std::string &)> &set);

  /** The names of the values of an enumeration, in the order of the manual. */
  template <typename Enum>
  using Choices = std::vector<std::pair<std::string, Enum>>;

  /** Return the name of a value, which must be among the choices. */
  template <typename Enum>
  const std::string &
  name_of(const Choices<Enum> &choices, const Enum value)
  {
    std::size_t i = 0;
    while (i < choices.size() && choices[i].second != value)
      ++i;
    AssertThrow(i < choices.size(), dealii::ExcInternalError());
    return choices[i].first;
  }

  /**
   * Declare an entry that sets @p value, a member of @p owner, to one of the
   * choices; its default is the value that the member has now.
   *
   * @code
   * add_choice(*this, "Velocity transfer", transfer,
   *            {{"FLIP", Transfer::flip}, {"PIC", Transfer::pic}},
   *            "", "How points take the velocity of the grid.");
   * @endcode
   */
  template <typename Enum>
  EntryRecord &
  add_choice(Section             &owner,
             const std::string   &entry,
             Enum                &value,
             const Choices<Enum> &choices,
             const std::string   &unit,
             const std::string   &text)
  {
    std::string names;
    for (const auto &choice : choices)
      names += (names.empty() ? "" : "|") + choice.first;
    return add_entry(owner,
                     entry,
                     name_of(choices, value),
                     unit,
                     text,
                     dealii::Patterns::Selection(names),
                     [&value, choices](const std::string &name) {
                       for (const auto &choice : choices)
                         if (choice.first == name)
                           value = choice.second;
                     });
  }

  /**
   * A number, or a word in its place ("auto", "never", "every step"). Where
   * earlier versions of the program took a special number instead of the word,
   * that number is still accepted: read_parameters() puts the word in its
   * place and warns.
   */
  class WordOrNumber : public dealii::Patterns::PatternBase
  {
  public:
    /** @p old_value is the special number of earlier versions, if any. */
    WordOrNumber(const std::string                   &word,
                 const std::optional<double>          old_value,
                 const dealii::Patterns::PatternBase &number);

    bool
    match(const std::string &text) const override;

    /** "auto, or a number from 0 to 1" in any style. */
    std::string
    description(const OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

    /** Whether the text is the special number of earlier versions. */
    bool
    is_old_value(const std::string &text) const;

    /** Return no value for the word and for the old special number. */
    std::optional<double>
    value_of(const std::string &text) const;

    const std::string word;

  private:
    std::optional<double>                                old_value;
    std::shared_ptr<const dealii::Patterns::PatternBase> number;
  };

  /**
   * Declare an entry that holds a number or a word. @p value is a member of
   * @p owner; it has no value where the word was given, and its present state
   * is the default.
   *
   * @code
   * add_word_or_number(*this, "K0", k0, "auto", -1., "",
   *                    "Horizontal over vertical stress.",
   *                    Patterns::Double(0., 10.));
   * @endcode
   */
  EntryRecord &
  add_word_or_number(
    Section                             &owner,
    const std::string                   &entry,
    std::optional<double>               &value,
    const std::string                   &word,
    const std::optional<double>          old_value,
    const std::string                   &unit,
    const std::string                   &text,
    const dealii::Patterns::PatternBase &number = dealii::Patterns::Double());

  /** The values that a pattern accepts, in words: "a number from 0 to 90". */
  std::string
  allowed_values(const dealii::Patterns::PatternBase &pattern);

  /** The words among which a pattern lets the user choose; none where it is
   * another kind of pattern. */
  std::vector<std::string>
  choices_of(const dealii::Patterns::PatternBase &pattern);
} // namespace CaissonMPM

#endif
