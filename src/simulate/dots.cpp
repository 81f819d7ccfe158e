#include <algorithm>
#include <cmath>

#include "simulate/ink.hpp"

namespace dotpose::simulate {
namespace {

// Random printing errors of one dot. They depend only on the page and the cell, so they are the
// same in every frame.
struct DotErrors {
    double presence;  // uniform random number in [0, 1)
    Vec2 jitter;      // normal random numbers with standard deviation 1
    double ink;       // normal random number with standard deviation 1
};

DotErrors errors_of(const Page& page, Cell cell) {
    const Section section = page.pattern.section;
    const std::uint64_t sheet = page.seed * 4096 + section.u * std::uint64_t{64} + section.v;
    Rng rng(sheet, (std::uint64_t{cell.x} << 32) | cell.y);
    // Draws all random numbers even if an imperfection is switched off. Otherwise, switching it off
    // would change the other imperfections.
    DotErrors errors{};
    errors.presence = rng.uniform();
    errors.jitter.x = rng.normal();
    errors.jitter.y = rng.normal();
    errors.ink = rng.normal();
    return errors;
}

bool is_in_areas(const Page& page, std::int64_t x, std::int64_t y) {
    if (page.areas.empty()) return true;
    return std::any_of(page.areas.begin(), page.areas.end(), [&](const PageArea& area) {
        return area.distance(static_cast<double>(x), static_cast<double>(y)) <= 0;
    });
}

bool printed(const Page& page, std::int64_t x, std::int64_t y) {
    if (!is_in_areas(page, x, y)) return false;
    if (page.columns == 0) {
        return x >= 0 && y >= 0 && x < kPositionsPerAxis && y < kPositionsPerAxis;
    }
    const std::int64_t column = x - page.origin.x;
    const std::int64_t row = y - page.origin.y;
    return column >= 0 && row >= 0 && column < page.columns && row < page.rows;
}

Vec2 shift_of(const Page& page, Cell cell) {
    if (!page.shift_mm) return {};
    return page.shift_mm({static_cast<double>(cell.x), static_cast<double>(cell.y)});
}

/// Returns the reflectance of a dot. If `palest_ink` is less than 1, the reflectance depends on the
/// direction of the dot's displacement: dots displaced to the right are the darkest, followed by
/// down, left and up.
double reflectance_of(Vec2 displacement, const Imperfections& imperfections) {
    const double paleness = displacement.x > 0   ? 0
                            : displacement.y > 0 ? 1
                            : displacement.x < 0 ? 2
                                                 : 3;
    const double contrast = 1 - (1 - imperfections.palest_ink) * paleness / 3;
    return 1 - (1 - imperfections.ink_reflectance) * contrast;
}

}  // namespace

View::View(const CameraModel& camera_in, const CameraPose& pose_in, const Imperfections& blurred)
    : camera(camera_in),
      pose(pose_in),
      projection(camera_in, pose_in),
      margin_px(1 + 4 * blurred.blur_sigma_px +
                std::hypot(blurred.motion_px.x, blurred.motion_px.y) / 2) {}

OffsetBox visible_offsets(const View& view) {
    // Number of intervals into which each side of the image is divided. The corners are not
    // sufficient, because lens distortion may move the extreme offsets to any point of a side.
    constexpr int kSteps = 16;
    OffsetBox box{{1e300, 1e300}, {-1e300, -1e300}};
    const auto include = [&](double along_u, double along_v) {
        const Vec2 offset = view.projection.offset_from_pixel(
            {-view.margin_px + along_u * (view.camera.width_px - 1 + 2 * view.margin_px),
             -view.margin_px + along_v * (view.camera.height_px - 1 + 2 * view.margin_px)});
        box.low_mm = {std::min(box.low_mm.x, offset.x), std::min(box.low_mm.y, offset.y)};
        box.high_mm = {std::max(box.high_mm.x, offset.x), std::max(box.high_mm.y, offset.y)};
    };
    for (int step = 0; step <= kSteps; ++step) {
        const double along = static_cast<double>(step) / kSteps;
        include(along, 0);
        include(along, 1);
        include(0, along);
        include(1, along);
    }
    return box;
}

void add_disc(Ink& ink, const View& view, Vec2 offset_mm, double radius_mm, double reflectance) {
    const Projection& projection = view.projection;
    const Vec2 centre = projection.pixel_from_offset(offset_mm);
    const double away_u = std::abs(centre.x - (view.camera.width_px - 1) / 2.0);
    const double away_v = std::abs(centre.y - (view.camera.height_px - 1) / 2.0);
    const double reach_px = view.margin_px + 2 * radius_mm / view.camera.mm_per_px;
    if (away_u > view.camera.width_px / 2.0 + reach_px) return;
    if (away_v > view.camera.height_px / 2.0 + reach_px) return;

    // The projection is linearised across the dot, so the image of the dot is an ellipse. At 3
    // degrees of tilt and 60 px per spacing, the linearisation moves the centroid by less than
    // 0.001 px.
    const auto half = [&](Vec2 step) {
        const Vec2 ahead =
            projection.pixel_from_offset({offset_mm.x + step.x, offset_mm.y + step.y});
        const Vec2 back =
            projection.pixel_from_offset({offset_mm.x - step.x, offset_mm.y - step.y});
        return Vec2{(ahead.x - back.x) / 2, (ahead.y - back.y) / 2};
    };
    const Vec2 a = half({radius_mm, 0});
    const Vec2 b = half({0, radius_mm});
    ink.ellipses.push_back(
        {centre, a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y, reflectance});
}

void add_dots(Ink& ink, const View& view, const Page& page, const Imperfections& imperfections,
              const DisplacementOf& displacement_of) {
    const Pattern& pattern = page.pattern;
    const OffsetBox box = visible_offsets(view);
    const CameraPose& pose = view.pose;
    // Cell indices are relative to the cell of the pose, so offsets are precise anywhere on the
    // plane. The range includes an additional cell on each side, because displacement or jitter may
    // move dots from outside the view into it.
    const AxisScale scale = page.print_scale;
    const Vec2 spacing_mm{scale.x * pattern.spacing_mm, scale.y * pattern.spacing_mm};
    const auto first = [](double low, double fraction) {
        return static_cast<std::int64_t>(std::floor(low + fraction)) - 1;
    };
    const auto last = [](double high, double fraction) {
        return static_cast<std::int64_t>(std::ceil(high + fraction)) + 1;
    };
    const std::int64_t first_x = first(box.low_mm.x / spacing_mm.x, pose.fraction_x);
    const std::int64_t last_x = last(box.high_mm.x / spacing_mm.x, pose.fraction_x);
    const std::int64_t first_y = first(box.low_mm.y / spacing_mm.y, pose.fraction_y);
    const std::int64_t last_y = last(box.high_mm.y / spacing_mm.y, pose.fraction_y);

    for (std::int64_t y = first_y; y <= last_y; ++y) {
        for (std::int64_t x = first_x; x <= last_x; ++x) {
            if (!printed(page, pose.cell.x + x, pose.cell.y + y)) continue;
            const Cell cell{static_cast<std::uint32_t>(pose.cell.x + x),
                            static_cast<std::uint32_t>(pose.cell.y + y)};
            const DotErrors errors = errors_of(page, cell);
            if (errors.presence < imperfections.missing) continue;
            const Vec2 displacement = displacement_of(cell);
            const auto meant_mm = [&](std::int64_t i, double fraction, double moved) {
                return (static_cast<double>(i) - fraction) * pattern.spacing_mm +
                       moved * pattern.displacement_mm;
            };
            const Vec2 shift_mm = shift_of(page, cell);
            const Vec2 offset{scale.x * meant_mm(x, pose.fraction_x, displacement.x) + shift_mm.x +
                                  errors.jitter.x * imperfections.jitter_mm,
                              scale.y * meant_mm(y, pose.fraction_y, displacement.y) + shift_mm.y +
                                  errors.jitter.y * imperfections.jitter_mm};
            const double reflectance = reflectance_of(displacement, imperfections) +
                                       imperfections.ink_variation * errors.ink;
            add_disc(ink, view, offset, pattern.dot_mm / 2, std::clamp(reflectance, 0.0, 1.0));
        }
    }
}

DisplacementOf code_of(const Pattern& pattern) {
    return [pattern](Cell cell) {
        const Symbol symbol = symbol_at(pattern.code, cell, pattern.section);
        return Vec2{static_cast<double>(dx(symbol)), static_cast<double>(dy(symbol))};
    };
}

}  // namespace dotpose::simulate
