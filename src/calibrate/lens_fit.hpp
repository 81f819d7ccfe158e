// Least-squares fit to the dots in all frames. All frames share the camera parameters, and each
// frame has its own pose.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "calibrate/located_frame.hpp"

namespace dotpose::calibrate {

/// How the camera is held above the paper.
enum class Stand {
    ideal,    ///< perpendicular to the paper, same height in all frames, no lens distortion
    mounted,  ///< same height and tilt in all frames
    by_hand,  ///< a different height and tilt in each frame
};

/// Parameters that all frames share. The value of `Stand` determines which parameters are fitted.
/// Image positions are in px from the image centre. `reach` is half the diagonal of the image.
struct SharedModel {
    std::array<double, 3> lens{};  ///< k * reach^2, and the distortion centre in px
    /// Members of PaperScale, with the perspective multiplied by `reach`.
    std::array<double, 5> paper{};
    std::array<double, 3> shape{0, 1, 0};  ///< hand-held only: reach / focal length, aspect, skew
    double displacement = 1.0 / 6;         ///< displacement of the dots in the image, in spacings
};

struct LensFit {
    Stand stand = Stand::mounted;
    SharedModel camera;
    SharedModel sigma;  ///< standard deviations of `camera`
    /// Covariance of `camera.lens` and `camera.paper`. Set only if the camera is mounted.
    Eigen::MatrixXd mounted_covariance;
    /// Pose of each frame: x and y in mm relative to `LocatedFrame::place`, and the rotation in
    /// radians. For a hand-held camera, also mm per px and the two tilts in radians.
    std::vector<std::array<double, 6>> poses;
    /// Residual of each dot in each frame.
    std::vector<std::vector<std::array<double, 2>>> residuals_px;
    std::vector<std::vector<char>> is_outlier;
    double squares_px2 = 0;  ///< sum of the squared residuals of the dots used
    int dots = 0;            ///< number of dots used
    int parameters = 0;
    double residual_px = 0;  ///< rms residual per axis, corrected for the number of parameters
};

/// Size of the image in px, and spacing on the paper in mm.
struct FitSetting {
    int width_px = 0;
    int height_px = 0;
    double spacing_mm = 0;
    /// Returns half the diagonal of the image.
    double reach_px() const;
};

/// Fits the camera and the poses. Starts from `start` if it is not null. Excludes dots with
/// residuals above four standard deviations.
LensFit fit_lens(const std::vector<LocatedFrame>& frames, const FitSetting& setting, Stand stand,
                 const LensFit* start = nullptr);

/// Returns the position on the paper that the fit assigns to a pixel in a frame, in mm from
/// `LocatedFrame::place`.
std::array<double, 2> place_on_paper(const LensFit& fit, std::size_t frame, PixelPoint pixel,
                                     const FitSetting& setting);

}  // namespace dotpose::calibrate
