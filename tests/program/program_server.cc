// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The program, for the many short calls of test_*.py: most of the time of a
// call goes into loading the 200 libraries of deal.II. This process has loaded
// them, and each call is a fork of it that begins with the main function.
//
// A call is the file for what the program writes, whether it is waited for ("1"
// or "0"), the number of its arguments, and the arguments, with a zero byte
// after each. The answer is a line with the exit status, or with the negative
// number of the signal; of a process that is not waited for, it is its number.
// Such a process has lost its parent, so that it becomes a child of who asked
// for that (PR_SET_CHILD_SUBREAPER).
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
    const int output  = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
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

  /** Return the exit status of a child, or the negative number of the signal.
   */
  int
  wait_for(const pid_t child)
  {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /** Run the program to its end; return its exit status. */
  int
  run(const std::string &file, std::vector<std::string> &words)
  {
    const pid_t child = fork();
    if (child == 0)
      start(file, words);
    return wait_for(child);
  }

  /** Start the program in a process without a parent; return its number. */
  pid_t
  leave(const std::string &file, std::vector<std::string> &words)
  {
    int numbers[2];
    if (pipe(numbers) != 0)
      std::_Exit(127);
    const pid_t child = fork();
    if (child == 0)
      {
        setsid();
        pid_t grandchild = fork();
        if (grandchild == 0)
          start(file, words);
        std::_Exit(::write(numbers[1], &grandchild, sizeof(pid_t)) < 0);
      }
    wait_for(child);
    pid_t result = -1;
    if (::read(numbers[0], &result, sizeof(pid_t)) != sizeof(pid_t))
      std::_Exit(127);
    close(numbers[0]);
    close(numbers[1]);
    return result;
  }
} // namespace

int
main(int, char *argv[])
{
  std::string file, is_waited_for, number;
  while (read(file) && read(is_waited_for) && read(number))
    {
      std::vector<std::string> words(1 + std::stoul(number), argv[0]);
      for (std::size_t i = 1; i < words.size(); ++i)
        read(words[i]);
      std::cout << (is_waited_for == "1" ? run(file, words) :
                                           leave(file, words))
                << std::endl;
    }
}
