/// Sweep: the score of `locate` as a function of one condition, such as blur or tilt, in simulated
/// frames.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"
#include "dotpose/tools/evaluate.hpp"
#include "dotpose/tools/score.hpp"
#include "dotpose/tools/simulate.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// The condition that is varied, with its unit.
enum class SweepKind : std::uint8_t {
    noise,    ///< sensor noise, in grey levels
    blur,     ///< sigma of the lens blur, in px
    missing,  ///< percentage of dots that are not printed
    tilt,     ///< tilt of the camera about a random axis in the image, in degrees
    spacing,  ///< grid spacing in the image, in px
    /// Percentage of the image covered by a dark area, which extends from a random side and has a
    /// straight edge.
    occlusion,
};
/// All values of SweepKind, for iteration.
inline constexpr std::array kSweepKinds = {SweepKind::noise,   SweepKind::blur,
                                           SweepKind::missing, SweepKind::tilt,
                                           SweepKind::spacing, SweepKind::occlusion};
/// Returns the identifier, such as "occlusion".
const char* name(SweepKind kind);

/// Options for a sweep.
struct SweepOptions {
    Setup setup;  ///< setup of all frames, apart from the varied condition
    /// Number of frames per value. Frames with the same index differ only in the varied condition.
    int frames_per_value = 200;
    /// Options for `locate`. Both decoders are run, so `decoder` is ignored.
    DeviceOptions locate;
    int threads = 0;
    /// Called with the number of frames done and the total number of frames. If it returns false,
    /// `run_sweep` stops and returns the values for which all frames are done. If there are fewer
    /// than two such values, `run_sweep` throws Error.
    Progress progress;
};

/// The scores at one value of the condition.
struct SweepPoint {
    double value = 0;  ///< value of the condition, in the unit of its kind
    Score window;      ///< score with Decoder::window
    Score all;         ///< score with Decoder::all
};

/// Scores as a function of one condition.
struct Sweep {
    SweepKind kind = SweepKind::noise;
    Preset preset = Preset::nominal;
    int frames_per_value = 0;
    std::vector<SweepPoint> points;
};

/// Simulates and locates the frames for all values. Throws BadArgument if `frames_per_value` is
/// below 1, and Error if `progress` returns false before all frames for two values are done.
Sweep run_sweep(SweepKind kind, const SweepOptions& options);
/// Writes one line for each combination of value and decoder.
void write_sweep_csv(std::ostream& out, const Sweep& sweep);

/// Writes sweep-KIND.csv, .svg and .png.
void write_sweep(const std::filesystem::path& folder, const Sweep& sweep);

}  // namespace dotpose

DOTPOSE_END_EXPORT
