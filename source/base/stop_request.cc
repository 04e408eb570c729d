// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/choice.h>
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/output_directory.h>
#include <caisson_mpm/base/stop_request.h>
#include <caisson_mpm/base/text.h>

#include <deal.II/base/patterns.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

namespace CaissonMPM
{
  namespace
  {
    // A signal handler can reach nothing but a global variable.
    volatile std::sig_atomic_t received_signal = 0;

    extern "C" void
    remember_signal(const int signal)
    {
      received_signal = signal;
    }

    /** Those that ask for an end in order, of which the first one is Ctrl-C,
     * and two that must not end the run: a reader of the output has gone, as
     * "| head", and a file would exceed the limit of its size. */
    constexpr StopRequest::Signals handled_signals = {{SIGINT,
                                                       SIGTERM,
                                                       SIGHUP,
                                                       SIGQUIT,
                                                       SIGUSR1,
                                                       SIGUSR2,
                                                       SIGXCPU,
                                                       SIGPIPE,
                                                       SIGXFSZ}};
  } // namespace

  StopRequest::StopRequest()
    : Section("/Run control", Influence::none)
    , start_time(Clock::now())
    , next_look(start_time)
  {
    add_word_or_number(
      *this,
      "Wall time limit",
      wall_time_limit,
      "never",
      0.,
      "s",
      "The run stops with a checkpoint after this wall time; with never, there "
      "is no limit.",
      dealii::Patterns::Double(0.));
    add_parameter(
      "Stop file",
      stop_file,
      "",
      "The run stops with a checkpoint when a file of this name appears in the "
      "output directory, and removes the file; with an empty name there is no "
      "such file.",
      dealii::Patterns::Anything());
  }

  StopRequest::~StopRequest()
  {
    if (!is_armed)
      return;
    for (std::size_t i = 0; i < handled_signals.size(); ++i)
      sigaction(handled_signals[i], &previous_actions[i], nullptr);
  }

  void
  StopRequest::check_parameters() const
  {
    if (stop_file.find('/') != std::string::npos ||
        OutputDirectory::is_result(stop_file))
      throw BadInput("Run control/Stop file = " + stop_file +
                     " must be the name of a new file in the output directory, "
                     "for instance stop: the run removes it.");
  }

  void
  StopRequest::arm(const std::string &output_directory)
  {
    stop_file_path = stop_file.empty() ?
                       "" :
                       (std::filesystem::path(output_directory) / stop_file)
                         .lexically_normal()
                         .string();
    if (is_armed)
      return;

    received_signal         = 0;
    struct sigaction action = {};
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < handled_signals.size(); ++i)
      {
        const int signal = handled_signals[i];
        // The first SIGINT brings back the default action for the second.
        action.sa_flags =
          SA_RESTART | (signal == SIGINT ? static_cast<int>(SA_RESETHAND) : 0);
        action.sa_handler =
          signal == SIGPIPE || signal == SIGXFSZ ? SIG_IGN : remember_signal;
        sigaction(signal, &action, &previous_actions[i]);
      }
    is_armed = true;
  }

  void
  StopRequest::refuse_file_of_user(const MPI_Comm communicator) const
  {
    std::error_code error;
    const bool      is_there = !stop_file_path.empty() && stop_file != "stop" &&
                          std::filesystem::exists(stop_file_path, error);
    if (dealii::Utilities::MPI::logical_or(is_there, communicator))
      throw BadInput("Run control/Stop file: " + stop_file_path +
                     " is there already, and the run would remove it. Remove "
                     "it yourself, or write another name, for instance stop.");
  }

  std::string
  StopRequest::reason()
  {
    if (found_reason.empty())
      {
        found_reason = find_reason();
        found_at     = Clock::now();
      }
    return found_reason;
  }

  double
  StopRequest::seconds_since() const
  {
    if (received_signal != 0 && std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr)
      return std::numeric_limits<double>::infinity();
    return found_reason.empty() ?
             0. :
             std::chrono::duration<double>(Clock::now() - found_at).count();
  }

  std::string
  StopRequest::find_reason()
  {
    if (received_signal != 0)
      return "SIG" + std::string(sigabbrev_np(received_signal)) + " received";

    const Clock::time_point             now     = Clock::now();
    const std::chrono::duration<double> elapsed = now - start_time;
    if (wall_time_limit && elapsed.count() >= *wall_time_limit)
      return "wall time limit of " + to_text(*wall_time_limit) + " s reached";

    if (is_armed && now >= next_look)
      {
        next_look = now + std::chrono::milliseconds(500);
        if (take_stop_file())
          return "file " + stop_file_path + " found";
      }
    return "";
  }

  bool
  StopRequest::take_stop_file() const
  {
    // Removing a file that is not there is an error that we ask for.
    std::error_code error;
    return !stop_file_path.empty() &&
           std::filesystem::is_regular_file(stop_file_path, error) &&
           std::filesystem::remove(stop_file_path, error);
  }
} // namespace CaissonMPM
