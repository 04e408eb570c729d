// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/guarded_call.h>

#include <boost/core/demangle.hpp>

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <typeinfo>

namespace CaissonMPM
{
  namespace
  {
    constexpr std::size_t most_characters = 4096;

    const ForeignCode *volatile running      = nullptr;
    volatile std::sig_atomic_t status_of_end = 0; // ExitStatus

    /** Where foreign code runs, say what it has done and end the program. Also
     * called by handlers of signals. */
    void
    end_if_foreign(const char *what)
    {
      const ForeignCode *const code = running;
      if (code == nullptr)
        return;
      running = nullptr;
      char text[most_characters];
      code->describe(what, text, sizeof(text));
      const bool in_run =
        status_of_end == static_cast<int>(ExitStatus::failure);
      dprintf(STDERR_FILENO,
              "%s: %s\n",
              in_run ? "failure" : "bad input",
              text);
      _exit(status_of_end);
    }

    void
    on_crash(const int number)
    {
      char what[200];
      std::snprintf(what,
                    sizeof(what),
                    "has crashed with SIG%s (%s). Compile it with -g "
                    "-fcheck=all to find out where",
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

    /** Once, before any foreign code. A stack of their own serves handlers
     * where the other one is full. */
    bool
    install_guards()
    {
      status_of_end = static_cast<int>(ExitStatus::bad_input);
      static char room[65536];
      stack_t     stack = {};
      stack.ss_sp       = room;
      stack.ss_size     = sizeof(room);
      sigaltstack(&stack, nullptr);
      struct sigaction handler = {};
      handler.sa_handler       = on_crash;
      handler.sa_flags         = SA_ONSTACK | SA_NODEFER | SA_RESETHAND;
      for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
        sigaction(number, &handler, nullptr);
      std::atexit(on_exit_of_program);
      return true;
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
    [[maybe_unused]] static const bool installed = install_guards();
    running                                      = &code;
  }

  ForeignCall::~ForeignCall()
  {
    running = nullptr;
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
    status_of_end = static_cast<int>(ExitStatus::failure);
  }
} // namespace CaissonMPM
