// Computes the flat field of a camera from the mean of many frames. The camera must move between
// the frames, so that the dots darken all pixels of the mean equally.
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/core.h>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr int kMinFrames = 20;
/// Number of intervals between flat-field values along the longer side of the image. For vignetting
/// that darkens the corners by half, the interpolation error is then about 1 %.
constexpr double kIntervals = 10;

/// Returns the mean of the frames, relative to white, as a matrix with one row per image row.
MatrixXd mean_of(int frames, const FrameAt& frame_at, const std::optional<Camera>& camera,
                 const CalibrateOptions& options) {
    using Levels = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const GreyImage first = frame_at(0);
    const int width_px = camera ? camera->width_px : first.width_px;
    const int height_px = camera ? camera->height_px : first.height_px;
    MatrixXd sum = MatrixXd::Zero(height_px, width_px);
    for (int i = 0; i < frames; ++i) {
        const GreyImage image = frame_at(i);
        if (image.width_px != width_px || image.height_px != height_px) {
            throw Error(fmt::format("frame {} has {} x {} px, not {} x {} px", i + 1,
                                    image.width_px, image.height_px, width_px, height_px));
        }
        sum += Eigen::Map<const Levels>(image.pixels.data(), height_px, width_px).cast<double>();
        if (options.progress && !options.progress(i + 1, frames))
            throw Error("stopped; nothing was written");
    }
    return sum / (255.0 * frames);
}

/// Returns a matrix that interpolates the values of a flat field linearly along one axis. The
/// matrix has one row per pixel and one column per value. The values are equally spaced, from the
/// first to the last pixel.
MatrixXd interpolation(Index pixels, Index longer_side) {
    const double distance_px = std::max(static_cast<double>(longer_side - 1) / kIntervals, 1.0);
    const auto values = std::max(
        Index{2},
        static_cast<Index>(std::lround(static_cast<double>(pixels - 1) / distance_px)) + 1);
    MatrixXd weights = MatrixXd::Zero(pixels, values);
    for (Index pixel = 0; pixel < pixels; ++pixel) {
        const double at =
            static_cast<double>(pixel * (values - 1)) / static_cast<double>(pixels - 1);
        const Index first = std::min(static_cast<Index>(at), values - 2);
        weights(pixel, first + 1) = at - static_cast<double>(first);
        weights(pixel, first) = 1 - weights(pixel, first + 1);
    }
    return weights;
}

/// Solves `weights * x = values` by least squares, for each column.
MatrixXd fitted(const MatrixXd& weights, const MatrixXd& values) {
    return (weights.transpose() * weights).ldlt().solve(weights.transpose() * values);
}

}  // namespace

FlatFieldCalibration calibrate_flat_field(int frames, const FrameAt& frame_at,
                                          const std::optional<Camera>& camera,
                                          const CalibrateOptions& options) {
    if (frames < kMinFrames) {
        throw Error(fmt::format("{} frames for the flat field; at least {} are needed", frames,
                                kMinFrames));
    }
    const MatrixXd mean = mean_of(frames, frame_at, camera, options);
    const Index longer_side = std::max(mean.rows(), mean.cols());
    const MatrixXd by_row = interpolation(mean.rows(), longer_side);
    const MatrixXd by_column = interpolation(mean.cols(), longer_side);
    // The weights are products of column weights and row weights. The fit is therefore separable
    // into a fit along the columns and a fit along the rows.
    MatrixXd field = fitted(by_column, fitted(by_row, mean).transpose()).transpose();
    const MatrixXd smooth = by_row * field * by_column.transpose();

    FlatFieldCalibration result;
    result.frames = frames;
    result.residual = std::sqrt((mean.array() / smooth.array() - 1).square().mean());
    result.min_brightness = field.minCoeff() / field.maxCoeff();
    if (!(result.min_brightness >= kMinFlatField)) {
        throw Error(
            fmt::format("the darkest part of the image has less than {:g} % of the light "
                        "of the brightest part: light the paper more evenly",
                        100 * kMinFlatField));
    }
    // Maximum rms deviation of the mean of the frames from a smooth flat field. Dots cover a tenth
    // of the paper, which causes a deviation of 25 % in a single frame, and of 6 % in the mean of
    // 20 independent frames.
    constexpr double kMaxResidual = 0.08;
    if (!(result.residual <= kMaxResidual)) {
        throw Error(
            fmt::format("the mean of the frames deviates by {:.1f} % from a smooth flat "
                        "field: move the camera between frames, or take more frames",
                        100 * result.residual));
    }
    field /= field.maxCoeff();
    result.camera = camera.value_or(Camera{});
    if (!camera) {
        result.camera.width_px = static_cast<int>(mean.cols());
        result.camera.height_px = static_cast<int>(mean.rows());
        result.camera.centre_px = {static_cast<double>(mean.cols() - 1) / 2,
                                   static_cast<double>(mean.rows() - 1) / 2};
    }
    result.camera.flat_field.clear();
    for (const auto& row : field.rowwise())
        result.camera.flat_field.emplace_back(row.begin(), row.end());
    return result;
}

}  // namespace dotpose
