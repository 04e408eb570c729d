// SPDX-License-Identifier: LGPL-2.1-or-later

#include <caisson_mpm/base/stop_request.h>

#include <deal.II/base/patterns.h>

#include <filesystem>
#include <sstream>

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
  } // namespace



  StopRequest::StopRequest()
    : ParameterAcceptor("/Run control")
    , start_time(Clock::now())
    , next_look(start_time)
  {
    add_parameter("Wall time limit",
                  wall_time_limit,
                  "Wall time after which the run stops with a checkpoint; "
                  "0 means no limit. Units: s",
                  prm,
                  dealii::Patterns::Double(0.));
    add_parameter("Stop file",
                  stop_file,
                  "Name of a file; when it appears in the output directory, "
                  "the run stops with a checkpoint and removes it. Empty means "
                  "none. Units: none",
                  prm,
                  dealii::Patterns::Anything());
  }



  StopRequest::~StopRequest()
  {
    if (!is_armed)
      return;
    sigaction(SIGINT, &previous_interrupt_action, nullptr);
    sigaction(SIGTERM, &previous_terminate_action, nullptr);
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
    action.sa_handler       = remember_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGTERM, &action, &previous_terminate_action);
    // The first SIGINT brings back the default action for the second.
    action.sa_flags |= static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &previous_interrupt_action);
    is_armed = true;
  }



  std::string
  StopRequest::reason()
  {
    if (found_reason.empty())
      found_reason = find_reason();
    return found_reason;
  }



  std::string
  StopRequest::find_reason()
  {
    if (received_signal != 0)
      return received_signal == SIGINT ? "SIGINT received" : "SIGTERM received";

    const Clock::time_point now = Clock::now();
    if (wall_time_limit > 0. &&
        std::chrono::duration<double>(now - start_time).count() >=
          wall_time_limit)
      {
        std::ostringstream text;
        text << "wall time limit of " << wall_time_limit << " s reached";
        return text.str();
      }

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
