/// Fix: the pose computed from one frame, and the evidence that the pose is correct.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/geometry.hpp"
#include "dotpose/status.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// The attempt of `locate` that produced a fix. src/locate and src/device contain one source file
/// for each attempt.
enum class Attempt : std::uint8_t {
    tracked,  ///< the dots were measured at their predicted positions
    first,    ///< the grid was found in patches of the image, without a prediction
    second,   ///< the grid was found in the filtered image
    device,   ///< the frame was located in integer arithmetic, as on a microcontroller
};
/// Returns the identifier, such as "tracked".
const char* name(Attempt attempt) noexcept;

/// Flatness of the paper in view, as determined from the dots.
enum class Surface : std::uint8_t {
    even,     ///< one plane explains all dots
    divided,  ///< one part of the paper is displaced, for example at a step between two sheets; the
              ///< pose refers to the part under the reference point
    uneven,   ///< neighbouring dots have correlated residuals, as on wrinkled paper; the covariance
              ///< includes the effect of this correlation
};
/// Returns the identifier, such as "divided".
const char* name(Surface surface) noexcept;

/// The set of places that are assumed to be possible when `p_wrong_log2` is computed.
enum class Prior : std::uint8_t {
    plane,   ///< all places of the code
    sheets,  ///< places on the known sheets, after the bits of the frame ruled out other sheets
    only_sheets,  ///< places on the known sheets, because the caller declared other sheets
                  ///< impossible
};
/// Returns the identifier, such as "plane".
const char* name(Prior prior) noexcept;

/// Result of Locator::locate or DeviceLocator::locate. If `status` is not ok, only `status`,
/// `dots_seen` and the counts from completed stages are valid.
///
/// `cell + fraction` is the pattern point under the reference point, in spacings. The reference
/// point is the image centre by default. `theta` is the angle of the image x axis in the pattern
/// frame, from +x towards +y. On the paper, this direction is clockwise, because y points down.
struct Fix {
    Status status = Status::not_run;
    Attempt attempt = Attempt::first;
    Surface surface = Surface::even;  ///< always `even` from a DeviceLocator
    Prior prior = Prior::plane;       ///< see Locator::set_known

    /// Nearest intersection above and to the left of the reference point.
    Cell cell;
    std::uint16_t fraction_x_q16 = 0;  ///< x offset from `cell`, in units of 2^-16 spacings
    std::uint16_t fraction_y_q16 = 0;  ///< y offset from `cell`, in units of 2^-16 spacings
    /// Angle `theta` as a binary angle in [-2^31, 2^31), where 2^31 is half a turn.
    std::int32_t theta_bam = 0;
    Section section;                  ///< section in which the position was read
    std::int32_t spacing_px_q16 = 0;  ///< grid spacing in the image, in units of 2^-16 px
    /// Spacing of the printed grid, from the options. 0 if unknown.
    std::int32_t spacing_nm = 508'000;

    /// Number of frames whose bits were combined to find the position. Greater than 1 only if the
    /// caller provided the camera motion between the frames.
    int frames = 1;
    /// Number of dots found in the image, either as dot-sized blobs or at the positions predicted
    /// by the code.
    int dots_seen = 0;
    int dots_used = 0;  ///< number of dots in the pose fit
    /// Number of bits that disagree with the code at the position. Each cell contributes two bits.
    int bit_errors = 0;
    /// Upper bound on the probability that the position is wrong, as log2.
    int p_wrong_log2 = 0;
    /// Root mean square residual of the dots in the pose fit, per axis. 0 if the covariance is
    /// unknown.
    float residual_px = 0;

    /// Map from the image to the pattern, in spacings relative to `place`. The pose is computed by
    /// mapping the reference point and the direction of the image x axis at that point.
    /// `Prediction` contains the same map.
    PlaneFromImage pattern_from_image;
    Place place;  ///< origin of `pattern_from_image`
    /// Typical distance between a dot and its intersection, in units of 2^-16 spacings.
    std::int32_t displacement_q16 = 0;
    /// Change of theta during the readout of a rolling shutter, from the first to the last row. 0
    /// if the frame shows no significant rotation. The pose and `pattern_from_image` refer to the
    /// time at which the middle row was read.
    float readout_turn_rad = 0;

    /// Covariance of (x, y, theta) at the reference point, with x and y in spacings and theta in
    /// radians. All elements are 0 if the covariance is unknown.
    float covariance[3][3] = {};
    /// Returns true if the covariance is known. A DeviceLocator computes neither covariance nor
    /// residual.
    bool has_covariance() const { return covariance[0][0] > 0; }

    /// Returns true if the frame was located.
    explicit operator bool() const { return status == Status::ok; }

    // The functions below are inline, because the object code of the core must not use double
    // precision.
    double x_grid() const { return cell.x + fraction_x_q16 / 65536.0; }
    double y_grid() const { return cell.y + fraction_y_q16 / 65536.0; }
    /// Position in the pattern frame, in mm. NaN if the grid spacing is unknown.
    double x_mm() const { return x_grid() * spacing_mm(); }
    double y_mm() const { return y_grid() * spacing_mm(); }
    /// Spacing of the printed grid, in mm. NaN if unknown.
    double spacing_mm() const {
        return spacing_nm > 0 ? spacing_nm / 1e6 : std::numeric_limits<double>::quiet_NaN();
    }
    /// Angle of the image x axis in the pattern frame, in [-pi, pi).
    double theta_rad() const { return theta_bam * (std::numbers::pi / 2147483648.0); }
    double spacing_px() const { return spacing_px_q16 / 65536.0; }
    double p_wrong() const { return std::ldexp(1.0, p_wrong_log2); }
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
