// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of what a run sums up and what it must remember: counters, works,
// impulses, times.
#ifndef caisson_mpm_base_run_totals_h
#define caisson_mpm_base_run_totals_h

#include <caisson_mpm/base/named_numbers.h>

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /**
   * The owner of a number registers it once, by its name; the records,
   * run.json, the checkpoint and the sums over the ranks read the table. A
   * number stays where it is, and must outlive the table.
   *
   * There are two kinds. Of a sum, each rank adds up its own part, and after
   * bring_to_first_rank() the first rank has the parts of all and the others
   * have zero, so that they can go on adding. A state is the same on all ranks.
   *
   * @code
   * totals.count("limiter_count", n_limited);
   * @endcode
   */
  class RunTotals
  {
  public:
    /** Register a sum that has a column of its own in history.csv, an entry in
     * run.json, and continues after a restart. */
    template <typename Number>
    void
    count(const std::string &name, Number &value)
    {
      add(name, value, Kind::count);
    }

    /** Register a sum that continues after a restart. */
    template <typename Number>
    void
    sum(const std::string &name, Number &value)
    {
      add(name, value, Kind::sum);
    }

    /** Register a state that continues after a restart. */
    template <typename Number>
    void
    keep(const std::string &name, Number &value)
    {
      add(name, value, Kind::state);
    }

    /** Register a state that continues after a restart, and in a run that goes
     * on after this one with another motion. */
    template <typename Number>
    void
    carry(const std::string &name, Number &value)
    {
      add(name, value, Kind::carried_state);
    }

    /** The names of the counts, in the order of their registration. */
    std::vector<std::string>
    count_names() const;

    /** The counts; of all ranks on the first one after bring_to_first_rank().
     */
    NamedNumbers
    counts() const;

    /** Move the sums of all ranks to the first one. Collective. */
    void
    bring_to_first_rank(const MPI_Comm communicator);

    /** All numbers, for a checkpoint. */
    NamedNumbers
    state() const;

    /**
     * Set all numbers to those of a checkpoint; the sums are given to the first
     * rank. Returns the name of the first one that @p state lacks, else an
     * empty text. Every rank passes the same state; not collective.
     */
    std::string
    resume(const NamedNumbers &state, const bool is_first_rank);

    /** Set what carry() has registered to the values in the checkpoint of
     * another run, as far as it has them; all else starts from its initial
     * value. Every rank passes the same state; not collective. */
    void
    take_over(const NamedNumbers &state);

  private:
    enum class Kind
    {
      count,
      sum,
      state,
      carried_state
    };

    struct Total
    {
      bool
      is_sum() const
      {
        return kind == Kind::count || kind == Kind::sum;
      }

      std::string                 name;
      Kind                        kind;
      std::function<double()>     get;
      std::function<void(double)> set;
    };

    template <typename Number>
    void
    add(const std::string &name, Number &value, const Kind kind)
    {
      insert({name,
              kind,
              [&value]() { return static_cast<double>(value); },
              [&value](const double x) { value = static_cast<Number>(x); }});
    }

    void
    insert(const Total &total);

    /** Keep what a plug has registered, where this run has none, as in a pull
     * without a lid: it goes on in the runs that follow. */
    void
    pass_on(const NamedNumbers &state);

    std::vector<Total> totals;
    NamedNumbers       of_plug;
  };
} // namespace CaissonMPM

#endif
