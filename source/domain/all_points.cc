// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/all_points.h>
#include <caisson_mpm/domain/point_fields.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  AllPoints::AllPoints(const MaterialPoints    &points,
                       const std::vector<bool> &total,
                       const MPI_Comm           communicator)
    : points(points)
    , total(total)
    , on_one_rank(Utilities::MPI::n_mpi_processes(communicator) == 1)
  {
    if (on_one_rank)
      return;
    const unsigned int  n = points.n_user_state();
    std::vector<double> own;
    own.reserve(std::size_t(points.n_points()) * n_numbers(n));
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      append_numbers(p, own);
    });
    for (const auto &message : Utilities::MPI::gather(communicator, own))
      for (std::size_t i = 0; i < message.size(); i += n_numbers(n))
        gathered.push_back(point_of_numbers(message.data() + i, n));
    std::sort(gathered.begin(),
              gathered.end(),
              [](const MaterialPoint &a, const MaterialPoint &b) {
                return a.id < b.id;
              });
  }
} // namespace CaissonMPM
