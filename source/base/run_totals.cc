// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/run_totals.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>

namespace CaissonMPM
{
  void
  RunTotals::insert(const Total &total)
  {
    Assert(std::none_of(totals.begin(),
                        totals.end(),
                        [&](const Total &t) { return t.name == total.name; }),
           dealii::ExcMessage(total.name + " is registered twice"));
    totals.push_back(total);
  }

  std::vector<std::string>
  RunTotals::count_names() const
  {
    std::vector<std::string> names;
    for (const Total &total : totals)
      if (total.kind == Kind::count)
        names.push_back(total.name);
    return names;
  }

  NamedNumbers
  RunTotals::counts() const
  {
    NamedNumbers result;
    for (const Total &total : totals)
      if (total.kind == Kind::count)
        result.emplace_back(total.name, total.get());
    return result;
  }

  void
  RunTotals::bring_to_first_rank(const MPI_Comm communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    std::vector<double> values;
    for (const Total &total : totals)
      if (total.is_sum())
        values.push_back(total.get());
    dealii::Utilities::MPI::sum(values, communicator, values);
    const bool is_first =
      dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    auto value = values.begin();
    for (const Total &total : totals)
      if (total.is_sum())
        total.set(is_first ? *value++ : 0.);
  }

  NamedNumbers
  RunTotals::state() const
  {
    NamedNumbers result = of_plug;
    for (const Total &total : totals)
      result.emplace_back(total.name, total.get());
    return result;
  }

  void
  RunTotals::pass_on(const NamedNumbers &state)
  {
    const auto is_registered = [this](const std::string &name) {
      return std::any_of(totals.begin(), totals.end(), [&](const Total &total) {
        return total.name == name;
      });
    };
    of_plug.clear();
    for (const auto &[name, value] : state)
      if (boost::starts_with(name, "plug_") && !is_registered(name))
        of_plug.emplace_back(name, value);
  }

  std::string
  RunTotals::resume(const NamedNumbers &state, const bool is_first_rank)
  {
    for (const Total &total : totals)
      {
        const auto value = number_named(total.name, state);
        if (!value)
          return total.name;
        total.set(total.is_sum() && !is_first_rank ? 0. : *value);
      }
    pass_on(state);
    return "";
  }

  void
  RunTotals::take_over(const NamedNumbers &state)
  {
    for (const Total &total : totals)
      if (total.kind == Kind::carried_state)
        if (const auto value = number_named(total.name, state))
          total.set(*value);
    pass_on(state);
  }
} // namespace CaissonMPM
