#include "draw/frame_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dotpose::draw {

Point from_q8(FixedVec q8) {
    return {q8.x / 256.0, q8.y / 256.0};
}

Point from_q16(FixedVec q16) {
    return {q16.x / 65536.0, q16.y / 65536.0};
}

Reached reached(const Trace& trace) {
    const Status status = trace.fix.status;
    Reached result;
    result.undistorted = !trace.dots.empty() && status != Status::too_few_dots;
    result.edges = !trace.edges.empty();
    result.axes = result.edges && trace.lattice.u_q16 != FixedVec{};
    result.cells = trace.grid.region.columns > 0;
    const GridRegion& window = trace.decoding.window;
    result.window = result.cells && window.columns > 0 && window.rows > 0 &&
                    trace.grid.contains(window.i0, window.j0) && status != Status::grid_too_small;
    result.pose = result.window && status == Status::ok;
    result.place = result.pose || (result.window && status == Status::not_certain);
    return result;
}

FixedVec window_corner(const Trace& trace) {
    const GridRegion& window = trace.decoding.window;
    const int q = trace.decoding.pattern_from_grid.quarters;
    return {q == 0 || q == 1 ? window.i0 : window.i0 + window.columns - 1,
            q == 0 || q == 3 ? window.j0 : window.j0 + window.rows - 1};
}

Place place_of(const Trace& trace, FixedVec grid_cell) {
    const FixedVec step = trace.decoding.pattern_from_grid(grid_cell);
    return moved(trace.options.code, trace.decoding.place, step.x, step.y);
}

Plane::Plane(const PlaneMap& map)
    : centre_px_{map.centre_px[0], map.centre_px[1]},
      at_centre_{map.at_centre[0], map.at_centre[1]},
      du_{map.du[0], map.du[1]},
      dv_{map.dv[0], map.dv[1]},
      perspective_{map.perspective[0], map.perspective[1]},
      lens_(map.lens),
      area_(du_.x * dv_.y - du_.y * dv_.x) {}

double Plane::divisor(Point from_centre_px) const {
    const Point& p = from_centre_px;
    const double divisor =
        1 + perspective_.x * p.x + perspective_.y * p.y + lens_ * (p.x * p.x + p.y * p.y);
    return std::clamp(divisor, 0.25, 4.0);
}

Point Plane::plane_point(Point image_px) const {
    const Point p = image_px - centre_px_;
    return at_centre_ + 1 / divisor(p) * (p.x * du_ + p.y * dv_);
}

Point Plane::image_point(Point plane_point) const {
    if (area_ == 0) return centre_px_;
    const Point d = 1 / area_ * (plane_point - at_centre_);
    const Point affine{d.x * dv_.y - d.y * dv_.x, d.y * du_.x - d.x * du_.y};
    Point p = affine;
    // Solves p = divisor(p) * affine by iteration. The iteration converges quickly, because the
    // divisor varies little within a frame.
    for (int round = 0; round < 20; ++round)
        p = divisor(p) * affine;
    return centre_px_ + p;
}

double Plane::spacing_px() const {
    return area_ == 0 ? 0 : 1 / std::sqrt(std::abs(area_));
}

FrameView::FrameView(ImageView image, const Trace& trace, double side)
    : trace_(trace),
      reached_(draw::reached(trace)),
      width_px_(std::max(image.width_px, 1)),
      height_px_(std::max(image.height_px, 1)),
      scale_(side / std::max(width_px_, height_px_)),
      k_(trace.options.lens.k_q40 * 0x1p-40),
      lens_centre_px_(Point{(width_px_ - 1) / 2, (height_px_ - 1) / 2} +
                      from_q8({trace.options.lens.centre_dx_q8, trace.options.lens.centre_dy_q8})),
      grid_(PlaneMap(trace.grid_from_image)),
      reference_px_(Point{(width_px_ - 1) / 2, (height_px_ - 1) / 2} +
                    from_q8({trace.options.reference_dx_q8, trace.options.reference_dy_q8})) {
    spacing_px_ = estimate_spacing_px();
    stroke_ = std::clamp(spacing() / 70, 0.2, 1.0);
}

bool FrameView::is_dense() const {
    constexpr double kLegibleSpacing = 16;
    return spacing() < kLegibleSpacing;
}

double FrameView::estimate_spacing_px() const {
    if (reached_.cells) return std::max(1.0, grid_.spacing_px());
    if (reached_.axes) {
        const Point u_px = from_q16(trace_.lattice.u_q16);
        const Point v_px = from_q16(trace_.lattice.v_q16);
        return std::max(1.0, (length(u_px) + length(v_px)) / 2);
    }
    std::vector<int> areas_px;
    for (const DetectedDot& dot : trace_.dots)
        areas_px.push_back(dot.area_px);
    if (areas_px.empty()) return 10;
    const auto middle = areas_px.begin() + static_cast<std::ptrdiff_t>(areas_px.size() / 2);
    std::nth_element(areas_px.begin(), middle, areas_px.end());
    // Without a grid, the spacing is estimated as three times the diameter of a typical dot.
    return 3 * std::sqrt(*middle * 4 / std::numbers::pi);
}

/// Inverts equation 2 of the paper by solving |p_u - m| = r / (1 + k r^2) for r.
Point FrameView::image_from_ideal(Point ideal_px) const {
    const Point r_u = ideal_px - lens_centre_px_;
    const double squared = r_u.x * r_u.x + r_u.y * r_u.y;
    const double root = std::sqrt(std::max(0.0, 1 - 4 * k_ * squared));
    return lens_centre_px_ + 2 / (1 + root) * r_u;
}

Point FrameView::at(Point ideal_px) const {
    const Point image_px = image_from_ideal(ideal_px);
    // Pixel (0, 0) is drawn as the square from 0 to `scale_`, so half a pixel is added.
    return scale_ * (image_px + Point{0.5, 0.5});
}

Point FrameView::at_dot(const DetectedDot& dot) const {
    const Point centre_px = from_q8(dot.centre_q8);
    return reached_.undistorted ? at(centre_px) : scale_ * (centre_px + Point{0.5, 0.5});
}

Point FrameView::at_grid(double i, double j) const {
    return at(grid_.image_point({i, j}));
}

Point FrameView::ahead_of_reference() const {
    const Plane pattern{PlaneMap(trace_.pattern_from_image)};
    // Step length in spacings, short enough that lens distortion does not noticeably change the
    // direction.
    constexpr double kShort = 0.1;
    const Point end_px = pattern.image_point(pattern.plane_point(reference_px_) + Point{kShort, 0});
    const Point ahead = at(end_px) - at(reference_px_);
    return 1 / std::max(length(ahead), 1e-9) * ahead;
}

}  // namespace dotpose::draw
