/// Simulated pen: frames from a camera in a pen, and paths of handwriting.
///
///     const PenTip tip{0.5, 9, 20};
///     for (const PenSample& sample : simulate_handwriting({}))
///         save(render(shot_of_pen(shot, tip, sample.pose)));
///
/// Functions are pure and thread-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/tools/simulate.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Pose of a pen. The angles are those of `CameraLean`: a camera that looks straight at the paper
/// is first rotated by `turn_rad` about its optical axis, and then leans by `tilt_rad` in the
/// direction `azimuth_rad`.
struct PenPose {
    double x_mm = 0;  ///< position of the tip in the pattern frame
    double y_mm = 0;
    double height_mm = 0;  ///< height of the tip above the paper
    double tilt_rad = 0;
    double azimuth_rad = 0;
    double turn_rad = 0;
};

/// Returns a copy of `shot` with the camera in a pen that has the given pose. Sets the pose, the
/// working distance and the scale of the camera. The focal length in px, which is the ratio of
/// `working_distance_mm` to `mm_per_px`, does not change. Throws BadArgument if the camera does not
/// look down at the paper, or is not above it.
Shot shot_of_pen(const Shot& shot, const PenTip& tip, const PenPose& pose);

/// Options for simulated handwriting.
struct Handwriting {
    double x_mm = 0;  ///< position at which the writing begins, in the pattern frame
    double y_mm = 0;
    int strokes = 6;
    double rate_hz = 200;  ///< number of samples per second
    std::uint64_t seed = 1;
};

struct PenSample {
    double t_s = 0;
    PenPose pose;
    bool is_down = false;  ///< true if the tip is on the paper
};

/// Returns a path of random strokes with loops. The strokes form lines of four strokes each,
/// written from left to right. Between the strokes, the pen is lifted by 1 to 3 mm. After the last
/// stroke, the pen remains above the paper. At both ends of a stroke, the pen moves only
/// vertically. The tilt varies slowly between 20 and 40 degrees.
std::vector<PenSample> simulate_handwriting(const Handwriting& options);

}  // namespace dotpose

DOTPOSE_END_EXPORT
