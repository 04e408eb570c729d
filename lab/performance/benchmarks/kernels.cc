// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How fast the kernels are on their own: Mohr-Coulomb sand under its weight in
// a block of square cells, the points in order, at rest or sheared so that it
// yields. For each instruction set of this CPU, each number of points per cell
// and direction and both rates of shear, lines
//   instruction set, points, points per cell, shear rate, kernel, million
//   points per second
// with the best of several repetitions. Two rows name what bounds the kernels
// (limits.h): "stream" the points of which the fields come and go, and
// "multiply_and_add" million multiplications per second, each with an addition.
//
// Usage: kernel_benchmark [POINTS [REPETITIONS]]
#include <caisson_mpm/kernels/dispatch.h>
#include <caisson_mpm/kernels/laws.h>
#include <caisson_mpm/kernels/layout.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <vector>

#include "limits.h"

namespace
{
  using namespace CaissonMPM::Kernels;

  constexpr double friction_angle = 30., density = 1900., gravity = 9.81,
                   cell_size = .1, K0 = .5;

  /** A column of soil 50 cells wide with its blocks, as MaterialPoints lays
   * them out. */
  struct Soil
  {
    std::vector<CellGeometry>   geometry;
    std::vector<CellNodes>      nodes;
    std::vector<unsigned char>  flags;
    std::vector<int>            neighbors, first_block;
    std::vector<unsigned int>   active;
    std::vector<double>         filled;
    std::vector<unsigned char>  changed;
    std::vector<unsigned short> n_yielding;
    std::vector<PointBlock>     blocks;
    std::vector<PointHistory>   histories;
    std::vector<BlockHeader>    headers;
    std::vector<int>            next;
    Material                    material = {};
    unsigned int                n_nodes = 0, n_points = 0;

    Soil(const unsigned int wanted, const unsigned int per_direction)
    {
      const unsigned int n = per_direction * per_direction, n_columns = 50,
                         n_rows = std::max(1u, wanted / n / n_columns);
      n_nodes                   = (n_columns + 1) * (n_rows + 1);
      n_points                  = n_columns * n_rows * n;
      neighbors.assign(neighbors_per_cell * n_columns * n_rows, -1);
      for (unsigned int j = 0; j < n_rows; ++j)
        for (unsigned int i = 0; i < n_columns; ++i)
          add_cell(i, j, n_columns, n_rows, per_direction);
      flags.assign(active.size(), 0);
      changed.assign(active.size(), 1);
      n_yielding.assign(active.size(), 0);
      material.body_force[1] = -gravity;
      const double values[]  = {5e6, .3, friction_angle, 0., 0., 0., no_limit};
      const auto   soil      = read_parameters<MohrCoulomb>(values);
      set_law<MohrCoulomb>(material, soil);
      material.p_wave_modulus = soil.p_wave_modulus();
    }

    void
    add_cell(const unsigned int i,
             const unsigned int j,
             const unsigned int n_columns,
             const unsigned int n_rows,
             const unsigned int n)
    {
      const double       h = cell_size, left = 1. + i * h, bottom = j * h;
      const unsigned int node = j * (n_columns + 1) + i;
      geometry.push_back({left, h, bottom, bottom, h, h});
      nodes.push_back(
        {{node, node + 1, node + n_columns + 1, node + n_columns + 2}});
      active.push_back(active.size());
      filled.push_back(0.);
      for (unsigned int k = 0; k < n * n; ++k)
        {
          if (k % block_size == 0)
            {
              const int block        = blocks.size();
              (k == 0 ? (first_block.push_back(block), first_block.back()) :
                        next.back()) = block;
              blocks.emplace_back();
              histories.emplace_back();
              headers.push_back({0., 0.});
              next.push_back(-1);
            }
          PointBlock  &b    = blocks.back();
          const double r    = left + h * (k % n + .5) / n,
                       z    = bottom + h * (k / n + .5) / n;
          const double zz   = -density * gravity * (n_rows * h - z);
          const int    lane = static_cast<int>(headers.back().count++);
          for (int l = lane; l < block_size; ++l)
            {
              const bool real = l == lane;
              b.r[l]          = r;
              b.z[l]          = z;
              b.stress[0][l] = b.stress[2][l] = K0 * zz;
              b.stress[1][l]                  = zz;
              b.volume[l]                     = real ? r * h * h / (n * n) : 0.;
              b.mass[l]                       = density * b.volume[l];
              histories.back().initial_volume[l] = b.volume[l];
            }
          filled.back() += b.volume[lane];
        }
    }

    GridView
    grid() const
    {
      return {
        geometry.data(), nodes.data(), flags.data(), neighbors.data(), 1.};
    }

