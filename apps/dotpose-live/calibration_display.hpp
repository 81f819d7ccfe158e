/// The display of `dotpose calibrate --live` while it takes frames: a window; the terminal if there
/// is no display; and a line for each change if standard error is no terminal.
#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/image.hpp"
#include "dotpose/tools/calibration_coverage.hpp"
#include "dotpose/trace.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

struct CalibrationStatus {
    explicit CalibrationStatus(const CalibrationCoverage& shown) : coverage(shown) {}

    CalibrationCoverage coverage;
    std::vector<CalibrationNeed> needs;     ///< what is missing, the most urgent first
    std::optional<double> corner_sigma_px;  ///< of the newest calibration
    std::optional<double> theta_rad;        ///< direction of the newest frame, if it is located
    std::string now;                        ///< what became of the newest frame
    std::string remark;                     ///< what else there is to say, or empty
    bool is_taken = false;                  ///< whether the newest frame was taken
};

class CalibrationDisplay {
  public:
    explicit CalibrationDisplay(bool has_window);
    /// Shows the newest frame, with the trace of its stages, and the status. Returns false if the
    /// user closed the window or pressed q or Escape in it.
    bool show(const CalibrationStatus& status, ImageView image, const Trace& trace);

    /// Handles events of the window. Returns false like `show`.
    bool is_wanted() { return screen_.is_wanted(); }

    /// Tells the user something beside what is shown. Any thread may call it.
    void say(const std::string& message);

  private:
    void show_in_terminal(const CalibrationStatus& status);

    bool has_window_;
    bool on_terminal_;
    video::Screen screen_;
    std::atomic<int> shown_lines_ = 0;  ///< lines on the terminal that the next status replaces
    std::chrono::steady_clock::time_point next_;
    std::string last_line_;
};

}  // namespace dotpose::cli
