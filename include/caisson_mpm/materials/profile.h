// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Numbers of the soil that may change with depth.
#ifndef caisson_mpm_materials_profile_h
#define caisson_mpm_materials_profile_h

#include <caisson_mpm/base/section.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/patterns.h>

#include <memory>
#include <optional>
#include <string>

namespace CaissonMPM
{
  /** Where a profile is evaluated: the depth below the soil surface (m) and the
   * effective stresses there at the start (Pa, positive in compression). */
  struct PlaceInGround
  {
    double depth, vertical_stress, mean_stress;
  };

  /**
   * A number, or an expression in the depth d, the vertical effective stress s
   * and the mean effective stress p at the start, for instance "10e3 + 1.5e3*d"
   * or "60e6*(p/100e3)^0.5".
   */
  class Profile
  {
  public:
    /** A number of an entry that allows what @p pattern does. */
    explicit Profile(const double                         number,
                     const dealii::Patterns::PatternBase &pattern);

    /** Set it to the text of @p entry, the whole path of the entry. Throws
     * BadInput if that cannot be parsed. */
    void
    set(const std::string &text, const std::string &entry);

    /** "Entry = text". */
    std::string
    name() const
    {
      return entry + " = " + text;
    }

    bool
    is_constant() const
    {
      return function == nullptr;
    }

    /** Whether it has one of these variables. */
    bool
    depends_on(const std::string &letters) const;

    /** Whether it depends on the stress. */
    bool
    knows_stress() const
    {
      return depends_on("sp");
    }

    /** Return the value, whatever it is. */
    double
    unchecked(const PlaceInGround &place) const;

    /** Return the value. Throws BadInput if the entry does not allow it. */
    double
    operator()(const PlaceInGround &place) const;

    const dealii::Patterns::PatternBase &
    number_pattern() const
    {
      return *pattern;
    }

  private:
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
    std::string                                          text, entry;
    double                                               number;
    std::unique_ptr<dealii::FunctionParser<3>>           function;
  };

  /** What the text of a profile may be: a number, or what looks like an
   * expression. */
  class ProfilePattern : public dealii::Patterns::PatternBase
  {
  public:
    /** @p number is what numbers may be. */
    explicit ProfilePattern(const dealii::Patterns::PatternBase &number);

    bool
    match(const std::string &text) const override;

    /** In words, in any style. */
    std::string
    description(const OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

  private:
    std::shared_ptr<const dealii::Patterns::PatternBase> number;
  };

  /** Declare an entry that sets @p profile, a member of @p owner; its default
   * is the number that it has now. */
  EntryRecord &
  add_profile(Section           &owner,
              const std::string &entry,
              Profile           &profile,
              const std::string &unit,
              const std::string &text);

  /** The same, for an entry that may also read @p word: then there is no
   * profile, and so it is by default. @p old_value: see WordOrNumber. */
  EntryRecord &
  add_word_or_profile(Section                             &owner,
                      const std::string                   &entry,
                      std::unique_ptr<Profile>            &profile,
                      const std::string                   &word,
                      const std::string                   &unit,
                      const std::string                   &text,
                      const dealii::Patterns::PatternBase &pattern,
                      const std::optional<double>          old_value = {});
} // namespace CaissonMPM

#endif
