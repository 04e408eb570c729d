// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <array>
#include <csetjmp>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <utility>

namespace CaissonMPM
{
  namespace
  {
    constexpr std::array<std::pair<int, const char *>, 5> crashes = {
      {{SIGSEGV, "SIGSEGV"},
       {SIGBUS, "SIGBUS"},
       {SIGFPE, "SIGFPE"},
       {SIGILL, "SIGILL"},
       {SIGABRT, "SIGABRT"}}};

    // of the call that is running
    volatile std::sig_atomic_t is_running = 0;
    sigjmp_buf                 begin_of_call;
    void                      *argument_of_call = nullptr;
    std::string (*text_of_exit_of_call)(void *) = nullptr;
    int status_of_exit_of_call                  = 0;
    // of the last crash
    void *volatile address_of_last_crash = nullptr;

    std::array<struct sigaction, crashes.size()> handlers_before;

    /** Only what a handler of signals may do. */
    void
    on_crash(const int number, siginfo_t *const information, void *)
    {
      if (is_running)
        {
          address_of_last_crash = information->si_addr;
          siglongjmp(begin_of_call, number);
        }
      // not ours: the handler before finds the same again
      for (std::size_t i = 0; i < crashes.size(); ++i)
        if (crashes[i].first == number)
          sigaction(number, &handlers_before[i], nullptr);
      if (number == SIGABRT)
        raise(number);
    }

    void
    on_exit_of_program()
    {
      if (!is_running)
        return;
      is_running = 0;
      std::cerr << "failure: " << text_of_exit_of_call(argument_of_call)
                << std::endl;
      int has_mpi = 0, has_ended = 0;
      MPI_Initialized(&has_mpi);
      MPI_Finalized(&has_ended);
      if (has_mpi && !has_ended &&
          dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, status_of_exit_of_call);
      _exit(status_of_exit_of_call);
    }

    /** Take the signals and the end of the program; once. A stack of their own
     * serves handlers where the other one is full. */
    void
    install_handlers()
    {
      static bool is_installed = false;
      if (is_installed)
        return;
      is_installed = true;
      static std::array<char, 65536> room;
      stack_t                        stack = {};
      stack.ss_sp                          = room.data();
      stack.ss_size                        = room.size();
      sigaltstack(&stack, nullptr);
      struct sigaction handler = {};
      handler.sa_sigaction     = on_crash;
      handler.sa_flags         = SA_ONSTACK | SA_NODEFER | SA_SIGINFO;
      sigemptyset(&handler.sa_mask);
      for (std::size_t i = 0; i < crashes.size(); ++i)
        sigaction(crashes[i].first, &handler, &handlers_before[i]);
      std::atexit(on_exit_of_program);
    }
  } // namespace

  EndOfCall
  guarded_call(void (*action)(void *),
               void *argument,
               std::string (*text_of_exit)(void *),
               const int status_of_exit)
  {
    install_handlers();
    argument_of_call       = argument;
    text_of_exit_of_call   = text_of_exit;
    status_of_exit_of_call = status_of_exit;
    // the mask of signals does not change: SA_NODEFER
    const int end = sigsetjmp(begin_of_call, 0);
    if (end == 0)
      {
        is_running = 1;
        action(argument);
      }
    is_running = 0;
    return static_cast<EndOfCall>(end);
  }

  void
  leave_guarded_call()
  {
    if (is_running)
      siglongjmp(begin_of_call, static_cast<int>(EndOfCall::stopped));
    std::abort();
  }

  const void *
  address_of_crash()
  {
    return address_of_last_crash;
  }

  std::string
  name_of_signal(const EndOfCall end)
  {
    const int number = static_cast<int>(end);
    for (const auto &[crash, name] : crashes)
      if (crash == number)
        return std::string(name) + " (" + strsignal(number) + ")";
    return "signal " + to_text(number);
  }
} // namespace CaissonMPM
