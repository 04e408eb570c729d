// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The file of points of a checkpoint: parts of it, its columns and checksum,
// and what is refused.
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <vector>

#include "saved_scene.h"

/** A file of points on its own. */
void
check_point_file(const Scene &s)
{
  std::vector<TravelingPoint> points;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
    if (points.size() < 10)
      points.push_back({s.grid.global_number(cell), p});
  });
  const auto write = [&](const std::string  &name,
                         const unsigned long n,
                         const unsigned long first) {
    PointFile file(path(name), PointFile::Access::create, n, MPI_COMM_SELF);
    file.write(first, points);
    return std::make_pair(file.close(), file.checksum());
  };
  const auto read = [&](const std::string &name, const unsigned long n) {
    PointFile file(path(name), PointFile::Access::read, n, MPI_COMM_SELF);
    file.read(0, 3);
    file.read(3, n - 3);
    return std::make_pair(file.close(), file.checksum());
  };
  const auto written = write("points.h5", 10, 0);
  std::printf("written and read in parts: %s\n",
              written.first && read("points.h5", 10) == written ? "yes" : "no");
  const std::string text = read_text(path("points.h5"));
  std::printf("columns are named: %s\n",
              text.find("cell material position_r position_z velocity_r") !=
                  std::string::npos ?
                "yes" :
                "no");
  std::printf("more rows than it has: %s\n",
              read("points.h5", 11).first ? "read" : "refused");
  std::printf("beyond the end: %s\n",
              write("other.h5", 10, 1).first ? "written" : "refused");
  const auto late = write("other.h5", 12, 2);
  std::printf("rows that were not written: %s\n",
              late.first && read("other.h5", 12).second == late.second ?
                "not noticed" :
                "noticed");
  std::printf("another place, the same checksum: %s\n",
              late.second == written.second ? "yes" : "no");
  std::printf("no such file: %s\n",
              read("none.h5", 10).first ? "read" : "refused");
  std::printf("no such directory: %s\n",
              write("none/points.h5", 10, 0).first ? "written" : "refused");
}



int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::filesystem::remove_all(directory);
  std::filesystem::create_directory(directory);
  Scene s(box("1"));
  generate(s);
  heading("file of points");
  check_point_file(s);
}
