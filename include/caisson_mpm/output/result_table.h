// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a body felt on its way down or up, at depths: the numbers of the
// terminal and of run.json.
#ifndef caisson_mpm_output_result_table_h
#define caisson_mpm_output_result_table_h

#include <caisson_mpm/base/named_numbers.h>
#include <caisson_mpm/output/records.h>

#include <optional>
#include <string>
#include <vector>

namespace CaissonMPM
{
  /** What the results are compared with, where a scene has it. */
  struct ResultLimits
  {
    std::optional<double> skirt_length; // m
    std::optional<double> pump;         // largest suction, Pa
  };

  /**
   * Columns over the penetration, from the records that are deeper than all
   * before them, or on the way up less deep than all since the deepest.
   *
   * Every number is a mean over a window: 0.2 m of penetration, or a quarter of
   * the way where that is less. It is that of the records in the window about a
   * depth. A window that would reach beyond an end of the way begins or ends
   * there, and a straight line of least squares through its records gives the
   * value at the depth. With fewer than three records in it, the value lies on
   * the line between the two records around. python/caisson/curves.py
   * takes the means of curves in the same way, and a test compares them.
   */
  class ResultTable
  {
  public:
    enum class Direction
    {
      down,
      up
    };

    /** A shorter way up says nothing. Units: m. */
    static constexpr double least_rise = 1e-3;

    /** The records need the columns of forces and penetration. */
    ResultTable(const Records      &records,
                const Direction     direction,
                const ResultLimits &limits = {});

    /** Whether there is no way. */
    bool
    is_empty() const
    {
      return position.size() < 2;
    }

    /** Units: m. */
    double
    length() const
    {
      return position.back() - position.front();
    }

    bool
    has(const std::string &name) const;

    /** The column of the force that the body feels: with water, where that
     * bears. */
    std::string
    total() const;

    /** A column that has() found. [n_records] */
    const std::vector<double> &
    values(const std::string &name) const;

    /** The mean of a column at a depth. Units: m. */
    double
    mean(const std::vector<double> &values, const double depth) const;

    /** All columns at a depth. Units: m. */
    NamedNumbers
    at(const double depth) const;

    /** Each half meter of the way, or smaller steps of a short one, of a long
     * one only each second, fourth, ... where there would be more than @p most
     * steps; on the way down also the end. Units: m. */
    std::vector<double>
    depths(const unsigned int most = 1000) const;

    /** The depth at which the way ends. Units: m. */
    double
    end() const;

    struct Place
    {
      double value, depth;
    };

    /** The largest mean of a column, and its depth. */
    Place
    largest(const std::vector<double> &values) const;

  private:
    /** Add gradients over the critical one, and the room below the lid. */
    void
    add_lid(const std::vector<double>   &wall,
            const std::vector<double>   &axis,
            const std::vector<double>   &critical,
            const std::optional<double> &skirt_length);

    std::vector<double> position; // growing depth or height, [n_records], m
    double              sign;     // of a depth in it
    std::vector<std::pair<std::string, std::vector<double>>> columns;
  };
} // namespace CaissonMPM

#endif
