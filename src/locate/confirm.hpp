// Confirm: the last step of the first and the tracked attempt. Measures the dots of a hypothesis,
// compares their bits with the code, and fits the pose.
#pragma once

#include "core/patch_memory.hpp"
#include "core/pose/turn_fit.hpp"
#include "dotpose/error_rate.hpp"
#include "dotpose/fix.hpp"
#include "locate/frame.hpp"
#include "locate/hypothesis.hpp"
#include "locate/place_evidence.hpp"

namespace dotpose::core {

/// Returns true if the plane describes a plausible view of paper across the whole image (see
/// `is_within_reason`). All stages reject implausible planes.
bool is_plausible(const ImageView& image, const FloatPlane& plane);

/// Returns true if the position does not explain the frame well: the displacement is not positive,
/// or
///
///     sqrt(variance) / displacement + bit_errors / bits > kMaxImplausible.
///
/// `bits` is the number of bits read, two per dot, and `bit_errors` is the number of these bits
/// that disagree with the code.
///
/// For example, two overlapping patterns that are nearly aligned can look like a third pattern,
/// with the columns of one pattern and the rows of the other. In such a frame, a quarter of the
/// cells have no dot at the expected position, and half of the dots are at a wrong position in
/// their cell. docs/integrity.md contains the measurements.
bool is_implausible(const PoseFit& fit, int bits, int bit_errors);

/// Returns true if the surface is uneven and less than half of the dots are inliers of the fitted
/// plane. If these inliers are in one part of the image, the plane can be wrong in the other part.
/// The covariance does not account for this error, because it assumes that all dots are near the
/// plane.
bool explains_few_dots(const PoseFit& fit, int dots_seen);

/// Result of `confirm`.
enum class Confirmation : std::uint8_t {
    ok,
    /// The plane is not plausible, or the dots or their bits contradict the hypothesis.
    implausible,
    uncertain,  ///< the hypothesis is plausible, but its position is not certain
    /// The hypothesis is plausible, but its position is not certain, for one of two reasons:
    /// - All bits in view (in small views, nearly all bits) are clear and agree with the code, but
    ///   there are too few of them.
    /// - A small view shows too few cells for a further attempt.
    too_few_bits,
    /// The fix is rough (see `is_rough`), and `Frame::defers_if_rough` is true. The place may be
    /// wrong, because it was not confirmed.
    rough,
};

/// Memory and results of `confirm`.
struct Measurement {
    MeasuredDots dots;
    RollMemory rolls;
    // Results for a confirmed hypothesis.
    Hypothesis hypothesis;              ///< confirmed hypothesis, with the fitted plane
    PlaneFromImage pattern_from_image;  ///< plane of `hypothesis`, in fixed point
    TurnFit turn;                       ///< fitted rotation, if `Frame::removed_turn` is not null
    /// Bits of the last hypothesis of an attempt whose bits were compared with the code within the
    /// deciding distance. None if there was no such hypothesis.
    ComparedBits compared;
    /// True if the frame shows too few cells for a reliable position, so further attempts are
    /// skipped. `confirm` sets this flag only if its result is `too_few_bits` and at least one of
    /// these conditions holds: the view is small, bits were read from dots that are cut off by the
    /// image border, or `are_too_few_cells` returns true.
    bool shows_too_few_cells = false;
    /// True if the first attempt found no certain place, but showed that the scene did not rotate
    /// during the readout, because a rotation would have moved some dots away from their predicted
    /// positions. The result of the attempt is either `too_few_bits`, so the bits are clear, or
    /// `uncertain` in a small view whose dots are close to the fitted plane.
    bool is_still = false;
    /// True if the result of the first attempt is `rough`.
    bool is_rough = false;
};

/// Tests a hypothesis: measures its dots, compares their bits with the code, and fits the pose. If
/// the hypothesis is predicted, and its dots can be sampled directly (see `can_sample_directly`),
/// tries direct sampling first.
///
/// If the result is ok or rough, sets the fix and the results in `measurement`. Otherwise, only
/// `p_wrong_log2`, `prior`, `frames` and `bit_errors` of the fix may have changed.
Confirmation confirm(const Frame& frame, Hypothesis hypothesis, const PlaceEvidence& evidence,
                     Measurement& measurement, Fix& fix);

/// Returns true if `count` cells are too few for a reliable position: even if all their bits are
/// clear and agree with the code, the agreement may be due to chance. Returns false if sheets are
/// known, because fewer cells can then be sufficient.
bool are_too_few_cells(const Frame& frame, int count);

/// Returns true if the residual of a fix is at least kRough_px and at least kRough spacings. A
/// second attempt may then give a better fix.
bool is_rough(const Fix& fix);
bool is_rough(float residual_px, float spacing_px);

}  // namespace dotpose::core
