// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What ranks send each other of material points: those that move to a cell
// of another rank, and which cells at the border have points.
#ifndef caisson_mpm_domain_point_exchange_h
#define caisson_mpm_domain_point_exchange_h

#include <caisson_mpm/domain/background_grid.h>
#include <caisson_mpm/domain/material_point.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <vector>

namespace CaissonMPM
{
  /** A point on its way to the rank that owns its cell. */
  struct TravelingPoint
  {
    GlobalCell    cell;
    MaterialPoint point;
  };

  /**
   * The messages between ranks whose cells touch. In each step every rank sends
   * one message of either kind to each of its neighbors, even an empty one, so
   * that no rank has to ask how many there are. Collective among neighbors.
   */
  class PointExchange
  {
  public:
    /** Find the neighbors and the cells at the border to them. */
    void
    set_up(const BackgroundGrid &grid);

    /** Send each neighbor its points, and return those for this rank. */
    std::vector<TravelingPoint>
    exchange(
      const std::map<unsigned int, std::vector<TravelingPoint>> &abroad) const;

    /**
     * Tell the neighbors which cells at the border have points: those whose
     * @p first_block [n_cells] is not negative. For a ghost cell of this rank
     * it becomes only a flag: 0 = its owner has points there, -1 = none.
     */
    void
    update_occupied(std::vector<int> &first_block);

  private:
    struct Neighbor
    {
      unsigned int rank;
      /** Own cells that are ghost cells there, and ghost cells that it owns, by
       * local number, in the order of the global ones. */
      std::vector<unsigned int> own, ghost;
      std::vector<char>         own_occupied, ghost_occupied; // the messages
    };

    MPI_Comm              communicator = MPI_COMM_SELF;
    std::vector<Neighbor> neighbors;
  };

  /** Send points to the owners of their cells, wherever these are, and return
   * those for this rank. Collective. */
  std::vector<TravelingPoint>
  send_to_owners(const BackgroundGrid              &grid,
                 const std::vector<TravelingPoint> &points);
} // namespace CaissonMPM

#endif
