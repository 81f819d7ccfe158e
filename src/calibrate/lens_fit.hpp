// Lens fit: least squares over the dots of all frames, for one camera and one pose per frame.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "calibrate/located_frame.hpp"

namespace dotpose::calibrate {

/// How the camera was held over the paper.
enum class Stand {
    ideal,    ///< straight above, at one height, with a lens without distortion
    mounted,  ///< at one height and tilt in all frames
    by_hand,  ///< at its own height and tilt in each frame
};

/// The parameters that all frames share; which of them are used depends on the stand. Lengths in
/// the image are in px from the image centre; `reach` is half the image's diagonal.
struct SharedModel {
    std::array<double, 3> lens{};          ///< k reach^2, distortion centre
    std::array<double, 5> paper{};         ///< as PaperScale, with perspective times reach
    std::array<double, 3> shape{0, 1, 0};  ///< by hand: reach / focal length, aspect, skew
    double displacement = 1.0 / 6;         ///< displacement of the dots as seen, in spacings
};

/// The result of a fit.
struct LensFit {
    Stand stand = Stand::mounted;
    SharedModel camera;
    SharedModel sigma;  ///< standard deviations
    /// Covariance of `camera.lens` and `camera.paper`; only if mounted.
    Eigen::MatrixXd mounted_covariance;
    /// By frame: place (mm, from the intersection where its steps start) and turn; by hand also mm
    /// per px and tilt.
    std::vector<std::array<double, 6>> poses;
    std::vector<std::vector<std::array<double, 2>>> residuals_px;  ///< by frame and dot
    std::vector<std::vector<char>> is_outlier;
    double squares_px2 = 0;  ///< sum over the dots used
    int dots = 0;            ///< number of dots used
    int parameters = 0;
    double residual_px = 0;  ///< rms per axis, corrected for the parameters
};

/// The size of the image, and the spacing on the paper.
struct FitSetting {
    int width_px = 0;
    int height_px = 0;
    double spacing_mm = 0;
    /// Returns half the image's diagonal.
    double reach_px() const;
};

/// Fits camera and poses, starting from `start` if there is one. Dots more than four standard
/// deviations off are left out.
LensFit fit_lens(const std::vector<LocatedFrame>& frames, const FitSetting& setting, Stand stand,
                 const LensFit* start = nullptr);

/// Returns where a pixel of a frame lies on the paper by the fit, in mm from the intersection where
/// the frame's steps start.
std::array<double, 2> place_on_paper(const LensFit& fit, std::size_t frame, PixelPoint pixel,
                                     const FitSetting& setting);

}  // namespace dotpose::calibrate
