/// Pen: computes the position and height of a pen's tip from the pose of the camera in the pen. The
/// camera file must contain the focal length and the tip (see `calibrate_pivot`).
///
///     if (const auto pose = space_pose(fix, camera, image, trace)) {
///         const TipPose tip = tip_of(*pose, *camera.tip, camera.sigma);
///         if (contact.take(tip)) draw_to(tip.x_mm, tip.y_mm);
///     }
#pragma once

#include <array>
#include <map>
#include <string>

#include "dotpose/export.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/space_pose.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Position of a pen's tip in the pattern or sheet frame (x right, y DOWN).
struct TipPose {
    double x_mm = 0;
    double y_mm = 0;
    double height_mm = 0;  ///< height above the paper, nominally 0 while the pen rests on the paper
    /// Covariance of (x_mm, y_mm, height_mm). Includes the errors of the pose and of the tip
    /// position in the camera file.
    std::array<std::array<double, 3>, 3> covariance{};

    /// Returns the standard deviation along an axis: 0 for x, 1 for y, 2 for the height.
    double sigma_mm(std::size_t axis) const;
};

/// Returns the position of the tip in the coordinate frame of `pose`. `sigma` is `Camera::sigma`.
/// If `sigma` contains no standard deviations for the tip, `tip` is assumed to be exact.
TipPose tip_of(const SpacePose& pose, const PenTip& tip,
               const std::map<std::string, double>& sigma = {});

/// Converts a tip position from the pattern frame to the frame of a sheet.
TipPose on_sheet(const TipPose& tip, const SheetEntry& entry);

/// Detects with hysteresis whether a pen touches the paper. A pen on the paper is considered lifted
/// once its height reaches `kLift_mm` plus three standard deviations. A lifted pen is considered to
/// be on the paper again once its height falls below `kLift_mm`.
class PenContact {
  public:
    /// Assumed maximum height of the paper surface above its nominal plane. It is not 0 because
    /// paper on a table is not perfectly flat.
    static constexpr double kLift_mm = 0.05;

    /// `is_down` is true if the pen is initially on the paper.
    explicit PenContact(bool is_down = true) : is_down_(is_down) {}

    /// Processes the next pose. Returns true if the pen is on the paper.
    bool take(double height_mm, double sigma_mm);
    bool take(const TipPose& tip) { return take(tip.height_mm, tip.sigma_mm(2)); }

  private:
    bool is_down_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
