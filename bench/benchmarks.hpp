/// The parts of the program, each of which measures something and makes tables of the results.
#pragma once

#include <string>
#include <vector>

#include <dotpose/tools/simulate.hpp>

#include "results.hpp"

namespace dotpose::bench {

// ---- Whole frames: locate_bench.cpp ----

void add_frame_benchmarks();

/// Times for one kind of frame in µs; 0 if not measured.
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
/// Returns the times for frames of several sizes, from small to large.
std::vector<FrameTimes> times_by_size(const Results& results);
/// Returns the times for frames of one size with an increasing number of dots.
std::vector<FrameTimes> times_by_dots(const Results& results);
std::string size_table(const std::vector<FrameTimes>& times);
std::string dots_table(const std::vector<FrameTimes>& times);

// ---- Tilted cameras: tilt.cpp ----

/// Results for frames of one size, seen at one tilt angle.
struct TiltTimes {
    CameraModel camera;
    int tilt_deg = 0;
    int frames = 0;
    int at_once = 0;  ///< number of frames located by the first attempt
    double median_us = 0;
};
/// Locates frames of tilted cameras. Throws Error if a fix is wrong.
std::vector<TiltTimes> time_tilted_frames(bool is_quick);
std::string tilt_table(const std::vector<TiltTimes>& times);

// ---- Hard frames: hard.cpp ----

/// Results for hard frames of 188 x 120 px, each with the faster of two looks at it.
struct HardTimes {
    int frames = 0;
    int located = 0;
    int at_once = 0;  ///< number of frames whose fix is that of the first attempt
    double median_ms = 0;
    double p99_ms = 0;
    double longest_ms = 0;
};
/// Locates frames of preset hard. Throws Error if a fix is wrong.
HardTimes time_hard_frames(int frames);
std::string hard_table(const HardTimes& times);

// ---- Stages: stages_bench.cpp ----

void add_stage_benchmarks();
std::string stage_table(const Results& results);

// ---- The position code: code_bench.cpp ----

void add_code_benchmarks();
std::string code_table(const Results& results);

}  // namespace dotpose::bench
