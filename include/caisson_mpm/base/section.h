// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A section of the parameters, and what its owner says of each entry where it
// declares it.
#ifndef caisson_mpm_base_section_h
#define caisson_mpm_base_section_h

#include <caisson_mpm/base/declared_entries.h>
#include <caisson_mpm/base/parameter_origins.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * A ParameterAcceptor that keeps a record of each entry that it declares,
   * with add_parameter() here or with the functions of choice.h. Where one of
   * several objects is chosen, name_entries_of_others() then finds what the
   * user has set for the others, without a list that somebody must keep.
   */
  class Section : public dealii::ParameterAcceptor
  {
  public:
    /** All entries have this influence but those whose record says else. */
    explicit Section(const std::string &name,
                     const Influence    influence = Influence::ground)
      : ParameterAcceptor(name)
      , influence(influence)
    {}

    Section(const Section &) = delete;

    /** The records of its entries go with it. */
    ~Section() override;

    /**
     * Declare an entry that sets @p value, whose present value is the default.
     *
     * @code
     * add_parameter("Time step", step, "s", "The largest step.",
     *               Patterns::Double(0.)).influence = Influence::motion;
     * @endcode
     */
    template <typename Value>
    EntryRecord &
    add_parameter(const std::string                   &entry,
                  Value                               &value,
                  const std::string                   &unit,
                  const std::string                   &text,
                  const dealii::Patterns::PatternBase &pattern =
                    *dealii::Patterns::Tools::Convert<Value>::to_pattern())
    {
      ParameterAcceptor::add_parameter(entry, value, text, prm, pattern);
      return record(entry, unit, text, pattern);
    }

    /** Keep the record of an entry that has been declared in the present
     * subsection. */
    EntryRecord &
    record(const std::string                   &entry,
           const std::string                   &unit,
           const std::string                   &text,
           const dealii::Patterns::PatternBase &pattern);

    /** The path of an entry in the present subsection. */
    std::string
    path_of(const std::string &entry) const;

    /** The paths of the entries declared so far. */
    const std::vector<std::string> &
    entries() const
    {
      return entries_;
    }

    /** Report which of the entries have no effect in their present state. */
    virtual void
    name_unused_entries(ParameterOrigins & /*origins*/) const
    {}

  private:
    Influence                influence;
    std::vector<std::string> entries_;
  };

  /** One of several objects among which an entry chooses by the name. */
  class Alternative : public Section
  {
  public:
    /** @p description says in a few words what the object is, for the text of
     * the entry that chooses. */
    Alternative(const std::string &section,
                const Influence    influence,
                const std::string &name,
                const std::string &description)
      : Section(section, influence)
      , name(name)
      , description(description)
    {}

    /** Throw BadInput where the entries of the chosen object contradict each
     * other. */
    virtual void
    check_parameters() const
    {}

    const std::string name, description;
  };

  /** Name the entries of @p others that the chosen section does not have. */
  template <typename Pointers>
  void
  name_entries_of_others(ParameterOrigins  &origins,
                         const Section     &chosen,
                         const Pointers    &others,
                         const std::string &reason)
  {
    std::vector<std::string> unused;
    for (const auto &other : others)
      for (const std::string &entry : other->entries())
        {
          bool is_used = false;
          for (const std::string &used : chosen.entries())
            is_used = is_used || used == entry;
          if (!is_used)
            unused.push_back(entry);
        }
    origins.add_unused(unused, reason);
  }
} // namespace CaissonMPM

#endif
