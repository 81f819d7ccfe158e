#include "calibrate/dots_in_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "calibrate/dot_images.hpp"
#include "calibrate/located_frame.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d vector_of(PixelPoint point) {
    return {point.u, point.v};
}

/// Returns the pixel at which a point on the paper is seen, including lens distortion. The point
/// must be in front of the camera.
Vector2d pixel_of(const PatternView& view, const SpaceState& state, const Vector2d& place_mm) {
    const Vector3d seen =
        state.rotation.transpose() * (Vector3d(place_mm.x(), place_mm.y(), 0) - state.position_mm);
    const Pinhole& pinhole = view.pinhole;
    return vector_of(
        distorted(view.camera, {pinhole.centre_px.u + pinhole.focal_u_px * seen.x() / seen.z(),
                                pinhole.centre_px.v + pinhole.focal_v_px * seen.y() / seen.z()}));
}

/// Returns the maximum depth, in mm, at which dots can be measured. At larger depths, the spacing
/// in the image is too small.
double max_depth_mm(const PatternView& view) {
    const double focal_px = std::max(view.pinhole.focal_u_px, view.pinhole.focal_v_px);
    return focal_px * std::max(view.spacing_mm.x, view.spacing_mm.y) / kMinSpacing_px;
}

/// A rectangle of cells. The coordinates are steps from `trace.decoding.place`.
struct Cells {
    FixedVec first{INT32_MAX, INT32_MAX};
    FixedVec last{INT32_MIN, INT32_MIN};

    void add(double x, double y) {
        // The margin includes cells outside the image whose dots are displaced into the image. It
        // also includes cells beyond the sampled border points, because the image border may curve
        // outwards between these points.
        constexpr int kMargin = 2;
        const auto i = static_cast<std::int32_t>(std::lround(x));
        const auto j = static_cast<std::int32_t>(std::lround(y));
        first = {std::min(first.x, i - kMargin), std::min(first.y, j - kMargin)};
        last = {std::max(last.x, i + kMargin), std::max(last.y, j + kMargin)};
    }
};

/// Returns a rectangle that contains all cells in view, up to the maximum depth.
Cells cells_in_view(const PatternView& view, const SpaceState& state) {
    const double max_depth = max_depth_mm(view);
    const double last_u = view.camera.width_px - 1;
    const double last_v = view.camera.height_px - 1;
    Cells cells;
    constexpr int kParts = 8;
    const auto add = [&](double u, double v) {
        const PixelPoint straight = undistorted(view.camera, {u, v});
        const Pinhole& pinhole = view.pinhole;
        const Vector3d ray =
            state.rotation * Vector3d((straight.u - pinhole.centre_px.u) / pinhole.focal_u_px,
                                      (straight.v - pinhole.centre_px.v) / pinhole.focal_v_px, 1);
        const double depth = ray.z() > 0 ? -state.position_mm.z() / ray.z() : max_depth;
        const Vector3d at = state.position_mm + std::min(depth, max_depth) * ray;
        cells.add(at.x() / view.spacing_mm.x, at.y() / view.spacing_mm.y);
    };
    for (int i = 0; i <= kParts; ++i) {
        const double part = static_cast<double>(i) / kParts;
        add(part * last_u, 0);
        add(part * last_u, last_v);
        add(0, part * last_v);
        add(last_u, part * last_v);
    }
    return cells;
}

/// A dot of the code and its expected image.
struct CodedDot {
    CodeDot dot;
    ExpectedDot expected;
};

/// Returns all dots of the code that can be measured in the image.
std::vector<CodedDot> coded_dots(const ImageView& image, const PatternView& view,
                                 const Trace& trace, const SpaceState& state) {
    const double max_depth = max_depth_mm(view);
    const Vector3d axis = state.rotation.col(2);
    const Cells cells = cells_in_view(view, state);
    std::vector<CodedDot> dots;
    for (std::int32_t j = cells.first.y; j <= cells.last.y; ++j) {
        for (std::int32_t i = cells.first.x; i <= cells.last.x; ++i) {
            const Vector2d intersection(view.spacing_mm.x * i, view.spacing_mm.y * j);
            const double depth =
                axis.dot(Vector3d(intersection.x(), intersection.y(), 0) - state.position_mm);
            if (!(depth > 0) || depth > max_depth) continue;
            const Vector2d near = pixel_of(view, state, intersection);
            if (near.x() < -1 || near.y() < -1 || near.x() > view.camera.width_px ||
                near.y() > view.camera.height_px)
                continue;
            const auto dot = code_dot(view, trace, {i, j});
            if (!dot) continue;
            const Vector2d right(view.spacing_mm.x, 0);
            const Vector2d down(0, view.spacing_mm.y);
            const Vector2d shift =
                state.displacement * Vector2d(dx(dot->symbol), dy(dot->symbol)) + dot->offset;
            const Vector2d at = intersection + shift.x() * right + shift.y() * down;
            ExpectedDot expected;
            expected.pixel = pixel_of(view, state, at);
            // Approximates the derivatives by finite differences over the width of a dot.
            constexpr double kPart = 1.0 / 6;
            expected.px_per_spacing.col(0) = (pixel_of(view, state, at + kPart / 2 * right) -
                                              pixel_of(view, state, at - kPart / 2 * right)) /
                                             kPart;
            expected.px_per_spacing.col(1) = (pixel_of(view, state, at + kPart / 2 * down) -
                                              pixel_of(view, state, at - kPart / 2 * down)) /
                                             kPart;
            if (is_measurable(image, expected)) dots.push_back({*dot, expected});
        }
    }
    return dots;
}

}  // namespace

