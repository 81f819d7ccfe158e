/// The parts of the program: what each measures, and the tables that it makes of the results.
#pragma once

#include <string>
#include <vector>

#include <dotpose/tools/simulate.hpp>

#include "results.hpp"

namespace dotpose::bench {

// ---- Whole frames: locate_bench.cpp ----

void add_frame_benchmarks();

/// What one kind of frame took, in µs; 0 where it was not measured.
struct FrameTimes {
    CameraModel camera;
    double dots = 0;
    double locate_us = 0;
    double once_us = 0;  ///< `Effort::once`
    double tracked_us = 0;
    double device_us = 0;  ///< `Effort::device`
    double floor_us = 0;
    double tag_us[2] = {};  ///< libapriltag with decimate 1 and 2

    double megapixels() const { return 1e-6 * camera.width_px * camera.height_px; }
};
/// The sizes of frames, from small to large.
std::vector<FrameTimes> times_by_size(const Results& results);
/// Frames of one size that show more and more dots.
std::vector<FrameTimes> times_by_dots(const Results& results);
std::string size_table(const std::vector<FrameTimes>& times);
std::string dots_table(const std::vector<FrameTimes>& times);

// ---- Tilted cameras: tilt.cpp ----

/// Frames of one size, seen at one angle.
struct TiltTimes {
    CameraModel camera;
    int tilt_deg = 0;
    int frames = 0;
    int at_once = 0;  ///< located at the first attempt
    double median_us = 0;
};
/// Throws Error where a fix is wrong.
std::vector<TiltTimes> time_tilted_frames(bool is_quick);
std::string tilt_table(const std::vector<TiltTimes>& times);

// ---- Stages: stages_bench.cpp ----

void add_stage_benchmarks();
std::string stage_table(const Results& results);

// ---- The position code: code_bench.cpp ----

void add_code_benchmarks();
std::string code_table(const Results& results);

}  // namespace dotpose::bench
