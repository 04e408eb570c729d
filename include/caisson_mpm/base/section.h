// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A section of the parameters whose owner is one of several to choose from.
#ifndef caisson_mpm_base_section_h
#define caisson_mpm_base_section_h

#include <caisson_mpm/base/parameter_origins.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  /**
   * A ParameterAcceptor that remembers which entries it declares, with
   * add_parameter() here or with the functions of choice.h. Where one of
   * several objects is chosen, name_entries_of_others() then finds what the
   * user has set for the others, without a list that somebody must keep.
   */
  class Section : public dealii::ParameterAcceptor
  {
  public:
    explicit Section(const std::string &name)
      : ParameterAcceptor(name)
    {}

    /** Declare an entry, as ParameterAcceptor does. */
    template <typename... Arguments>
    void
    add_parameter(const std::string &entry, Arguments &&...arguments)
    {
      remember(entry);
      ParameterAcceptor::add_parameter(entry,
                                       std::forward<Arguments>(arguments)...);
    }

    void
    remember(const std::string &entry)
    {
      entries_.push_back(get_section_name().substr(1) + "/" + entry);
    }

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
    std::vector<std::string> entries_;
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
