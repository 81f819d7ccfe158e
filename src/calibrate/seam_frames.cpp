#include "calibrate/seam_frames.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "calibrate/dot_fit.hpp"
#include "calibrate/least_squares.hpp"
#include "dotpose/files/sheet_place.hpp"

namespace dotpose::calibrate {
namespace {

/// Maximum distance, in mm, between the image centre and a page whose dots are in the frame.
constexpr double kBeyondPage_mm = 400;
/// Minimum number of dots in a view. With fewer dots, the scales along the axes of the view are not
/// reliable.
constexpr std::size_t kMinViewDots = 30;
constexpr int kFieldsPerSide = 8;
/// The search in a frame ends when the located sheets cover at least this many of the frame's 64
/// fields (SheetView::fields). The number of dots is not a suitable criterion, because a fix
/// contains only the dots of one sheet.
constexpr int kNearlyAllFields = 58;

/// Interval along one side of the image: begin and length, as fractions of the side.
struct Stretch {
    double begin;
    double length;
};
constexpr std::array kStretches = {Stretch{0, 1}, Stretch{0, 0.5}, Stretch{0.5, 0.5},
                                   Stretch{0, 0.66}, Stretch{0.34, 0.66}};

/// Returns a copy of the fix, moved to the intersection that is `step` spacings from
/// `trace.decoding.place`.
Fix moved_to(const Fix& fix, const Trace& trace, FixedVec step) {
    const Place place = moved(trace.options.code, trace.decoding.place, step.x, step.y);
    Fix result = fix;
    result.cell = place.cell;
    result.section = place.section;
    result.fraction_x_q16 = result.fraction_y_q16 = 0;
    return result;
}

FixedVec mean_step(const std::vector<LocatedDot>& dots) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const LocatedDot& dot : dots)
        sum += Eigen::Vector2d(dot.step.x, dot.step.y);
    sum /= static_cast<double>(std::max<std::size_t>(dots.size(), 1));
    return {static_cast<std::int32_t>(std::lround(sum.x())),
            static_cast<std::int32_t>(std::lround(sum.y()))};
}

/// Returns the fields of the image (`SheetView::fields`) that contain the given dots. The pixel
/// coordinates of the dots are relative to the top left corner of `part`.
std::uint64_t fields_of(const GreyImage& image, const SeamLocator::Part& part,
                        const std::vector<LocatedDot>& dots) {
    const auto field = [](double pixel, int side_px) {
        return std::clamp(static_cast<int>(kFieldsPerSide * pixel / side_px), 0,
                          kFieldsPerSide - 1);
    };
    std::uint64_t fields = 0;
    for (const LocatedDot& dot : dots) {
        const int column = field(part.u + dot.pixel.u, image.width_px);
        const int row = field(part.v + dot.pixel.v, image.height_px);
        fields |= std::uint64_t{1} << (kFieldsPerSide * row + column);
    }
    return fields;
}

/// Position of a fix on a sheet, in nominal mm from the sheet's first intersection. The position
/// may be outside the page.
struct NominalPlace {
    Eigen::Vector2d mm;
    double theta_rad;
};
std::optional<NominalPlace> place_beyond(const SheetEntry& entry, CodeVariant code,
                                         const Fix& fix) {
    SheetEntry large = entry;
    large.print_scale_x = large.print_scale_y = 1;
    large.sheet.origin_x_mm = large.sheet.origin_y_mm = kBeyondPage_mm;
    large.sheet.width_mm += 2 * kBeyondPage_mm;
    large.sheet.height_mm += 2 * kBeyondPage_mm;
    const auto place = find_sheet(std::span(&large, 1), code, fix);
    if (!place) return std::nullopt;
    return NominalPlace{{place->x_mm - kBeyondPage_mm, place->y_mm - kBeyondPage_mm},
                        place->theta_rad};
}

/// Sets the place, axes and errors of `view` by fitting an affine map to the dots. `camera` must
/// contain the view of the paper. `first` is the position on the sheet, in nominal mm, of the
/// intersection whose `LocatedDot::step` is (0, 0).
void see_with_scale(const std::vector<LocatedDot>& dots, const Camera& camera,
                    const Eigen::Vector2d& first, double spacing_mm, SheetView& view) {
    std::vector<Eigen::Vector2d> points;
    for (const LocatedDot& dot : dots) {
        const CameraPoint point = on_paper(camera, dot.pixel);
        points.emplace_back(point.x_mm, point.y_mm);
        view.middle += points.back() / static_cast<double>(dots.size());
    }
    // Parameters: the position (x, y), the 2 x 2 matrix of the axes in column-major order, and the
    // displacement.
    std::vector<DotEquation> equations;
    for (std::size_t i = 0; i < dots.size(); ++i) {
        const Eigen::Vector2d p = points[i] - view.middle;
        const LocatedDot& dot = dots[i];
        equations.push_back({AxisEquation{{1, 0, p.x(), 0, p.y(), 0, -spacing_mm * dx(dot.symbol)},
                                          first.x() + spacing_mm * dot.step.x},
                             AxisEquation{{0, 1, 0, p.x(), 0, p.y(), -spacing_mm * dy(dot.symbol)},
                                          first.y() + spacing_mm * dot.step.y}});
    }
    const DotFit fit = fit_dots(equations, 7);
    view.place = {fit.parameters[0], fit.parameters[1]};
    view.axes << fit.parameters[2], fit.parameters[4], fit.parameters[3], fit.parameters[5];
    view.whitening = whitening_of(fit.covariance.topLeftCorner(6, 6));
    view.rows = 6;
}

