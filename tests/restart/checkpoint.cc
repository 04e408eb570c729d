// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checkpoints: every digit of the points comes back, in the same order; damage
// and a file that cannot be written are noticed, and what was there is kept.
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/restart/checkpoint.h>
#include <caisson_mpm/restart/point_file.h>

#include <deal.II/base/mpi.h>

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

#include "saved_scene.h"

const std::string              parameters = "a = 1\nb = 2\n";
const std::vector<std::string> warnings   = {"file x y", "state", ""};

std::vector<std::vector<double>>
numbers_of(const Scene &s)
{
  std::vector<std::vector<double>> result;
  s.points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
    std::vector<double> n = {static_cast<double>(
                               index_of(s.grid.global_number(cell))),
                             p.id,
                             static_cast<double>(p.material),
                             p.position[0],
                             p.position[1],
                             p.velocity[0],
                             p.velocity[1],
                             p.mass,
                             p.volume,
                             p.plastic_deviatoric,
                             p.plastic_volumetric,
                             p.initial_position[0],
                             p.initial_position[1],
                             p.initial_volume,
                             p.size[0],
                             p.size[1]};
    n.insert(n.end(), p.stress.begin(), p.stress.end());
    n.insert(n.end(), p.state.begin(), p.state.end());
    result.push_back(n);
  });
  return result;
}