    PointsView
    view()
    {
      return {blocks.data(),
              histories.data(),
              headers.data(),
              next.data(),
              first_block.data(),
              active.data(),
              static_cast<unsigned int>(active.size()),
              filled.data(),
              changed.data(),
              n_yielding.data()};
    }
  };

  double
  best_time(const unsigned int repetitions, const std::function<void()> &action)
  {
    double best = 1e300;
    for (unsigned int i = 0; i < repetitions; ++i)
      {
        const auto start = std::chrono::steady_clock::now();
        action();
        best = std::min(best,
                        std::chrono::duration<double>(
                          std::chrono::steady_clock::now() - start)
                          .count());
      }
    return best;
  }

  void
  measure(const char        *instruction_set,
          const unsigned int wanted,
          const unsigned int per_direction,
          const unsigned int repetitions,
          const double       shear_rate)
  {
    const KernelTable *const kernels = select_kernels(instruction_set);
    if (kernels == nullptr)
      return;
    Soil                      s(wanted, per_direction);
    std::vector<NodalSums>    sums(s.n_nodes, NodalSums());
    std::vector<CellMoments>  moments(s.active.size());
    std::vector<NodalVector>  rest(s.n_nodes), v(s.n_nodes), out(s.n_nodes);
    std::vector<LeavingPoint> leaving(s.n_points);
    UpdateResult              result = {leaving.data(), s.n_points, 0, 0, 0.};
    for (unsigned int c = 0; c < s.active.size(); ++c)
      for (int k = 0; k < 4; ++k)
        {
          const double z = s.geometry[c].bottom_left + (k / 2) * cell_size;
          v[s.nodes[c].node[k]] = {{shear_rate * z, 0.}};
        }
    const std::vector<double> filled_at_node(s.nodes.size() * 4, 1.);
    const StepContext         step = {s.view(),
                                      s.grid(),
                                      &s.material,
                                      {.9, .5, true, PressureSlope::acts},
                                      moments.data(),
                                      filled_at_node.data()};
    // the points stay where they are, and their stresses change
    const PointUpdate update = {s.grid(),
                                {1e-6, .9, true, 0., .01},
                                {rest.data(), rest.data(), v.data()}};

    const double to_grid   = best_time(repetitions, [&]() {
      kernels->points_to_grid(step, sums.data());
    });
    const double mass      = best_time(repetitions, [&]() {
      kernels->apply_mass(step, v.data(), out.data());
    });
    const double to_points = best_time(repetitions, [&]() {
      kernels->grid_to_points(step, update, result);
    });
    const auto   print     = [&](const char *kernel, const double seconds) {
      std::printf("%s,%u,%u,%g,%s,%.2f\n",
                  instruction_set,
                  s.n_points,
                  per_direction * per_direction,
                  shear_rate,
                  kernel,
                  1e-6 * s.n_points / seconds);
    };
    print("points_to_grid", to_grid);
    print("apply_mass", mass);
    print("grid_to_points", to_points);
    print("both_transfers", to_grid + to_points);
    print("stream", best_time(repetitions, [&]() {
            limits_of(instruction_set).stream(s.blocks.data(), s.blocks.size());
          }));
  }

  void
  measure_arithmetic(const char        *instruction_set,
                     const unsigned int repetitions)
  {
    if (select_kernels(instruction_set) == nullptr)
      return;
    constexpr unsigned long n       = 10000000;
    volatile double         result  = 0.; // or nothing would be computed
    const double            seconds = best_time(repetitions, [&]() {
      result = limits_of(instruction_set).multiply_and_add(n);
    });
    std::printf("%s,0,0,0,multiply_and_add,%.2f\n",
                instruction_set,
                1e-6 * n / seconds);
  }
} // namespace

const Limits &
CaissonMPM::Kernels::limits_of(const char *instruction_set)
{
#ifdef CAISSON_X86_64
  return std::strcmp(instruction_set, "SSE2") == 0 ? limits_x86_64() :
         std::strcmp(instruction_set, "AVX2") == 0 ? limits_x86_64_v3() :
                                                     limits_x86_64_v4();
#else
  return limits_generic();
#endif
}

int
main(const int argc, char **argv)
{
  const unsigned int points      = argc > 1 ? std::atoi(argv[1]) : 50000,
                     repetitions = argc > 2 ? std::atoi(argv[2]) : 100;
  std::printf("instruction_set,points,points_per_cell,shear_rate_per_s,kernel,"
              "million_points_per_s\n");
  for (const char *const set : {"SSE2", "AVX2", "AVX-512", "generic"})
    {
      for (const unsigned int per_direction : {2, 3, 4, 5})
        for (const double rate : {0., 1e4})
          measure(set, points, per_direction, repetitions, rate);
      measure_arithmetic(set, repetitions);
    }
}
