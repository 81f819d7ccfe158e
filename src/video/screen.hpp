// Shows the live picture of `dotpose watch` or `calibrate --live` in a window, writes it to a video
// file, or both.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dotpose/files/error.hpp"
#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/calibration_coverage.hpp"
#include "dotpose/trace.hpp"
#include "draw/track_map.hpp"

namespace dotpose::video {

/// A point of the path in some plane; after a jump, the path is drawn as a new stroke.
struct PathMark {
    double x = 0;
    double y = 0;
    bool is_jump = false;
};

/// How far something that is wanted has been reached.
struct Gauge {
    std::string label;
    std::string text;  ///< how much there is
    double share = 0;  ///< of what is wanted, up to 1
    bool is_reached = false;
};

/// What the picture shows while frames for a calibration are taken.
struct CalibrationScene {
    explicit CalibrationScene(const CalibrationCoverage& shown) : coverage(shown) {}

    CalibrationCoverage coverage;
    std::vector<Gauge> gauges;
    std::optional<double> theta_rad;  ///< direction of the frame, if it is located
    bool is_taken = false;            ///< whether this frame was taken
};

/// The contents of the picture of one frame.
struct Scene {
    ImageView image;
    Trace trace;                             ///< of this image
    bool is_good = false;                    ///< colour of the captions
    std::vector<std::string> lines;          ///< captions: pose, rate, quality
    std::span<const PathMark> path;          ///< the path up to this frame
    std::span<const draw::MapSheet> sheets;  ///< the sheets in the plane of the path
    bool y_up = false;                       ///< whether y points up in this plane
    /// Shown instead of the plan of sheets and path.
    std::optional<CalibrationScene> calibration;
};

struct ScreenOptions {
    bool has_window = false;
    std::string record;  ///< path of the video file; empty for none
    double fps = 30;     ///< frame rate of the video file
    /// Called with a message if the recording will not be what its name says best.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
};

/// Draws into the window and writes the file. The module implements it.
class ScreenOutput {
  public:
    virtual ~ScreenOutput() = default;
    /// Each as the function of Screen with the same name.
    virtual bool show(const Scene& scene) = 0;
    virtual void finish() = 0;
    virtual bool is_wanted() = 0;
};

class Screen {
  public:
    /// Throws Error if the window or file cannot be opened. They are opened with the first scene.
    explicit Screen(const ScreenOptions& options);

    /// Whether there is a window or a recording.
    bool is_on() const;

    /// Draws, shows and records a scene, if the screen is on. Returns false if the user closed the
    /// window or pressed q or Escape in it. Throws Error if this fails.
    bool show(const Scene& scene);

    /// Closes the recording. Throws Error if it is not complete, as on a full disk.
    void finish();

    /// Handles events of the window when there is nothing new to show. Returns false like `show`.
    bool is_wanted();

  private:
    std::unique_ptr<ScreenOutput> output_;  ///< null if there is nothing to show
};

/// Whether a window can be opened: an X server answers, which may be that of a Wayland session.
bool has_display();

}  // namespace dotpose::video
