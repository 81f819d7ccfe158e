/// The `/calibration` page of `dotpose watch --web`: the `calibration` topic and the commands.
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
    /// Adds the topic to the server. Must be called before the server is started. If `options` is
    /// nullopt, the page explains how to enable calibration, and all commands are rejected.
    WebCalibration(std::optional<GuideOptions> options, serve::Server& server);

    /// Executes {"do": "calibrate", "action": "start", "step": NAME}, or a command with the action
    /// "finish", "cancel" or "save". Rejects commands with other arguments, such as a file name,
    /// and reports such commands at most once every 10 s.
    void obey(const serve::Command& command);

    /// Uses these sheets for later calibrations.
    void set_sheets(std::vector<SheetEntry> sheets);

    /// Offers a frame to the current step, and publishes the state if it has changed. `image` is
    /// the image that was located, or empty.
    void take(const capture::Frame& frame, const Reading& reading, ImageView image,
              double bits_per_px);

    /// Returns the camera that was saved since the previous call, or nullopt.
    std::optional<Camera> take_camera();

  private:
    using Clock = std::chrono::steady_clock;

    void publish();
    void refuse(const std::string& reason);

    serve::Server& server_;
    serve::Topic& topic_;
    std::optional<CalibrationGuide> guide_;
    std::optional<std::uint64_t> published_;  ///< version of the last published state
    Clock::time_point next_{};
    Clock::time_point next_report_{};
};

}  // namespace dotpose::cli
