#include "locate/tracked.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/math/fixed.hpp"
#include "core/pose/refine_pose.hpp"
#include "core/steps.hpp"
#include "locate/dot_reader.hpp"
#include "locate/trace.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::tracked;

/// Fits position, scale and rotation to the dots by least squares. Keeps the predicted perspective
/// and shear. Returns false if fewer than kMinNear dots are within `max_off` spacings of their
/// predicted positions.
bool fit_similarity(const Kernels& kernels, const MeasuredDots& dots, float reach_px,
                    float displacement, float max_off, FloatPlane& plane) {
    const ScaledPlane scaled(plane, reach_px);
    const FitSums sums =
        kernels.sum_fit(dots, plane, displacement, scaled.scale(), max_off * max_off);
    if (sums.points < tuned::kMinNear) return false;
    const auto& [x, y, xu, yv, yu, xv, au, av, aq] = sums.residuals;
    DotOffsets offsets;
    offsets.points = sums.points;
    offsets.u = sums.places[1];
    offsets.v = sums.places[2];
    offsets.squares = sums.places[3] + sums.places[5];
    offsets.off_u = x;
    offsets.off_v = y;
    offsets.along = xu + yv;
    offsets.across = yu - xv;
    const Similarity motion = similarity_of(offsets);
    plane = scaled.changed({motion.shift_px.x, motion.shift_px.y, motion.scale, motion.turn_rad});
    return true;
}

/// Returns the search radius in px, rounded up. The radius is min(3 sigma + 0.1, kMaxOff) spacings,
/// where sigma is the standard deviation of the prediction.
int max_shift_px(const Prediction& prediction, float spacing_px) {
    const float off = std::clamp(3 * static_cast<float>(prediction.sigma_q16) / 65536 + 0.1F, 0.1F,
                                 tuned::kMaxOff);
    return static_cast<int>(std::ceil(off * spacing_px));
}

/// Corrects the plane, using the centroids of the listed dots. Returns false if fewer than kMinNear
/// of the listed dots, or fewer than three quarters of them, have offsets of at most kMaxOffset_px.
bool correct_by_centroids(const Frame& frame, CellsInView view, FloatPlane& plane,
                          MeasuredDots& dots) {
    const float far_px = std::max(view.width_px, view.height_px) / 2;
    for (int look = 0; look < tuned::kMaxLooks; ++look) {
        if (look > 0) {
            view.plane = plane;
            frame.kernels.list_cells(view, dots);
        }
        const DotOffsets found = frame.kernels.find_centres(frame.image, view, tuned::kMaxOffset_px,
                                                            tuned::kWeight_px, dots);
        if (found.points < tuned::kMinNear || 4 * found.points < 3 * dots.count) return false;
        const Similarity motion = similarity_of(found);
        plane = moved(plane, motion);
        // Measures the dots again if the scale and rotation of the correction move dots at the
        // image border by kTurned_px or more, because centroid windows underestimate large offsets.
        const float moved_far_px =
            far_px * std::max(std::abs(motion.scale), std::abs(motion.turn_rad));
        if (moved_far_px < tuned::kTurned_px) break;
    }
    return true;
}

/// Corrects the hypothesis, using the dots near its `from_centre`. Returns false if the dots are
/// not found.
bool correct_by_dots(const Frame& frame, int max_px, Hypothesis& hypothesis,
                     const RollMemory& rolls, MeasuredDots& dots) {
    const Kernels& kernels = frame.kernels;
    const ImageView& image = frame.image;
    FloatPlane& plane = hypothesis.pattern_from_image;
    const float spacing = spacing_px(plane);
    const float reach = tuned::kNear * spacing;
    CellsInView view = cells_in_view(frame, hypothesis, reach, dots.capacity(), rolls);
    view.windows = Windows::on_dots;
    const bool by_centroids = can_sample_directly(hypothesis);
    // The centroid windows must be inside the image at every shift in the search range.
    if (by_centroids) view.margin_px = kPredictedCentroidRadius_px + static_cast<float>(max_px + 1);
    kernels.list_cells(view, dots);
    // Tests at most thirteen shifts along each axis, in steps of about max_px / 6.
    const int step_px = std::max((max_px + 3) / 6, 1);
    FixedVec shift;
    if (!kernels.find_shift(image, dots, max_px, step_px, shift, hypothesis.dot_contrast_q8))
        return false;
    const FloatVec shift_px{static_cast<float>(shift.x), static_cast<float>(shift.y)};
    plane = recentred(plane, {-shift_px.x, -shift_px.y});
    view.plane = plane;
    if (by_centroids) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(dots.count); ++i) {
            dots.x[i] += shift_px.x;
            dots.y[i] += shift_px.y;
        }
        FloatPlane corrected = plane;
        if (correct_by_centroids(frame, view, corrected, dots)) {
            plane = corrected;
            return true;
        }
    }
    // Measures the dots in windows around intersections, because these windows can measure larger
    // offsets than centroid windows.
    kernels.list_cells(view, dots);
    kernels.measure_windows(
        image, view, {spacing, 0.3F, hypothesis.dot_contrast_q8 * kContrastCut_q8 >> 8}, dots);
    return fit_similarity(kernels, dots, reach, hypothesis.displacement, tuned::kFirstOff, plane) &&
           fit_similarity(kernels, dots, reach, hypothesis.displacement, tuned::kSecondOff, plane);
}

