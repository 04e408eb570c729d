// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The program, for the many short calls of test_*.py: most of the time of a
// call goes into loading the 200 libraries of deal.II. This process has loaded
// them, and each call is a fork of it that begins with the main function.
//
// A call is the file for what the program writes, the number of its arguments,
// and the arguments, with a zero byte after each. The answer is a line with the
// exit status, or with the negative number of the signal.
#define main program_main
#include "../../source/main.cc"
#undef main

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <vector>

namespace
{
  /** Read the next word of a call. */
  bool
  read(std::string &word)
  {
    return bool(std::getline(std::cin, word, '\0'));
  }

  /** In the new process: run the program as if it had been started. */
  [[noreturn]] void
  start(const std::string &file, std::vector<std::string> &words)
  {
    const int nothing = open("/dev/null", O_RDONLY);
    const int output  = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (nothing < 0 || output < 0)
      std::_Exit(127);
    dup2(nothing, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    close(nothing);
    close(output);
    std::vector<char *> arguments;
    for (std::string &word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::exit(program_main(words.size(), arguments.data()));
  }
} // namespace

int
main(int, char *argv[])
{
  std::string file, number;
  while (read(file) && read(number))
    {
      std::vector<std::string> words(1 + std::stoul(number), argv[0]);
      for (std::size_t i = 1; i < words.size(); ++i)
        read(words[i]);
      const pid_t child = fork();
      if (child == 0)
        start(file, words);
      int status = 0;
      waitpid(child, &status, 0);
      std::cout << (WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status))
                << std::endl;
    }
}
