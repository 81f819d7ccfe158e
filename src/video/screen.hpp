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

/// Progress towards one requirement.
struct Gauge {
    std::string label;
    std::string text;  ///< the present value
    double share = 0;  ///< fraction of the requirement, up to 1
    bool is_reached = false;
};

/// Contents of the picture during a calibration.
struct CalibrationScene {
    explicit CalibrationScene(const CalibrationCoverage& shown) : coverage(shown) {}

    CalibrationCoverage coverage;
    std::vector<Gauge> gauges;
    std::optional<double> theta_rad;  ///< direction of the frame; none if it is not located
    bool is_taken = false;            ///< whether this frame was taken
};

/// The contents of the picture of one frame.
struct Scene {
    ImageView image;
    Trace trace;                             ///< trace of this image
    bool is_good = false;                    ///< colour of the captions
    std::vector<std::string> lines;          ///< captions: pose, rate, quality
    std::span<const PathMark> path;          ///< the path up to this frame
    std::span<const draw::MapSheet> sheets;  ///< the sheets in the plane of the path
    bool y_up = false;                       ///< whether y points up in this plane
    /// The calibration, which replaces the plan of sheets and path.
    std::optional<CalibrationScene> calibration;
};

struct ScreenOptions {
    bool has_window = false;
    std::string record;  ///< path of the video file; empty for none
    double fps = 30;     ///< frame rate of the video file
    /// Called with a message if the format of the recording is not the preferred one for its name.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
};

/// Draws into the window and writes the file. The module implements it.
class ScreenOutput {
  public:
    virtual ~ScreenOutput() = default;
    /// Implement the functions of Screen with the same names.
    virtual bool show(const Scene& scene) = 0;
    virtual void finish() = 0;
    virtual bool is_wanted() = 0;
};

class Screen {
  public:
    /// Throws Error if the window or file cannot be opened. Both are opened with the first scene.
    explicit Screen(const ScreenOptions& options);

    /// Whether there is a window or a recording.
    bool is_on() const;

    /// Draws, shows and records a scene if the screen is on. Returns false if the user closed the
    /// window or pressed q or Escape in it. Throws Error if this fails.
    bool show(const Scene& scene);

    /// Closes the recording. Throws Error if it is incomplete, for example if the disk is full.
    void finish();

    /// Handles window events when there is nothing new to show. Returns false like `show`.
    bool is_wanted();

  private:
    std::unique_ptr<ScreenOutput> output_;  ///< null if there is nothing to show
};

/// Whether a window can be opened: an X server answers, possibly in a Wayland session.
bool has_display();

}  // namespace dotpose::video
