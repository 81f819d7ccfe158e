/// Declares the measurements of dotpose_bench and the tables of their results, grouped by source
/// file.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

#include <dotpose/tools/simulate.hpp>

#include "results.hpp"

namespace dotpose::bench {

// ---- Whole frames: locate_bench.cpp ----

void add_frame_benchmarks();

/// Times for one kind of frame, in µs. A time is 0 if it was not measured.
struct FrameTimes {
    CameraModel camera;
    double dots = 0;
    double locate_us = 0;
    double once_us = 0;  ///< `Effort::once`
    double tracked_us = 0;
    double device_us = 0;  ///< `Effort::device`
    double floor_us = 0;
    double tag_us[2] = {};  ///< libapriltag with `decimate` = 1, and with `decimate` = 2

    double megapixels() const { return 1e-6 * camera.width_px * camera.height_px; }
};
/// Returns the times for frames of several sizes, ordered by size.
std::vector<FrameTimes> times_by_size(const Results& results);
/// Returns the times for frames of one size, ordered by the number of dots.
std::vector<FrameTimes> times_by_dots(const Results& results);
std::string size_table(const std::vector<FrameTimes>& times);
std::string dots_table(const std::vector<FrameTimes>& times);

// ---- Figures in docs/speed.md: plots.cpp ----

/// Plots the times against the number of pixels.
void draw_pixels(std::ostream& out, const std::vector<FrameTimes>& times);
/// Plots the times against the number of dots in frames of one size.
void draw_dots(std::ostream& out, const std::vector<FrameTimes>& times);

// ---- Individual frames: varied.cpp ----

/// Methods of processing a frame, in the order of the table rows.
enum class Way : std::uint8_t {
    twice,
    once,
    narrow,   ///< first attempt with 16-byte vectors, as on a processor without AVX2
    tracked,  ///< tracking, with predictions off by up to a third of a spacing and 2 degrees
    device,
    floor,
    apriltag_1,
    apriltag_2,
};
inline constexpr std::size_t kWays = 8;

/// Time statistics of one method over all frames, in µs. The time of a frame is its shortest time
/// over all passes.
struct FrameSpread {
    int frames = 0;
    int found = 0;
    double median_us = 0;
    double p99_us = 0;
    double longest_us = 0;

    double longest_over_median() const { return longest_us / median_us; }
    double p99_over_median() const { return p99_us / median_us; }
};

struct Varied {
    std::array<FrameSpread, kWays> spreads;
    const FrameSpread& of(Way way) const { return spreads[static_cast<std::size_t>(way)]; }
};

/// Measures the time that every method takes for single frames of 188 x 120 px. libapriltag
/// processes `frames` / 10 frames with tags. All other methods process `frames` nominal frames.
/// Each frame is measured `passes` times. Throws Error if a fix is wrong.
Varied time_varied_frames(int frames, int passes);
std::string varied_table(const Varied& varied);

// ---- Tilted cameras: tilt.cpp ----

/// Results for frames of one size at one tilt angle.
struct TiltTimes {
    CameraModel camera;
    int tilt_deg = 0;
    int frames = 0;
    int by_first_attempt = 0;  ///< number of frames located by the first attempt
    double median_us = 0;
};
/// Measures how long `locate` takes for frames from tilted cameras. Throws Error if a fix is wrong.
std::vector<TiltTimes> time_tilted_frames(bool is_quick);
std::string tilt_table(const std::vector<TiltTimes>& times);

// ---- Small frames: small.cpp ----

/// Results for nominal frames of one size and one spacing. Each pass locates the frames of all
/// sizes once, so the processor cannot learn the branches of individual frames.
struct SmallTimes {
    int width_px = 0;
    int height_px = 0;
    double spacing_px = 0;
    int frames = 0;
    /// True if the rows of dots are nearly parallel to the image. The dots then have few different
    /// sub-pixel phases, and the pixel bias of their centres is corrected.
    bool is_parallel = false;
    int located = 0;
    int by_first_attempt = 0;  ///< number of frames located by the first attempt
    double median_us = 0;
    double longest_first_us = 0;  ///< longest time of a frame without a second attempt
    double longest_us = 0;
};
/// Measures how long `locate` takes for small square frames, and for comparison, as the first
/// element, for frames of 188 x 120 px. Throws Error if a fix is wrong.
std::vector<SmallTimes> time_small_frames(bool is_quick);
/// Returns the longest time of a small frame without a second attempt, relative to the median time
/// of the frames of 188 x 120 px.
double longest_first_ratio(const std::vector<SmallTimes>& times);
std::string small_table(const std::vector<SmallTimes>& times);

// ---- Hard frames: hard.cpp ----

/// Results for hard frames of 188 x 120 px. Each frame is measured twice, and its time is the
/// shorter of the two.
struct HardTimes {
    int frames = 0;
    int located = 0;
    int by_first_attempt = 0;  ///< number of frames located by the first attempt
    double median_ms = 0;
    double p99_ms = 0;
    double longest_ms = 0;
};
/// Measures how long `locate` takes for frames with the `hard` preset. Throws Error if a fix is
/// wrong.
HardTimes time_hard_frames(int frames);
std::string hard_table(const HardTimes& times);

// ---- Stages: stages_bench.cpp ----

void add_stage_benchmarks();
std::string stage_table(const Results& results);

// ---- The position code: code_bench.cpp ----

void add_code_benchmarks();
std::string code_table(const Results& results);

// ---- The machine: machine.cpp ----

/// Returns the load averages over the last 1, 5 and 15 minutes.
std::string load_average();

/// Returns a Markdown list that describes the processor, its caches, the compiler and the library.
std::string machine_list();

}  // namespace dotpose::bench
