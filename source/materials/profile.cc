// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/expression.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/profile.h>

#include <cctype>
#include <cmath>

namespace CaissonMPM
{
  using namespace dealii;
  using Patterns::PatternBase;

  namespace
  {
    bool
    is_part_of_word(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' ||
             c == '.';
    }

    /** Whether one of the letters stands as a word of its own. */
    bool
    has_variable(const std::string &text, const std::string &letters)
    {
      for (std::size_t i = 0; i < text.size(); ++i)
        if (letters.find(text[i]) != std::string::npos &&
            (i == 0 || !is_part_of_word(text[i - 1])) &&
            (i + 1 == text.size() || !is_part_of_word(text[i + 1])))
          return true;
      return false;
    }

    /** Whether a text is more than a number or a word. */
    bool
    is_expression(const std::string &text)
    {
      return has_variable(text, "dsp") ||
             text.find_first_of("*/^(<>&|?") != std::string::npos;
    }
  } // namespace

  Profile::Profile(const double number, const PatternBase &pattern)
    : pattern(pattern.clone())
    , number(number)
  {}

  void
  Profile::set(const std::string &new_text, const std::string &new_entry)
  {
    text  = new_text;
    entry = new_entry;
    function.reset();
    if (is_expression(text))
      function =
        parse_function<3>(text, "d,s,p", Point<3>(1., 1e4, 1e4), name());
    else
      number = std::stod(text);
  }

  bool
  Profile::depends_on(const std::string &letters) const
  {
    return !is_constant() && has_variable(text, letters);
  }

  double
  Profile::unchecked(const PlaceInGround &place) const
  {
    return is_constant() ?
             number :
             function->value(
               Point<3>(place.depth, place.vertical_stress, place.mean_stress));
  }

  double
  Profile::operator()(const PlaceInGround &place) const
  {
    const double value     = unchecked(place);
    const bool   is_number = std::isfinite(value);
    if (!is_constant() && (!is_number || !pattern->match(to_text(value))))
      throw BadInput(
        name() + " is " + (is_number ? to_text(value) : "no number") +
        " at a depth of " + to_text(place.depth, 4) + " m" +
        (knows_stress() ?
           ", where s = " + to_text(place.vertical_stress, 4) +
             " Pa and p = " + to_text(place.mean_stress, 4) + " Pa" :
           "") +
        ". It must be " + allowed_values(*pattern) + " in the whole layer.");
    return value;
  }

  ProfilePattern::ProfilePattern(const PatternBase &number)
    : number(number.clone())
  {}

  bool
  ProfilePattern::match(const std::string &text) const
  {
    return number->match(text) || is_expression(text);
  }

  std::string
  ProfilePattern::description(const OutputStyle) const
  {
    return allowed_values(*number) +
           ", or an expression in d (the depth, m), s and p (the effective "
           "vertical and mean stress at the start, Pa)";
  }

  std::unique_ptr<PatternBase>
  ProfilePattern::clone() const
  {
    return std::make_unique<ProfilePattern>(*this);
  }

  EntryRecord &
  add_profile(Section           &owner,
              const std::string &entry,
              Profile           &profile,
              const std::string &unit,
              const std::string &text)
  {
    const std::string path = owner.path_of(entry);
    return add_entry(owner,
                     entry,
                     to_text(profile.unchecked({})),
                     unit,
                     text,
                     ProfilePattern(profile.number_pattern()),
                     [&profile, path](const std::string &setting) {
                       profile.set(setting, path);
                     });
  }

  EntryRecord &
  add_word_or_profile(Section                    &owner,
                      const std::string          &entry,
                      std::unique_ptr<Profile>   &profile,
                      const std::string          &word,
                      const std::string          &unit,
                      const std::string          &text,
                      const PatternBase          &pattern,
                      const std::optional<double> old_value)
  {
    const std::string  path = owner.path_of(entry);
    const WordOrNumber either(word, old_value, ProfilePattern(pattern));
    const std::shared_ptr<const PatternBase> number = pattern.clone();
    return add_entry(
      owner,
      entry,
      word,
      unit,
      text,
      either,
      [&profile, path, word, number](const std::string &setting) {
        profile.reset();
        if (setting == word || !ProfilePattern(*number).match(setting))
          return;
        profile = std::make_unique<Profile>(0., *number);
        profile->set(setting, path);
      });
  }
} // namespace CaissonMPM
