// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/bytes.h>
#include <caisson_mpm/domain/all_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace CaissonMPM
{
  using namespace dealii;

  AllPoints::AllPoints(const MaterialPoints &points,
                       const MPI_Comm        communicator)
    : points(points)
    , on_one_rank(Utilities::MPI::n_mpi_processes(communicator) == 1)
  {
    if (on_one_rank)
      return;
    std::vector<MaterialPoint> own;
    points.for_each(
      [&](const MaterialPoint &p, const unsigned int) { own.push_back(p); });
    for (const auto &message :
         Utilities::MPI::gather(communicator, to_bytes(own)))
      append_bytes(gathered, message);
    std::sort(gathered.begin(),
              gathered.end(),
              [](const MaterialPoint &a, const MaterialPoint &b) {
                return a.id < b.id;
              });
  }
} // namespace CaissonMPM
