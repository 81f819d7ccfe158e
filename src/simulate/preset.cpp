#include <algorithm>
#include <cmath>
#include <numbers>

#include "dotpose/tools/simulate.hpp"

namespace dotpose {
namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

Vec2 draw_motion(Rng& rng, double longest_px) {
    const double length_px = rng.uniform(0, longest_px);
    const double direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    return {length_px * std::cos(direction_rad), length_px * std::sin(direction_rad)};
}

Imperfections draw_nominal(Rng& rng) {
    Imperfections drawn;
    drawn.paper_level = rng.uniform(150, 220);
    drawn.ink_variation = 0.03;
    drawn.vignetting = rng.uniform(0.05, 0.20);
    drawn.fall = rng.uniform(0, 0.15);
    drawn.fall_direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    drawn.blur_sigma_px = rng.uniform(0.4, 0.7);
    drawn.motion_px = draw_motion(rng, 0.5);
    drawn.noise_sigma = rng.uniform(2, 4);
    drawn.jitter_mm = 0.010;
    drawn.missing = 0.002;
    drawn.dirt_blobs = rng.uniform() < 0.2 ? 1 : 0;
    drawn.texture = 0.005;
    return drawn;
}

Imperfections draw_hard(Rng& rng) {
    Imperfections drawn;
    drawn.paper_level = rng.uniform(70, 230);
    drawn.ink_reflectance = rng.uniform(0.15, 0.30);
    drawn.ink_variation = 0.08;
    drawn.vignetting = rng.uniform(0.20, 0.50);
    drawn.fall = rng.uniform(0.05, 0.40);
    drawn.fall_direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    drawn.blur_sigma_px = rng.uniform(0.6, 1.1);
    drawn.motion_px = draw_motion(rng, 2);
    drawn.noise_sigma = rng.uniform(4, 9);
    drawn.salt_and_pepper = rng.uniform(0, 0.006);
    drawn.jitter_mm = rng.uniform(0.010, 0.025);
    drawn.missing = rng.uniform(0.005, 0.03);
    drawn.dirt_blobs = 3;
    drawn.graphics = rng.uniform() < 0.3 ? 1 + static_cast<int>(rng.below(2)) : 0;
    drawn.texture = 0.01;
    drawn.tilt_x_rad = radians(rng.uniform(-3, 3));
    drawn.tilt_y_rad = radians(rng.uniform(-3, 3));
    return drawn;
}

/// Returns random imperfections that are typical of an optical mouse, which has a simple lens with
/// strong vignetting, and a sensor whose pixels have different offsets.
Imperfections draw_mouse(Rng& rng) {
    Imperfections drawn;
    drawn.paper_level = rng.uniform(140, 200);
    drawn.ink_reflectance = 0.2;
    drawn.ink_variation = 0.03;
    drawn.vignetting = rng.uniform(0.30, 0.50);
    drawn.fall = rng.uniform(0, 0.20);
    drawn.fall_direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    drawn.blur_sigma_px = rng.uniform(0.4, 0.7);
    drawn.motion_px = draw_motion(rng, 0.5);
    drawn.noise_sigma = rng.uniform(2, 4);
    drawn.fixed_pattern = rng.uniform(2, 4);
    drawn.jitter_mm = 0.010;
    drawn.missing = 0.002;
    drawn.texture = 0.005;
    return drawn;
}

}  // namespace

const char* name(Preset preset) {
    switch (preset) {
        case Preset::clean:
            return "clean";
        case Preset::nominal:
            return "nominal";
        case Preset::hard:
            return "hard";
        case Preset::mouse:
            return "mouse";
    }
    return "?";
}

Imperfections draw_imperfections(Preset preset, Rng& rng) {
    switch (preset) {
        case Preset::clean:
            return {};
        case Preset::nominal:
            return draw_nominal(rng);
        case Preset::hard:
            return draw_hard(rng);
        case Preset::mouse:
            return draw_mouse(rng);
    }
    throw BadArgument("unknown preset");
}

double x_grid(const CameraPose& pose) {
    return pose.cell.x + pose.fraction_x;
}
double y_grid(const CameraPose& pose) {
    return pose.cell.y + pose.fraction_y;
}

Page page_of(const Sheet& sheet, std::uint64_t seed) {
    if (sheet.columns < 1 || sheet.rows < 1) throw BadArgument("the sheet has no intersections");
    return {sheet.pattern,
            seed,
            sheet.origin,
            static_cast<std::uint32_t>(sheet.columns),
            static_cast<std::uint32_t>(sheet.rows),
            {},
            {},
            {},
            Page{}.table_reflectance,
            {}};
}

Shot draw_shot(const Setup& setup, std::uint64_t index) {
    Rng rng(setup.seed, index);
    Shot shot;
    shot.camera = setup.camera;
    shot.page.pattern = setup.pattern;
    shot.page.seed = setup.seed;
    shot.pose.theta_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    shot.pose.fraction_x = rng.uniform();
    shot.pose.fraction_y = rng.uniform();
    const Section section{static_cast<std::uint8_t>(rng.below(kSections)),
                          static_cast<std::uint8_t>(rng.below(kSections))};
    if (setup.random_section) shot.page.pattern.section = section;
    const std::uint32_t place_x = rng.below(~std::uint32_t{0});
    const std::uint32_t place_y = rng.below(~std::uint32_t{0});
    shot.seed = rng.bits();
    shot.imperfections = draw_imperfections(setup.preset, rng);
    shot.pose.tilt_x_rad = shot.imperfections.tilt_x_rad;
    shot.pose.tilt_y_rad = shot.imperfections.tilt_y_rad;

    // The whole frame must be inside the code plane. The distance from the pose to the border of
    // the plane is therefore at least half the diagonal of the frame.
    const Projection projection(shot.camera, shot.pose);
    double reach_mm = 0;
    for (const int u : {0, shot.camera.width_px - 1}) {
        for (const int v : {0, shot.camera.height_px - 1}) {
            const Vec2 corner = projection.offset_from_pixel({1.0 * u, 1.0 * v});
            reach_mm = std::max(reach_mm, std::hypot(corner.x, corner.y));
        }
    }
    const double margin = std::ceil(reach_mm / setup.pattern.spacing_mm) + 2;
    if (!(2 * margin < kPositionsPerAxis)) throw BadArgument("the frame is larger than the plane");
    const std::uint32_t first = static_cast<std::uint32_t>(margin);
    const std::uint64_t range = kPositionsPerAxis - 2 * first;
    shot.pose.cell.x = first + static_cast<std::uint32_t>((place_x * range) >> 32);
    shot.pose.cell.y = first + static_cast<std::uint32_t>((place_y * range) >> 32);
    return shot;
}

}  // namespace dotpose
