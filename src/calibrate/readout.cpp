// Finds the readout time of a rolling shutter from frames captured during a drive. The camera moves
// during the readout of each frame, by its velocity multiplied by the readout time. The velocity is
// computed from the previous and the next frame, and the readout time is fitted to all frames.
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <fmt/core.h>

#include "calibrate/located_frame.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/mounted_pose.hpp"

namespace dotpose {
namespace {

using Eigen::Vector2d;

/// A frame captured during the drive. Lengths are in spacings.
struct Moving {
    Cell cell;
    Section section;
    Vector2d fraction;
    Vector2d motion;  ///< motion of the camera during the readout
};

/// Locates all frames. Returns one element for each frame, in frame order. An element is empty if
/// the velocity cannot be computed from its frame.
std::vector<std::optional<Moving>> locate_drive(int frames, const FrameAt& frame_at,
                                                const Camera& camera,
                                                const CalibrateOptions& options) {
    std::vector<std::optional<Moving>> drive;
    Locator locator{DeviceOptions{}};
    CodeReader reader(given_code(options));
    for (int i = 0; i < frames; ++i) {
        const GreyImage image = frame_at(i);
        DeviceOptions how;
        use_camera(camera, image.width_px, image.height_px, how);
        locator.set_options(how);
        const Fix seen = reader.locate(image.view(), locator);
        const auto [fix, velocity] = with_camera_and_velocity(seen, camera, locator.trace());
        if (options.progress && !options.progress(i + 1, frames))
            throw Error("stopped; nothing was written");
        drive.emplace_back();
        if (!velocity) continue;
        drive.back() = Moving{fix.cell,
                              fix.section,
                              {fix.fraction_x_q16 / 65536.0, fix.fraction_y_q16 / 65536.0},
                              {velocity->x_per_s, velocity->y_per_s}};
    }
    return drive;
}

/// Returns the motion from one frame to another, in spacings. Returns an empty optional if either
/// frame has no fix, or if the frames are in different sections or more than kMaxCells apart.
std::optional<Vector2d> motion_between(const std::optional<Moving>& from,
                                       const std::optional<Moving>& to) {
    if (!from || !to || from->section != to->section) return {};
    const Vector2d cells{calibrate::steps(from->cell.x, to->cell.x),
                         calibrate::steps(from->cell.y, to->cell.y)};
    constexpr double kMaxCells = 1000;
    if (cells.norm() > kMaxCells) return {};
    return cells + to->fraction - from->fraction;
}

}  // namespace

ReadoutCalibration calibrate_readout(int frames, const FrameAt& frame_at, const Camera& camera,
                                     double interval_ms, const CalibrateOptions& options) {
    if (!camera.paper) {
        throw Error(
            "the camera file has no mm_per_px: calibrate the lens of the mounted camera first");
    }
    ReadoutCalibration result;
    result.frames = frames;
    result.camera = camera;
    // With a readout time of one second, the velocity in spacings per second is numerically equal
    // to the motion during the readout in spacings.
    result.camera.readout_ms = 1000;
    result.camera.reference_px.reset();
    result.camera.theta_offset_rad = 0;
    const auto drive = locate_drive(frames, frame_at, result.camera, options);
    double products = 0;
    double squares = 0;
    // For each frame used: the motion during the readout, and the motion per frame interval,
    // averaged over the intervals before and after the frame.
    std::vector<std::array<Vector2d, 2>> used;
    for (std::size_t i = 0; i < drive.size(); ++i) {
        result.located += drive[i] ? 1 : 0;
        if (i == 0 || i + 1 == drive.size() || !drive[i]) continue;
        const auto moved = motion_between(drive[i - 1], drive[i + 1]);
        if (!moved) continue;
        used.push_back({drive[i]->motion, *moved / 2});
        products += drive[i]->motion.dot(*moved) / 2;
        squares += moved->squaredNorm() / 4;
    }
    constexpr std::size_t kMinFrames = 5;
    if (used.size() < kMinFrames) {
        throw Error(
            fmt::format("only {} frames have located neighbours; at least {} are needed: "
                        "name more frames of the drive, in order",
                        used.size(), kMinFrames));
    }
    const double ratio = products / squares;
    double residual = 0;
    for (const auto& [motion, step] : used)
        residual += (motion - ratio * step).squaredNorm();
    const double sigma = std::sqrt(residual / (2.0 * double(used.size()) - 1) / squares);
    constexpr double kMaxSigma = 0.1;
    if (!(ratio > 0) || !(sigma < kMaxSigma * ratio)) {
        throw Error(
            "the motion during the readout is too small or does not agree with the motion from "
            "frame to frame: drive faster, name all frames in order, and check --fps; the camera "
            "may also have a global shutter");
    }
    result.camera = camera;
    result.camera.readout_ms = ratio * interval_ms;
    result.sigma_ms = sigma * interval_ms;
    result.camera.sigma["readout_ms"] = result.sigma_ms;
    result.motion = ratio * std::sqrt(squares / double(used.size()));
    return result;
}

}  // namespace dotpose
