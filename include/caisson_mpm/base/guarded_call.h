// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Calls of code that somebody else has written, which may throw, crash or end
// the program.
#ifndef caisson_mpm_base_guarded_call_h
#define caisson_mpm_base_guarded_call_h

#include <caisson_mpm/base/exceptions.h>

#include <cstddef>
#include <string>

namespace CaissonMPM
{
  /** Code that somebody else has written. */
  class ForeignCode
  {
  public:
    virtual ~ForeignCode() = default;

    /** Write a sentence: the code, @p what it has done, and where. A handler of
     * signals calls this, so that it must not ask for memory. */
    virtual void
    describe(const char *what, char *text, const std::size_t size) const = 0;

    /** The same sentence. */
    std::string
    description(const std::string &what) const;
  };

  /** What a routine of the program that foreign code has called throws, and
   * what this code has done, as in "has called XIT". */
  struct EndOfAnalysis
  {
    std::string reason;
  };

  /**
   * While an object lives, foreign code runs. Where it crashes (SIGSEGV,
   * SIGBUS, SIGFPE, SIGILL, SIGABRT) or leaves the program (exit, STOP), its
   * description is the last line, and the program ends; mpirun then ends the
   * other ranks. One object at a time.
   */
  class ForeignCall
  {
  public:
    explicit ForeignCall(const ForeignCode &code);
    ~ForeignCall();

    ForeignCall(const ForeignCall &) = delete;
    ForeignCall &
    operator=(const ForeignCall &) = delete;
  };

  /** What the foreign code has thrown that is being caught, as in "has thrown
   * the C++ exception std::runtime_error: no convergence". */
  std::string
  text_of_exception();

  /** Call action() as foreign code. Returns what it has thrown; empty where it
   * has returned. */
  template <typename Action>
  std::string
  guarded_call(const ForeignCode &code, const Action &action)
  {
    const ForeignCall call(code);
    try
      {
        action();
        return {};
      }
    catch (...)
      {
        return text_of_exception();
      }
  }

  /** From now on the program that foreign code ends has failed in a run;
   * before, its input is bad. */
  void
  begin_run_with_foreign_code();
} // namespace CaissonMPM

#endif
