#include "core/attempts/tracked.hpp"

#include <algorithm>
#include <cmath>

#include "core/attempts/confirm.hpp"
#include "core/attempts/steps.hpp"
#include "core/fixed.hpp"
#include "core/pose/refine.hpp"

namespace dotpose::core {
namespace {

/// Dots so near the image centre, in spacings, tell how far the prediction is off: few enough for a
/// turn not to mix them up.
constexpr float kCentre = 2.6F;
constexpr float kMostOff = 0.6F;

/// Position, scale and turn of least squares; perspective and shear stay as predicted.
bool fit_similarity(const Kernels& kernels, const MeasuredDots& dots, float reach_px,
                    float displacement, float most_off, int fewest_dots, FloatPlane& plane) {
    const FitSums sums = kernels.sum_similarity(dots, plane, displacement, reach_px, most_off * most_off);
    if (sums.points < static_cast<float>(fewest_dots)) return false;
    Normal normal(sums);
    if (!normal.decompose()) return false;
    const Parameters step = normal.unwhitened(normal.whitened(normal.right()));
    const float unit = 1 / reach_px;
    plane.at_x += step[0];
    plane.at_y += step[1];
    plane.du_x += step[2] * unit;
    plane.du_y += step[3] * unit;
    plane.dv_x -= step[3] * unit;
    plane.dv_y += step[2] * unit;
    return true;
}

/// Corrects the sight by the dots near the image centre. False if they are not there.
bool find_centre(const Kernels& kernels, const ImageView& image, const Options& options,
                 const Prediction& prediction, Sight& sight, Workspace& w) {
    FloatPlane& plane = sight.pattern_from_image;
    MeasuredDots& dots = w.measured;
    const float spacing = spacing_px(plane);
    const float reach = kCentre * spacing;
    CellsInView view = cells_in_view(image, options, sight, reach, 64, w);
    view.window_on_dot = true;
    view.step = 1;
    kernels.list_cells(view, dots);
    const float off =
        std::min(3 * static_cast<float>(prediction.sigma_q16) / 65536 + 0.1F, kMostOff);
    const int most_px = static_cast<int>(std::ceil(off * spacing));
    const int step_px = std::max((most_px + 3) / 6, 1);
    Vec shift;
    if (!kernels.find_shift(image, dots, most_px, step_px, shift, sight.depth_q8)) return false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(dots.count); ++i) {
        dots.window_u[i] += shift.x;
        dots.window_v[i] += shift.y;
    }
    plane = recentred(plane, {static_cast<float>(-shift.x), static_cast<float>(-shift.y)});
    constexpr int kCutOfDepth_q8 = 200;
    kernels.measure_windows(
        image, view, {half_window_px(spacing, 0.3F), sight.depth_q8 * kCutOfDepth_q8 >> 8}, dots);
    return fit_similarity(kernels, dots, reach, sight.displacement, 0.30F, 10, plane) &&
           fit_similarity(kernels, dots, reach, sight.displacement, 0.15F, 10, plane);
}

}  // namespace

bool locate_tracked(const Kernels& kernels, const ImageView& image, const Options& options,
                    const Prediction& prediction, Workspace& w) {
    forget_frame(w);
    Sight sight;
    const PlaneFromImage& plane = prediction.pattern_from_image;
    sight.pattern_from_image =
        recentred(float_plane(plane),
                  {static_cast<float>((image.width_px - 1) * 128 - plane.centre_q8.x) / 256,
                   static_cast<float>((image.height_px - 1) * 128 - plane.centre_q8.y) / 256});
    sight.place = prediction.place;
    sight.displacement = static_cast<float>(prediction.displacement_q16) / 65536;
    const float spacing = spacing_px(sight.pattern_from_image);
    if (!(spacing > 5 && spacing < 80) ||
        !(sight.displacement > 0.05F && sight.displacement < 0.4F))
        return false;
    count_from_centre(options.profile, sight);
    if (!find_centre(kernels, image, options, prediction, sight, w)) return false;
    if (!confirm(kernels, image, options, sight, w)) return false;
    w.fix.attempt = Attempt::tracked;
    return true;
}

}  // namespace dotpose::core
