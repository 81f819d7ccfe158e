#include "calibrate/seam_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotpose::calibrate {
namespace {

/// A fix may lie beyond the page whose dots it was read from: by at most a frame.
constexpr double kBeyondPage_mm = 400;
/// Once this share of a frame's dots is explained, no more parts are looked at.
constexpr double kNearlyAll = 0.9;

/// Along one axis: begin and length, as shares of the side.
struct Stretch {
    double begin;
    double length;
};
constexpr std::array kStretches = {Stretch{0, 1}, Stretch{0, 0.5}, Stretch{0.5, 0.5},
                                   Stretch{0, 0.66}, Stretch{0.34, 0.66}};

/// The mean cell of the dots that were read, as a fix that lies there.
Fix at_the_dots(const Fix& fix, const Workspace& w, Profile profile) {
    double i = 0;
    double j = 0;
    double count = 0;
    for (int row = w.grid.j0; row < w.grid.j0 + w.grid.rows; ++row) {
        for (int column = w.grid.i0; column < w.grid.i0 + w.grid.columns; ++column) {
            if (!w.grid.at(column, row).has_dot()) continue;
            i += column;
            j += row;
            ++count;
        }
    }
    const Vec middle{static_cast<std::int32_t>(std::lround(i / std::max(count, 1.0))),
                     static_cast<std::int32_t>(std::lround(j / std::max(count, 1.0)))};
    const Vec step = w.decoding.pattern_from_grid(middle);
    const Place place = moved(profile, w.decoding.place, step.x, step.y);
    Fix result = fix;
    result.cell = place.cell;
    result.section = place.section;
    return result;
}

}  // namespace

PlanePose PlanePose::operator*(const PlanePose& inner) const {
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return {x + c * inner.x - s * inner.y, y + s * inner.x + c * inner.y, turn + inner.turn};
}

PlanePose PlanePose::inverse() const {
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return {-c * x - s * y, s * x - c * y, -turn};
}

SeamLocator::SeamLocator(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera)
    : sheets_(sheets), camera_(camera), workspace_(std::make_unique<LargeWorkspace>()) {
    for (const SheetEntry& entry : sheets) {
        const Profile profile = entry.sheet.pattern.profile;
        if (std::ranges::find(profiles_, profile) == profiles_.end()) profiles_.push_back(profile);
    }
}

/// The whole, then halves and corners, then smaller and larger parts.
std::vector<SeamLocator::Part> SeamLocator::parts_of(const GreyImage& image) {
    std::vector<Part> parts;
    const auto cut = [](const Stretch& stretch, int side, int& begin, int& length) {
        begin = static_cast<int>(std::lround(stretch.begin * side));
        length = std::min(static_cast<int>(std::lround(stretch.length * side)), side - begin);
    };
    for (std::size_t most = 0; most < kStretches.size(); ++most) {
        for (std::size_t i = 0; i <= most; ++i) {
            for (std::size_t j = 0; j <= most; ++j) {
                if (std::max(i, j) != most) continue;
                Part part;
                cut(kStretches[i], image.width_px, part.u, part.width);
                cut(kStretches[j], image.height_px, part.v, part.height);
                if (std::min(part.width, part.height) >= kMinFrameSide_px) parts.push_back(part);
            }
        }
    }
    return parts;
}

std::vector<SheetView> SeamLocator::views(const GreyImage& image) {
    std::vector<SheetView> views = views_with(image, Effort::once);
    return views.empty() ? views_with(image, Effort::twice) : views;
}

std::vector<SheetView> SeamLocator::views_with(const GreyImage& image, Effort effort) {
    std::vector<SheetView> views;
    int dots_seen = 0;
    for (const Part& part : parts_of(image)) {
        const auto view = view_in(image, part, effort);
        dots_seen = std::max(dots_seen, workspace_->fix.dots_seen);  // first of all in the whole
        if (!view) continue;
        const auto same = std::ranges::find(views, view->sheet, &SheetView::sheet);
        if (same == views.end()) {
            views.push_back(*view);
        } else if (view->dots > same->dots) {
            *same = *view;
        }
        int dots = 0;
        for (const SheetView& known : views)
            dots += known.dots;
        if (dots > kNearlyAll * dots_seen) break;
    }
    return views;
}

std::optional<SheetView> SeamLocator::view_in(const GreyImage& image, const Part& part,
                                              Effort effort) {
    const ImageView pixels{image.view().row(part.v) + part.u, part.width, part.height,
                           image.view().stride_bytes};
    Camera camera;
    if (camera_) {
        camera = *camera_;
        if (camera.width_px != image.width_px || camera.height_px != image.height_px) {
            Options unused;
            use_camera(camera, image.width_px, image.height_px, unused);  // says what is wrong
        }
    } else {
        camera.centre_px = {(image.width_px - 1) / 2.0, (image.height_px - 1) / 2.0};
    }
    // The camera as it would be if its sensor ended with the part.
    camera.width_px = part.width;
    camera.height_px = part.height;
    camera.centre_px = {camera.centre_px.u - part.u, camera.centre_px.v - part.v};
    camera.reference_px =
        PixelPoint{(image.width_px - 1) / 2.0 - part.u, (image.height_px - 1) / 2.0 - part.v};
    camera.theta_offset_rad = 0;
    Options options;
    options.effort = effort;
    use_camera(camera, part.width, part.height, options);
    for (const Profile profile : profiles_) {
        options.profile = profile;
        const Fix fix =
            with_camera(locate(pixels, options, *workspace_), camera, options, *workspace_);
        if (fix.status != Status::ok) continue;
        if (auto view = view_of(fix, profile)) return view;
    }
    return std::nullopt;
}

std::optional<SheetView> SeamLocator::view_of(const Fix& fix, Profile profile) const {
    const auto place = find_sheet(sheets_, profile, at_the_dots(fix, *workspace_, profile));
    if (!place) return std::nullopt;
    // The image centre may lie on another sheet, or on none: on this one's page made larger.
    SheetEntry large = *place->entry;
    large.sheet.origin_x_mm += kBeyondPage_mm;
    large.sheet.origin_y_mm += kBeyondPage_mm;
    large.sheet.width_mm += 2 * kBeyondPage_mm;
    large.sheet.height_mm += 2 * kBeyondPage_mm;
    const auto centre = find_sheet(std::span(&large, 1), profile, fix);
    if (!centre) return std::nullopt;
    SheetView view;
    view.sheet = static_cast<std::size_t>(place->entry - sheets_.data());
    view.pose = {centre->x_mm - kBeyondPage_mm, centre->y_mm - kBeyondPage_mm, centre->theta_rad};
    view.dots = fix.dots_used;
    const double mm = large.sheet.pattern.spacing_mm;
    const Eigen::DiagonalMatrix<double, 3> units(mm, mm, 1);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            view.covariance(i, j) = static_cast<double>(fix.covariance[i][j]);
    }
    view.covariance = units * view.covariance * units;
    return view;
}

}  // namespace dotpose::calibrate
