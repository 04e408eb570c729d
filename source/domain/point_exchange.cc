// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/domain/point_exchange.h>
#include <caisson_mpm/domain/point_fields.h>

#include <set>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr int tag_of_points = 411, tag_of_cells = 412;

    /** The points as numbers: how many a user's law keeps of each, and a row
     * for each point, which begins with its cell. Empty if there is none. */
    std::vector<double>
    to_numbers(const std::vector<TravelingPoint> &points)
    {
      if (points.empty())
        return {};
      const unsigned int  n = points.front().point.user_state.size();
      std::vector<double> message;
      message.reserve(1 + points.size() * (1 + n_numbers(n)));
      message.push_back(n);
      for (const TravelingPoint &p : points)
        {
          message.push_back(index_of(p.cell));
          append_numbers(p.point, message);
        }
      return message;
    }

    /** Append the points of a message. */
    void
    append_points(const std::vector<double>   &message,
                  std::vector<TravelingPoint> &points)
    {
      if (message.empty())
        return;
      const auto        n     = static_cast<unsigned int>(message[0]);
      const std::size_t width = 1 + n_numbers(n);
      points.reserve(points.size() + message.size() / width);
      for (std::size_t i = 1; i < message.size(); i += width)
        points.push_back({GlobalCell(static_cast<unsigned int>(message[i])),
                          point_of_numbers(message.data() + i + 1, n)});
    }

    void
    wait_for(std::vector<MPI_Request> &requests)
    {
      const int error =
        MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
      AssertThrowMPI(error);
    }

    void
    receive_points(const MPI_Comm               communicator,
                   const unsigned int           rank,
                   std::vector<TravelingPoint> &points)
    {
      MPI_Status status;
      int        error = MPI_Probe(rank, tag_of_points, communicator, &status);
      AssertThrowMPI(error);
      int n = 0;
      error = MPI_Get_count(&status, MPI_DOUBLE, &n);
      AssertThrowMPI(error);
      std::vector<double> message(n);
      error = MPI_Recv(message.data(),
                       n,
                       MPI_DOUBLE,
                       rank,
                       tag_of_points,
                       communicator,
                       MPI_STATUS_IGNORE);
      AssertThrowMPI(error);
      append_points(message, points);
    }
  } // namespace

  void
  PointExchange::set_up(const BackgroundGrid &grid)
  {
    communicator = grid.communicator();
    // cells touch where they share a node
    std::vector<std::set<unsigned int>>               ranks_at(grid.n_nodes());
    std::map<unsigned int, std::vector<unsigned int>> own, ghost;
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (!grid.is_owned(cell))
        {
          ghost[grid.owner_of(cell)].push_back(cell);
          for (const unsigned int node : grid.cell_nodes(cell).node)
            ranks_at[node].insert(grid.owner_of(cell));
        }
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        {
          std::set<unsigned int> ranks;
          for (const unsigned int node : grid.cell_nodes(cell).node)
            ranks.insert(ranks_at[node].begin(), ranks_at[node].end());
          for (const unsigned int rank : ranks)
            own[rank].push_back(cell);
        }
    neighbors.clear();
    for (const auto &[rank, cells] : ghost)
      neighbors.push_back({rank,
                           own[rank],
                           cells,
                           std::vector<char>(own[rank].size()),
                           std::vector<char>(cells.size())});
  }

  std::vector<TravelingPoint>
  PointExchange::exchange(
    const std::map<unsigned int, std::vector<TravelingPoint>> &abroad) const
  {
    std::vector<std::vector<double>> messages; // until all have been sent
    std::vector<MPI_Request>         requests;
    messages.reserve(neighbors.size());
    for (const Neighbor &neighbor : neighbors)
      {
        const auto found = abroad.find(neighbor.rank);
        messages.push_back(found == abroad.end() ? std::vector<double>() :
                                                   to_numbers(found->second));
        requests.emplace_back();
        const int error = MPI_Isend(messages.back().data(),
                                    messages.back().size(),
                                    MPI_DOUBLE,
                                    neighbor.rank,
                                    tag_of_points,
                                    communicator,
                                    &requests.back());
        AssertThrowMPI(error);
      }
    std::vector<TravelingPoint> received;
    for (const Neighbor &neighbor : neighbors)
      receive_points(communicator, neighbor.rank, received);
    wait_for(requests);
    return received;
  }

  void
  PointExchange::update_occupied(std::vector<int> &first_block)
  {
    std::vector<MPI_Request> requests;
    for (Neighbor &neighbor : neighbors)
      {
        for (std::size_t i = 0; i < neighbor.own.size(); ++i)
          neighbor.own_occupied[i] = first_block[neighbor.own[i]] >= 0;
        requests.emplace_back();
        int error = MPI_Irecv(neighbor.ghost_occupied.data(),
                              neighbor.ghost_occupied.size(),
                              MPI_CHAR,
                              neighbor.rank,
                              tag_of_cells,
                              communicator,
                              &requests.back());
        AssertThrowMPI(error);
        requests.emplace_back();
        error = MPI_Isend(neighbor.own_occupied.data(),
                          neighbor.own_occupied.size(),
                          MPI_CHAR,
                          neighbor.rank,
                          tag_of_cells,
                          communicator,
                          &requests.back());
        AssertThrowMPI(error);
      }
    wait_for(requests);
    for (const Neighbor &neighbor : neighbors)
      for (std::size_t i = 0; i < neighbor.ghost.size(); ++i)
        first_block[neighbor.ghost[i]] = neighbor.ghost_occupied[i] ? 0 : -1;
  }

  std::vector<TravelingPoint>
  send_to_owners(const BackgroundGrid              &grid,
                 const std::vector<TravelingPoint> &points)
  {
    std::vector<unsigned int> owners(grid.n_global_cells(), 0);
    for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
      if (grid.is_owned(cell))
        owners[index_of(grid.global_number(cell))] = grid.owner_of(cell);
    Utilities::MPI::max(owners, grid.communicator(), owners);
    std::map<unsigned int, std::vector<TravelingPoint>> by_rank;
    for (const TravelingPoint &p : points)
      by_rank[owners[index_of(p.cell)]].push_back(p);
    std::map<unsigned int, std::vector<double>> messages;
    for (const auto &[rank, some] : by_rank)
      messages[rank] = to_numbers(some);
    std::vector<TravelingPoint> received;
    for (const auto &[rank, message] :
         Utilities::MPI::some_to_some(grid.communicator(), messages))
      append_points(message, received);
    return received;
  }
} // namespace CaissonMPM