/// Corrects the hypothesis, using the dots near `from`, an image point in px relative to the image
/// centre. Returns false if the dots are not found.
bool correct(const Frame& frame, FloatVec from, int max_px, Hypothesis& hypothesis,
             const RollMemory& rolls, MeasuredDots& dots) {
    hypothesis.from_centre = from;
    hypothesis.pattern_from_image = recentred(hypothesis.pattern_from_image, from);
    count_from_centre(frame.options.code, hypothesis);
    if (!correct_by_dots(frame, max_px, hypothesis, rolls, dots)) return false;
    move_origin_to_centre(hypothesis);
    return true;
}

bool is_in_code(const Place& place) {
    return place.cell.x < kPositionsPerAxis && place.cell.y < kPositionsPerAxis &&
           place.section.u < kSections && place.section.v < kSections;
}

/// Makes a hypothesis from the prediction, relative to the image centre. Returns nullopt if the
/// prediction is not plausible.
std::optional<Hypothesis> hypothesis_from(const Prediction& prediction, const Frame& frame) {
    const ImageView& image = frame.image;
    Hypothesis hypothesis;
    const PlaneFromImage& plane = prediction.pattern_from_image;
    const auto from_q8 = [](int side_px, std::int32_t centre_q8) {
        return (static_cast<float>(side_px - 1) * 128 - static_cast<float>(centre_q8)) / 256;
    };
    hypothesis.pattern_from_image = recentred(
        float_plane(plane),
        {from_q8(image.width_px, plane.centre_q8.x), from_q8(image.height_px, plane.centre_q8.y)});
    hypothesis.place = prediction.place;
    hypothesis.is_predicted = true;
    hypothesis.displacement = static_cast<float>(prediction.displacement_q16) / 65536;
    const float spacing = spacing_px(hypothesis.pattern_from_image);
    if (!is_in_code(hypothesis.place) || !is_plausible(image, hypothesis.pattern_from_image))
        return {};
    if (!(spacing > tuned::kFinest_px && spacing < tuned::kCoarsest_px)) return {};
    if (!(hypothesis.displacement > tuned::kMinDisplacement &&
          hypothesis.displacement < tuned::kMaxDisplacement))
        return {};
    count_from_centre(frame.options.code, hypothesis);
    return hypothesis;
}

/// Tries the image points kPoints in turn: corrects the hypothesis, using the dots near the point,
/// and tests the corrected hypothesis (see `confirm`). Returns true as soon as a corrected
/// hypothesis is confirmed.
bool confirm_corrected(const Frame& frame, const Hypothesis& hypothesis, int max_px,
                       const PlaceEvidence& evidence, Measurement& measurement, Fix& fix) {
    for (const FloatVec fraction : tuned::kPoints) {
        const FloatVec from{fraction.x * static_cast<float>(frame.image.width_px),
                            fraction.y * static_cast<float>(frame.image.height_px)};
        Hypothesis there = hypothesis;
        if (!correct(frame, from, max_px, there, measurement.rolls, measurement.dots)) continue;
        if (confirm(frame, there, evidence, measurement, fix) == Confirmation::ok) return true;
    }
    return false;
}

}  // namespace

bool confirm_prediction(const Frame& frame, const Prediction& prediction,
                        const PlaceEvidence& evidence, Measurement& measurement, Fix& fix) {
    const auto hypothesis = hypothesis_from(prediction, frame);
    if (!hypothesis) return false;
    const int max_px = max_shift_px(prediction, spacing_px(hypothesis->pattern_from_image));
    if (!confirm_corrected(frame, *hypothesis, max_px, evidence, measurement, fix)) return false;
    fix.attempt = Attempt::tracked;
    return true;
}

bool locate_tracked(const Frame& frame, const Prediction& prediction, DesktopWorkspace& w) {
    forget_frame(w);
    if (!confirm_prediction(frame, prediction, w.evidence(frame), w.measurement, w.fix))
        return false;
    store_for_trace(w.measurement, frame.options.show_stages, w);
    return true;
}

bool measure_again(const Frame& frame, const PlaceEvidence& evidence, Measurement& measurement,
                   Fix& fix) {
    auto hypothesis = hypothesis_from(Prediction::like(fix), frame);
    if (!hypothesis) return false;
    hypothesis->is_certain = true;
    return confirm_corrected(frame, *hypothesis, 1, evidence, measurement, fix);
}

}  // namespace dotpose::core
