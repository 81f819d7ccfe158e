// Shows the live picture of `dotpose watch` or `dotpose calibrate --live` in a window, records it
// in a video file, or does both.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/device_options.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/image.hpp"
#include "dotpose/tools/calibration_coverage.hpp"
#include "dotpose/trace.hpp"
#include "draw/track_map.hpp"

namespace dotpose::video {

/// A point on the path in a plane. `is_jump` is true if the path is interrupted before this point.
struct PathMark {
    double x = 0;
    double y = 0;
    bool is_jump = false;
};

struct Gauge {
    std::string label;
    std::string text;
    double fraction = 0;  ///< progress towards the goal, from 0 to 1
    bool is_reached = false;
};

/// Contents of the picture during a calibration.
struct CalibrationScene {
    explicit CalibrationScene(const CalibrationCoverage& shown) : coverage(shown) {}

    CalibrationCoverage coverage;
    std::vector<Gauge> gauges;
    /// Angle of the image x axis on the sheet, or empty if the frame was not located.
    std::optional<double> theta_rad;
    bool is_taken = false;  ///< true if this frame was added to the calibration
};

/// Contents of the picture for one frame.
struct Scene {
    ImageView image;
    Trace trace;
    bool is_good = false;  ///< false to use a warning colour for the text and the position
    std::vector<std::string> lines;          ///< captions: pose, rate, quality
    std::span<const PathMark> path;          ///< the path of the robot up to this frame
    std::span<const draw::MapSheet> sheets;  ///< the sheets in the plane of the path
    bool y_up = false;                       ///< true if y points up in the plane
    /// Calibration gauges, which are shown instead of the sheets and the path.
    std::optional<CalibrationScene> calibration;
};

struct ScreenOptions {
    bool has_window = false;
    std::string record;  ///< path of the video file, or empty for none
    double fps = 30;     ///< frame rate of the video file
    /// Called with a message for the user if H.264 is not available. The file is then larger.
    std::function<void(const std::string&)> notify = [](const std::string&) {};
};

/// Draws into the window and writes the video file. The OpenCV module, which is loaded at run time,
/// implements this class (video/module.hpp).
class ScreenOutput {
  public:
    virtual ~ScreenOutput() = default;
    /// Each of these functions implements the function of the same name in Screen.
    virtual bool show(const Scene& scene) = 0;
    virtual void finish() = 0;
    virtual bool is_wanted() = 0;
};

class Screen {
  public:
    /// The window and the file are opened when the first scene is shown. Throws Error if the video
    /// module cannot be loaded.
    explicit Screen(const ScreenOptions& options);

    /// Returns true if there is a window or a recording.
    bool is_on() const;

    /// Shows and records a scene. Does nothing if `is_on()` is false. Returns false if the user
    /// closed the window or pressed q or Escape in it. Throws Error if the scene cannot be shown or
    /// recorded.
    bool show(const Scene& scene);

    /// Completes the recording. Throws Error if it is incomplete, for example because the disk is
    /// full.
    void finish();

    /// Handles window events while there is no new scene. Returns false if the user closed the
    /// window or pressed q or Escape in it.
    bool is_wanted();

  private:
    /// Null if there is neither a window nor a recording.
    std::unique_ptr<ScreenOutput> output_;
};

/// Returns true if a window can be opened, that is, if an X server answers. The X server may be
/// part of a Wayland session.
bool has_display();

}  // namespace dotpose::video
