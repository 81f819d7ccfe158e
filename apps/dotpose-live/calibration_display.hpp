/// Displays the progress of `dotpose calibrate --live` in a window or, if no window can be opened,
/// in the terminal. If neither is available, writes a line to standard error whenever the status
/// changes.
#pragma once

#include <atomic>
#include <chrono>
#include <string>

#include "calibration_status.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

class CalibrationDisplay {
  public:
    explicit CalibrationDisplay(bool has_window);
    /// Displays a frame, the trace of its stages, and the status. Returns false if the user has
    /// closed the window, or pressed q or Escape in the window.
    bool show(const CalibrationStatus& status, ImageView image, const Trace& trace);

    /// Processes window events. Returns false if the user closed the window.
    bool is_wanted() { return screen_.is_wanted(); }

    /// Writes a message to standard error. The message is not overwritten by the next status.
    /// Thread-safe.
    void say(const std::string& message);

  private:
    void show_in_terminal(const CalibrationStatus& status);

    bool has_window_;
    bool on_terminal_;
    video::Screen screen_;
    /// Number of terminal lines occupied by the last status. The next status overwrites these
    /// lines.
    std::atomic<int> shown_lines_ = 0;
    std::chrono::steady_clock::time_point next_;
    std::string last_line_;
};

}  // namespace dotpose::cli
