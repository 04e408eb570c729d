// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/base/stop_request.h>

#include <deal.II/base/mpi.h>

#include <boost/core/demangle.hpp>

#include <sys/syscall.h>
#include <unistd.h>
#ifdef __SSE2__
#  include <xmmintrin.h>
#endif

#include <atomic>
#include <cfenv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <thread>
#include <typeinfo>

namespace CaissonMPM
{
  namespace
  {
    constexpr std::size_t most_characters = 4096;

    constexpr int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

    std::atomic<const ForeignCode *> running       = nullptr;
    std::atomic<unsigned int>        n_calls       = 0;
    std::atomic<ExitStatus>          status_of_end = ExitStatus::bad_input;
    std::fenv_t                      arithmetic; // of the program
    unsigned int                     control = 0;
    pid_t process = 0; // a child that foreign code makes is not ours
    int   rank = 0, n_ranks = 1;

    /** Rounding, traps, and what becomes of the smallest numbers; this is
     * cheap, and to set them is not. */
    unsigned int
    control_of_arithmetic()
    {
#ifdef __SSE2__
      return _mm_getcsr() & ~_MM_EXCEPT_MASK;
#else
      return std::fegetround() | fegetexcept() << 16;
#endif
    }

    [[noreturn]] void
    quit(const int status)
    {
      while (true)
        syscall(SYS_exit_group, status);
    }

    [[noreturn]] void
    quit_at_last(int)
    {
      quit(static_cast<int>(status_of_end.load()));
    }

    /** Where foreign code runs, say what it has done and end the program. Also
     * called by handlers of signals. */
    void
    end_if_foreign(const char *what)
    {
      const ForeignCode *const code = running;
      if (code == nullptr || getpid() != process)
        return;
      running = nullptr;
      // of several ranks that fail one shall say it, and end the others
      for (unsigned int left = rank > 0 ? 3 : 0; left > 0;)
        left = sleep(left);
      const ExitStatus status = status_of_end;
      char             text[most_characters];
      code->describe(what, text, sizeof(text));
      dprintf(STDERR_FILENO,
              "%s: %s\n",
              status == ExitStatus::bad_input ? "bad input" : "failure",
              text);
      // what else is to be done may wait for a lock that the code has taken
      std::signal(SIGALRM, quit_at_last);
      alarm(5);
      std::cout.flush();
      if (n_ranks > 1)
        MPI_Abort(MPI_COMM_WORLD, static_cast<int>(status));
      quit(static_cast<int>(status));
    }

    void
    on_crash(const int number, siginfo_t *const info, void *)
    {
      const ForeignCode *const code = running;
      const bool               outside =
        number == SIGSEGV && code != nullptr && code->is_guard(info->si_addr);
      char what[200];
      std::snprintf(what,
                    sizeof(what),
                    "has %s SIG%s (%s). Compile it with -g -fcheck=all to find "
                    "out where",
                    outside ? "read or written outside its arguments, and has "
                              "crashed with" :
                              "crashed with",
                    sigabbrev_np(number),
                    sigdescr_np(number));
      end_if_foreign(what);
      raise(number); // the handler is the default one again
    }

    void
    on_exit_of_program()
    {
      end_if_foreign("has ended the program (STOP or exit). A UMAT should call "
                     "XIT");
    }

    /** End the program where one call takes too long. */
    void
    watch()
    {
      using namespace std::chrono_literals;
      constexpr unsigned int most = 120;
      for (unsigned int n_looks = 0, before = 0;;)
        {
          std::this_thread::sleep_for(500ms);
          const unsigned int now = n_calls;
          n_looks = running != nullptr && now == before ? n_looks + 1 : 0;
          before  = now;
          if (n_looks > most)
            end_if_foreign("has not returned for a minute");
          if (n_looks > 1 && StopRequest::is_due())
            end_if_foreign("does not return, and the run has been asked to "
                           "stop by a signal or by its Wall time limit");
        }
    }

    /** Once, before any foreign code. A stack of their own serves handlers
     * where the other one is full. */
    void
    install_guards()
    {
      if (process != 0)
        return;
      process = getpid();
      std::fegetenv(&arithmetic);
      control = control_of_arithmetic();
      rank    = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      static char room[65536];
      stack_t     stack = {};
      stack.ss_sp       = room;
      stack.ss_size     = sizeof(room);
      sigaltstack(&stack, nullptr);
      struct sigaction handler = {};
      handler.sa_sigaction     = on_crash;
      handler.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER | SA_RESETHAND;
      for (const int number : crashes)
        sigaction(number, &handler, nullptr);
      std::atexit(on_exit_of_program);
      std::at_quick_exit(on_exit_of_program);
      std::thread(watch).detach();
    }
  } // namespace

  std::string
  ForeignCode::description(const std::string &what) const
  {
    char text[most_characters];
    describe(what.c_str(), text, sizeof(text));
    return text;
  }

  ForeignCall::ForeignCall(const ForeignCode &code)
  {
    install_guards();
    n_calls.store(n_calls.load(std::memory_order_relaxed) + 1,
                  std::memory_order_relaxed);
    running.store(&code, std::memory_order_release);
  }

  ForeignCall::~ForeignCall()
  {
    running.store(nullptr, std::memory_order_release);
    if (control_of_arithmetic() != control)
      std::fesetenv(&arithmetic);
  }

  std::string
  text_of_exception()
  {
    try
      {
        throw;
      }
    catch (const EndOfAnalysis &end)
      {
        return end.reason;
      }
    catch (const std::exception &error)
      {
        return "has thrown the C++ exception " +
               boost::core::demangle(typeid(error).name()) + ": " +
               error.what();
      }
    catch (...)
      {
        return "has thrown a C++ exception that is no std::exception";
      }
  }

  void
  begin_run_with_foreign_code()
  {
    status_of_end = ExitStatus::failure;
  }
} // namespace CaissonMPM

/** A library that ends the program by _exit() or _Exit() finds this function,
 * and not that of the C library. */
extern "C" void
_exit(const int status)
{
  CaissonMPM::end_if_foreign("has ended the program by _exit()");
  CaissonMPM::quit(status);
}

extern "C" void
_Exit(const int status) noexcept
{
  _exit(status);
}
