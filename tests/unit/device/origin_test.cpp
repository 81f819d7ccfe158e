// Tests the computation of the grid origin from the phases of the dots. Dots may be displaced,
// missing or spurious.
#include "device/origin.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "../core/geometry.hpp"

namespace dotpose::core_test::origin_test {
namespace {

constexpr std::uint64_t kSeed = 26;
constexpr Vec2 kImage_px{188, 120};
constexpr Vec2 kCentre_px{93.5, 59.5};

Vec2 origin_of(const std::vector<DetectedDot>& dots, const Mesh& mesh, Vec2 near_px) {
    std::vector<std::uint16_t> seeds(dots.size());
    std::iota(seeds.begin(), seeds.end(), std::uint16_t{0});
    Lattice lattice = lattice_of(mesh);
    lattice.origin_q16 = {};
    core::find_origin(dots, seeds, fixed(near_px, 8), lattice);
    EXPECT_EQ(lattice.u_q16, fixed(mesh.u, 16));
    EXPECT_EQ(lattice.v_q16, fixed(mesh.v, 16));
    return real(lattice.origin_q16, 16);
}

/// Returns the distance, in spacings, from a point to the nearest intersection. The distance is the
/// larger of its components along the axes of the grid.
double off_intersection(const Mesh& mesh, Vec2 p) {
    const Vec2 g = mesh.inverse(p);
    return std::max(std::abs(g.x - std::round(g.x)), std::abs(g.y - std::round(g.y)));
}

/// Expects that the origin is the intersection nearest to `near_px`, within `tolerance` spacings.
void expect_origin(const std::vector<DetectedDot>& dots, const Mesh& mesh, Vec2 near_px,
                   double tolerance) {
    const Vec2 origin = origin_of(dots, mesh, near_px);
    EXPECT_LT(off_intersection(mesh, origin), tolerance);
    const Vec2 g = mesh.inverse(origin) - mesh.inverse(near_px);
    EXPECT_LT(std::max(std::abs(g.x), std::abs(g.y)), 0.5 + tolerance);
}

/// Runs a check on grids with various spacings, angles and phases.
template <typename Check>
void for_many_grids(Check check) {
    Rng rng(kSeed);
    for (const double spacing : {6.0, 8.5, 11.0, 16.0, 30.0}) {
        for (int angle = 0; angle < 360; angle += 15) {
            SCOPED_TRACE(testing::Message()
                         << "spacing " << spacing << ", " << angle << " degrees, seed " << kSeed);
            const Vec2 origin = kCentre_px + Vec2{rng.uniform(-0.5, 0.5) * spacing,
                                                  rng.uniform(-0.5, 0.5) * spacing};
            check(square_mesh(spacing, radians(angle), origin), rng);
        }
    }
}

TEST(Origin, IsThatOfAPlainGrid) {
    for_many_grids([](const Mesh& mesh, Rng&) {
        const auto dots =
            dots_of(placed_dots(mesh, 20, kImage_px, [](int, int) { return Vec2{}; }));
        // The tolerance allows for the rounding of dot centres to 1/8 px.
        expect_origin(dots, mesh, kCentre_px, 0.02);
    });
}

TEST(Origin, IsTheMeanOfDisplacedDots) {
    // Each dot is displaced by 1/6 spacing along one random axis, which is 0.12 spacings rms per
    // axis. The mean of 9 x 9 dots is displaced by 0.013 spacings, and that of a dozen dots by
    // 0.035 spacings. If the grid were half a cell off, the error would be 0.5 spacings.
    for_many_grids([](const Mesh& mesh, Rng& rng) {
        const auto dots = dots_of(
            placed_dots(mesh, 20, kImage_px, [&](int, int) { return random_displacement(rng); }));
        expect_origin(dots, mesh, kCentre_px, 1 / 12.0);
    });
}

TEST(Origin, BearsDotsThatAreMissingOrFalse) {
    for_many_grids([](const Mesh& mesh, Rng& rng) {
        std::vector<DetectedDot> dots;
        for (const PlacedDot& d :
             placed_dots(mesh, 20, kImage_px, [&](int, int) { return random_displacement(rng); })) {
            const double fate = rng.uniform();
            if (fate > 0.2) dots.push_back(dot_at(d.centre_px));
            // One cell in ten has a second dot at a random position.
            if (fate < 0.9) continue;
            dots.push_back(dot_at(
                mesh.at(d.cell.x + rng.uniform(-0.5, 0.5), d.cell.y + rng.uniform(-0.5, 0.5))));
        }
        expect_origin(dots, mesh, kCentre_px, dots.size() > 60 ? 1 / 12.0 : 1 / 8.0);
    });
}

TEST(Origin, OnlyDotsAFewCellsAwayHaveASay) {
    // The origin must not depend on distant dots. If an axis is slightly too long, the expected
    // positions of distant dots are wrong by up to half a cell.
    for_many_grids([](const Mesh& mesh, Rng&) {
        const auto displaced_far_away = [](int i, int j) {
            return std::max(std::abs(i), std::abs(j)) <= 6 ? Vec2{} : Vec2{0.3, -0.3};
        };
        const auto dots = dots_of(placed_dots(mesh, 20, kImage_px, displaced_far_away));
        expect_origin(dots, mesh, mesh.origin, 0.02);
    });
}

TEST(Origin, LiesNearAnyPointAskedFor) {
    const Mesh mesh = square_mesh(11, 0.4, kCentre_px);
    const auto dots = dots_of(placed_dots(mesh, 20, kImage_px, [](int, int) { return Vec2{}; }));
    for (double y = 30; y < 90; y += 4.7) {
        for (double x = 30; x < 158; x += 5.3)
            expect_origin(dots, mesh, {x, y}, 0.02);
    }
}

TEST(Origin, OnlySeedsHaveASay) {
    const Mesh mesh = square_mesh(11, 0.4, kCentre_px);
    auto dots = dots_of(placed_dots(mesh, 4, kImage_px, [](int, int) { return Vec2{}; }));
    std::vector<std::uint16_t> seeds(dots.size());
    std::iota(seeds.begin(), seeds.end(), std::uint16_t{0});
    for (int i = -4; i <= 4; ++i)
        dots.push_back(dot_at(mesh.at(i + 0.3, 0.3)));
    Lattice lattice = lattice_of(mesh);
    core::find_origin(dots, seeds, fixed(kCentre_px, 8), lattice);
    EXPECT_LT(length(real(lattice.origin_q16, 16) - kCentre_px), 0.02 * 11);
}

TEST(Origin, WithoutDotsIsThePointItself) {
    const Mesh mesh = square_mesh(11, 0.4, {});
    EXPECT_EQ(length(origin_of({}, mesh, kCentre_px) - kCentre_px), 0);
}

}  // namespace
}  // namespace dotpose::core_test::origin_test