/// Sets the place, axes and errors of `view` for a camera file that contains no view of the paper.
/// In this case, the fix determines only the position of the image centre and the direction of the
/// image x axis.
void see_without_scale(const Fix& fix, const NominalPlace& centre, double spacing_mm,
                       SheetView& view) {
    const double c = std::cos(centre.theta_rad);
    const double s = std::sin(centre.theta_rad);
    view.place = centre.mm;
    view.axes << c, -s, s, c;
    const std::array units = {spacing_mm, spacing_mm, 1.0};
    Eigen::MatrixXd covariance(3, 3);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            covariance(Eigen::Index(i), Eigen::Index(j)) =
                units[i] * units[j] * static_cast<double>(fix.covariance[i][j]);
        }
    }
    const Eigen::MatrixXd whitening = whitening_of(covariance);
    for (Eigen::Index i = 0; i < 3; ++i) {
        // Only the errors of the position and of the x axis are known. The error of the x axis is
        // perpendicular to the axis, along (-s, c), because only the angle of the axis was
        // measured.
        view.whitening.row(i) << whitening(i, 0), whitening(i, 1), -s * whitening(i, 2),
            c * whitening(i, 2), 0, 0;
    }
    view.rows = 3;
}

}  // namespace

SeamLocator::SeamLocator(const std::vector<SheetEntry>& sheets, const std::optional<Camera>& camera)
    : sheets_(sheets), camera_(camera) {
    for (const SheetEntry& entry : sheets) {
        const CodeVariant code = entry.sheet.pattern.code;
        if (std::ranges::find(codes_, code) == codes_.end()) codes_.push_back(code);
    }
}

/// Returns the parts in the order in which they are located: first the whole image, then halves and
/// quarters, and finally overlapping parts that are about two thirds as long as the image along at
/// least one axis.
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
    for (const Part& part : parts_of(image)) {
        const auto view = view_in(image, part, effort);
        if (!view) continue;
        const auto same = std::ranges::find(views, view->sheet, &SheetView::sheet);
        if (same == views.end()) {
            views.push_back(*view);
        } else if (view->dots.size() > same->dots.size()) {
            *same = *view;
        }
        std::uint64_t fields = 0;
        for (const SheetView& known : views)
            fields |= known.fields;
        if (std::popcount(fields) >= kNearlyAllFields) break;
    }
    return views;
}

/// Returns the camera with its sensor cropped to the part. The reference point of the result is the
/// centre of the whole image.
Camera SeamLocator::camera_of(const GreyImage& image, const Part& part) const {
    Camera camera;
    if (camera_) {
        camera = *camera_;
        if (camera.width_px != image.width_px || camera.height_px != image.height_px) {
            DeviceOptions unused;
            // Throws an Error that describes the wrong image size.
            use_camera(camera, image.width_px, image.height_px, unused);
        }
    } else {
        camera.centre_px = {(image.width_px - 1) / 2.0, (image.height_px - 1) / 2.0};
    }
    camera.width_px = part.width;
    camera.height_px = part.height;
    camera.centre_px = {camera.centre_px.u - part.u, camera.centre_px.v - part.v};
    camera.reference_px =
        PixelPoint{(image.width_px - 1) / 2.0 - part.u, (image.height_px - 1) / 2.0 - part.v};
    return camera;
}

std::optional<SheetView> SeamLocator::view_in(const GreyImage& image, const Part& part,
                                              Effort effort) {
    const ImageView pixels{image.view().row(part.v) + part.u, part.width, part.height,
                           image.view().stride_bytes};
    const Camera camera = camera_of(image, part);
    DeviceOptions options;
    options.effort = effort;
    options.show_stages = true;
    use_camera(camera, part.width, part.height, options);
    for (const CodeVariant code : codes_) {
        options.code = code;
        locator_.set_options(options);
        const Fix fix = locator_.locate(pixels);
        if (fix.status != Status::ok) continue;
        if (auto view = view_of(image, part, fix, camera, code)) return view;
    }
    return std::nullopt;
}

std::optional<SheetView> SeamLocator::view_of(const GreyImage& image, const Part& part,
                                              const Fix& fix, const Camera& camera,
                                              CodeVariant code) const {
    const Trace trace = locator_.trace();
    std::vector<LocatedDot> dots = dots_read(trace);
    const auto sheet = find_sheet(sheets_, code, moved_to(fix, trace, mean_step(dots)));
    if (!sheet) return std::nullopt;
    const SheetEntry& entry = *sheet->entry;
    const double spacing_mm = entry.sheet.pattern.spacing_mm;
    SheetView view;
    view.sheet = static_cast<std::size_t>(&entry - sheets_.data());
    // Removes dots beyond the edge of the sheet, because they belong to a different sheet.
    std::erase_if(dots, [&](const LocatedDot& dot) {
        const Cell cell = moved(code, trace.decoding.place, dot.step.x, dot.step.y).cell;
        const bool is_on = cell.x - entry.sheet.origin.x < unsigned(entry.sheet.columns) &&
                           cell.y - entry.sheet.origin.y < unsigned(entry.sheet.rows);
        if (is_on) view.dots.push_back(std::uint64_t{cell.x} << 32 | cell.y);
        return !is_on;
    });
    if (dots.size() < kMinViewDots) return std::nullopt;
    view.fields = fields_of(image, part, dots);
    if (camera.paper) {
        const auto first = place_beyond(entry, code, moved_to(fix, trace, {0, 0}));
        if (!first) return std::nullopt;
        see_with_scale(dots, camera, first->mm, spacing_mm, view);
    } else {
        const auto centre = place_beyond(entry, code, fix);
        if (!centre) return std::nullopt;
        see_without_scale(fix, *centre, spacing_mm, view);
    }
    return view;
}

}  // namespace dotpose::calibrate
