// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Calls of code that somebody else has written, which may crash, stop or leave
// the program.
#ifndef caisson_mpm_base_guarded_call_h
#define caisson_mpm_base_guarded_call_h

#include <string>

namespace CaissonMPM
{
  /** How a guarded call has ended. */
  enum class EndOfCall : int
  {
    returned = 0,
    stopped  = -1 // by leave_guarded_call()
    // else the number of the signal that ended it
  };

  /**
   * Call @p action with its argument. A signal of a crash in it (SIGSEGV,
   * SIGBUS, SIGFPE, SIGILL, SIGABRT) ends the call and not the program, and so
   * does leave_guarded_call(). Where the action ends the program by exit(), as
   * STOP of Fortran does, @p text_of_exit is asked for the error to print, and
   * the program ends with @p status_of_exit, on all ranks. Objects of the
   * action are not destroyed where it does not return. One call at a time.
   */
  EndOfCall
  guarded_call(void (*action)(void *),
               void *argument,
               std::string (*text_of_exit)(void *),
               const int status_of_exit);

  /** End the guarded call that is running. */
  [[noreturn]] void
  leave_guarded_call();

  /** Where the last call that ended with SIGSEGV or SIGBUS wanted to read or to
   * write. */
  const void *
  address_of_crash();

  /** "SIGSEGV (Segmentation fault)" and the like. */
  std::string
  name_of_signal(const EndOfCall end);
} // namespace CaissonMPM

#endif