std::optional<CodeDot> code_dot(const PatternView& view, const Trace& trace, FixedVec step) {
    const CodeVariant code = trace.options.code;
    const Place place = moved(code, trace.decoding.place, step.x, step.y);
    CodeDot dot{step, symbol_at(code, place.cell, place.section)};
    if (view.map == nullptr) return dot;
    const auto index = view.map->index_of(place);
    if (!index || view.map->views[*index] == 0) return std::nullopt;
    const DotOffset& offset = view.map->offsets[*index];
    dot.offset = {offset.x(), offset.y()};
    return dot;
}

SpaceDot space_dot(const PatternView& view, const CodeDot& dot, PixelPoint undistorted) {
    const auto [x_mm, y_mm] = view.spacing_mm;
    return {{undistorted.u - view.pinhole.centre_px.u, undistorted.v - view.pinhole.centre_px.v},
            {x_mm * (dot.step.x + dot.offset.x()), y_mm * (dot.step.y + dot.offset.y())},
            {x_mm * dx(dot.symbol), y_mm * dy(dot.symbol)}};
}

std::vector<SpaceDot> dots_in_view(const ImageView& image, const PatternView& view,
                                   const Trace& trace, const SpaceState& state) {
    const std::vector<CodedDot> all = coded_dots(image, view, trace, state);
    const auto max_dots = static_cast<std::size_t>(std::max(trace.options.max_dots, 1));
    const double step =
        std::max(static_cast<double>(all.size()) / static_cast<double>(max_dots), 1.0);
    std::vector<CodedDot> chosen;
    for (double at = 0; at < static_cast<double>(all.size()); at += step)
        chosen.push_back(all[static_cast<std::size_t>(at)]);
    std::vector<ExpectedDot> expected;
    for (const CodedDot& dot : chosen)
        expected.push_back(dot.expected);
    const auto centres = measured_centres(image, expected);
    std::vector<SpaceDot> dots;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (!centres[i]) continue;
        const auto& [pixel, covariance] = *centres[i];
        dots.push_back(
            space_dot(view, chosen[i].dot, undistorted(view.camera, {pixel.x(), pixel.y()})));
        dots.back().centre_covariance = covariance;
    }
    return dots;
}

std::optional<SpaceFit> fit_to_image(const ImageView& image, const PatternView& view,
                                     const Trace& trace) {
    constexpr std::size_t kMinDots = 12;
    std::vector<SpaceDot> read;
    for (const LocatedDot& seen : dots_read(trace)) {
        if (const auto dot = code_dot(view, trace, seen.step))
            read.push_back(space_dot(view, *dot, seen.pixel));
    }
    if (read.size() < kMinDots) return std::nullopt;
    const Eigen::Vector2d focal_px(view.pinhole.focal_u_px, view.pinhole.focal_v_px);
    // Maximum number of dots in the first fit. This fit only needs to be accurate enough to predict
    // the positions of all dots.
    constexpr std::size_t kPart = 300;
    std::vector<SpaceDot> part;
    for (std::size_t i = 0; i < read.size(); i += 1 + read.size() / kPart)
        part.push_back(read[i]);
    const auto first = fit_space(part, focal_px);
    if (!first) return std::nullopt;
    const std::vector<SpaceDot> all = dots_in_view(image, view, trace, first->state);
    // If `dots_in_view` measures fewer than half as many dots as `locate` read, the dots are too
    // small in the image. In this case, the fit uses the dots read by `locate`.
    return fit_space(2 * all.size() < read.size() ? read : all, focal_px);
}

}  // namespace dotpose::calibrate
