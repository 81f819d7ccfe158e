// Screen: the live picture of `dotpose watch`, in a window, in a video file, or both.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dotpose/image.hpp"
#include "dotpose/options.hpp"
#include "dotpose/tools/error.hpp"
#include "dotpose/trace.hpp"
#include "draw/track_map.hpp"

namespace dotpose::video {

/// A point of the path, in any plane; a jump starts a new stroke.
struct PathMark {
    double x = 0;
    double y = 0;
    bool is_jump = false;
};

/// What the picture of one frame shows.
struct Scene {
    ImageView image;
    Trace trace;                             ///< of this image
    bool is_good = false;                    ///< colour of the captions
    std::vector<std::string> lines;          ///< captions: pose, rate, quality
    std::span<const PathMark> path;          ///< so far
    std::span<const draw::MapSheet> sheets;  ///< in the path's plane
    bool y_up = false;                       ///< of that plane
};

struct ScreenOptions {
    bool has_window = false;
    std::string record;  ///< video file; empty: none
    double fps = 30;     ///< of the video file
};

class Screen {
  public:
    /// Throws Error if the window or file cannot be opened. Nothing happens before the first scene.
    explicit Screen(const ScreenOptions& options);
    ~Screen();
    Screen(const Screen&) = delete;
    Screen& operator=(const Screen&) = delete;

    /// Whether anybody looks.
    bool is_on() const;

    /// Draws, shows and records. Throws Error. False if the user closed the window or pressed q or
    /// Escape in it.
    bool show(const Scene& scene);

    /// Closes the recording. Throws Error if it is not complete, as on a full disk.
    void finish();

    /// Without anything new to show. The same return value.
    bool is_wanted();

  private:
    class Output;
    std::unique_ptr<Output> output_;
};

/// Whether a window can be opened here: an X server answers, be it that of a Wayland session.
bool has_display();

}  // namespace dotpose::video
