// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs the test that the last argument names, by the main function of its file,
// which is in a namespace of its own here: see CMakeLists.txt.
#include <string>

#define TEST(space, name) \
  namespace space         \
  {                       \
    int                   \
    run(int, char **);    \
  }
#include <choices.h>
#undef TEST

int
main(int argc, char *argv[])
{
  const std::string test = argv[argc - 1];
#define TEST(space, name) \
  if (test == name)       \
    return space::run(argc - 1, argv);
#include <choices.h>
  return 127;
}