std::string
valid_file()
{
  const std::string text  = read_text(path("checkpoint.info")),
                    entry = "\nfile ";
  const auto begin        = text.find(entry) + entry.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

/** What reading leads to: "read", or the message. */
std::string
read(Scene &s, const std::string &current = parameters)
{
  try
    {
      const Checkpoint checkpoint(directory);
      checkpoint.check_fingerprint(current);
      checkpoint.read_points(s.grid, s.points);
      return "read";
    }
  catch (const BadInput &error)
    {
      return error.what();
    }
}

void
write(Scene &s, const double time)
{
  write_checkpoint(directory,
                   s.grid,
                   s.points,
                   {},
                   {{"time", time}, {"third", 1. / 3.}, {"large", 1e300}},
                   warnings,
                   parameters);
}

void
check_contents(Scene &s)
{
  const auto before = numbers_of(s);
  std::printf("more than one piece: %s\n",
              before.size() > 20000 ? "yes" : "no");
  write(s, .1);
  std::printf("written: %s\n", valid_file().c_str());
  write(s, .7);
  std::printf("written: %s\n", valid_file().c_str());
  // copies of the user's, beside the one that is written
  for (const std::string name : {"checkpoint-a.h5.bak", "checkpoint-a_copy.h5"})
    std::ofstream(path(name)) << "kept";
  write(s, .7);
  write(s, .7);
  for (const std::string name : {"checkpoint-a.h5.bak", "checkpoint-a_copy.h5"})
    std::printf("%s: %s\n", name.c_str(), read_text(path(name)).c_str());
  s.points.reset(std::vector<unsigned int>(s.grid.n_global_cells(), 0));
  const Checkpoint checkpoint(directory);
  checkpoint.read_points(s.grid, s.points);
  std::printf("the same points: %s\n",
              numbers_of(s) == before && s.points.n_points() == before.size() ?
                "yes" :
                "no");
  std::printf("the same state: %s\n",
              checkpoint.info.state == NamedNumbers{{"time", .7},
                                                    {"third", 1. / 3.},
                                                    {"large", 1e300}} ?
                "yes" :
                "no");
  std::printf("the same warnings: %s\n",
              checkpoint.info.warnings == warnings ? "yes" : "no");
  std::printf("%s\n", read(s, "a = 1\nb = 3\n").c_str());
}

void
flip(const std::string &file, const std::size_t place)
{
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(place);
  const char byte = stream.get();
  stream.seekp(place);
  stream.put(byte ^ 1);
}

/** One bit is changed, every so many bytes. */
void
check_damage(Scene &s, const std::size_t step)
{
  const std::string file      = path(valid_file());
  const std::size_t size      = std::filesystem::file_size(file);
  unsigned int      n_changes = 0, n_read = 0;
  for (std::size_t place = 0; place < size; place += step)
    {
      flip(file, place);
      ++n_changes;
      n_read += read(s).find("is damaged") == std::string::npos;
      flip(file, place);
    }
  std::printf("changes: %s, not noticed: %u\n",
              n_changes > 10 ? "many" : "few",
              n_read);
  std::filesystem::resize_file(file, size - 8);
  std::printf("cut off: %s\n", read(s).c_str());
}

/** Any bit of the text is changed. */
void
check_damaged_text(Scene &s)
{
  const std::string file   = path("checkpoint.info");
  unsigned int      n_read = 0;
  for (std::size_t place = 0; place < std::filesystem::file_size(file); ++place)
    {
      flip(file, place);
      n_read += read(s).find("is damaged") == std::string::npos;
      flip(file, place);
    }
  std::printf("damage of the text not noticed: %u\n", n_read);
  std::printf("as it was: %s\n", read(s).c_str());
}

/** Fields come back to the last bit, and their damage is noticed. */
void
check_fields(Scene &s)
{
  const double      nan     = std::numeric_limits<double>::quiet_NaN();
  const double      large   = 1.2345678901234567e300;
  const NamedFields written = {{"pressure", {1. / 3., nan, -0., large}},
                               {"is_wet", {1., 0.}}};
  write_checkpoint(directory, s.grid, s.points, written, {}, {}, parameters);
  const auto same = [](const NamedFields &a, const NamedFields &b) {
    bool result = a.size() == b.size();
    for (std::size_t i = 0; result && i < a.size(); ++i)
      result = a[i].first == b[i].first &&
               a[i].second.size() == b[i].second.size() &&
               std::memcmp(a[i].second.data(),
                           b[i].second.data(),
                           a[i].second.size() * sizeof(double)) == 0;
    return result;
  };
  std::printf("the same fields: %s\n",
              same(Checkpoint(directory).read_fields(), written) ? "yes" :
                                                                   "no");
  std::string bytes(sizeof(double), ' ');
  std::memcpy(&bytes[0], &large, sizeof(double));
  const auto place = read_text(path(valid_file())).find(bytes);
  flip(path(valid_file()), place);
  std::printf("damage of a field: %s\n",
              read(s).find("is damaged") == std::string::npos ? "not noticed" :
                                                                "noticed");
}

/** The file system refuses what is too large. */
void
check_full_disk(Scene &s)
{
  write(s, .3);
  const auto        before = numbers_of(s);
  const std::string file   = valid_file();
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit;
  getrlimit(RLIMIT_FSIZE, &limit);
  const auto former = limit.rlim_cur;
  limit.rlim_cur    = 3000000;
  setrlimit(RLIMIT_FSIZE, &limit);
  try
    {
      write(s, .4);
      std::printf("written to a full disk\n");
    }
  catch (const RunFailure &error)
    {
      std::printf("full disk: %s\n", error.what());
    }
  limit.rlim_cur = former;
  setrlimit(RLIMIT_FSIZE, &limit);
  std::printf("the one before is valid: %s\n",
              valid_file() == file && read(s) == "read" &&
                  numbers_of(s) == before ?
                "yes" :
                "no");
  write(s, .5);
  std::printf("there is room again: %s\n",
              valid_file() != file && read(s) == "read" ? "yes" : "no");
}

/** A file of points on its own. */
void
check_point_file(const Scene &s)
{
  std::printf("written: %s\n",
              write_point_file(path("points.h5"), s.grid, s.points, {}) ?
                "yes" :
                "no");
  const unsigned long n    = s.points.n_points();
  const auto          read = [&](const std::string  &name,
                        const unsigned long first,
                        const unsigned long n) {
    const PointFile file(path(name));
    const auto      points = file.read(first, n, 0);
    return std::make_pair(file.succeeded(), points);
  };
  const auto whole = read("points.h5", 0, 10), part = read("points.h5", 3, 7);
  bool       same = whole.first && part.first;
  for (unsigned int i = 0; i < 7; ++i)
    same = same && whole.second[3 + i].point.id == part.second[i].point.id;
  std::printf("read in parts: %s\n", same ? "yes" : "no");
  const std::string text = read_text(path("points.h5"));
  std::printf("columns are named: %s\n",
              text.find("cell material position_r position_z velocity_r") !=
                  std::string::npos ?
                "yes" :
                "no");
  std::printf("beyond the end: %s\n",
              read("points.h5", n - 1, 2).first ? "read" : "refused");
  std::printf("no such file: %s\n",
              read("none.h5", 0, 10).first ? "read" : "refused");
  std::printf("no such directory: %s\n",
              write_point_file(path("none/points.h5"), s.grid, s.points, {}) ?
                "written" :
                "refused");
}

int
main(int argc, char *argv[])
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::filesystem::remove_all(directory);
  std::filesystem::create_directory(directory);
  {
    Scene s(box("0.1"));
    generate(s);
    heading("file of points");
    check_point_file(s);
    heading("contents");
    check_contents(s);
    heading("damaged points");
    check_damage(s, 199999);
    heading("full disk");
    check_full_disk(s);
  }
  Scene s(box("1"));
  generate(s);
  heading("fields");
  check_fields(s);
  write(s, .1);
  heading("damaged text");
  check_damaged_text(s);
  heading("damaged points of a small scene");
  check_damage(s, 97);
  return 0;
}
