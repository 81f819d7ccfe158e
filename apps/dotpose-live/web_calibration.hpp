/// The page `/calibration` of `dotpose watch --web`: its topic `calibration` and its commands.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibration_guide.hpp"
#include "serve/server.hpp"

namespace dotpose::cli {

class WebCalibration {
  public:
    /// Adds the topic to the server, which must not have started. If `options` is none, the page
    /// explains how to enable the calibration, and commands are refused.
    WebCalibration(std::optional<GuideOptions> options, serve::Server& server);

    /// Obeys {"do": "calibrate", "action": "start", "step": NAME}, or the action "finish", "cancel"
    /// or "save". Refuses commands with other arguments, such as the name of a file, and reports
    /// them at most every 10 s.
    void obey(const serve::Command& command);

    /// Calibrates with these sheets from now on.
    void set_sheets(std::vector<SheetEntry> sheets);

    /// Offers a frame to the running step, and sends the state if it has changed. `image` is the
    /// image that was located, or empty.
    void take(const capture::Frame& frame, const Reading& reading, ImageView image,
              double bits_per_px);

    /// Returns the camera that was saved since the previous call, or none.
    std::optional<Camera> take_camera();

  private:
    using Clock = std::chrono::steady_clock;

    void publish();
    void refuse(const std::string& reason);

    serve::Server& server_;
    serve::Topic& topic_;
    std::optional<CalibrationGuide> guide_;
    std::optional<std::uint64_t> published_;  ///< version of the newest published state
    Clock::time_point next_{};
    Clock::time_point next_report_{};
};

}  // namespace dotpose::cli
