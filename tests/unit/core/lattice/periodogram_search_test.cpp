// Tests the search for the grid in the periodogram of the dots. The search starts from inaccurate
// first estimates.
#include "core/lattice/periodogram_search.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "core/lattice/neighbours.hpp"

namespace dotpose::core_test::periodogram_search_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 46;

/// Returns the difference between two directions, in degrees. It is reduced modulo 90 degrees
/// because quarter turns do not change a square grid.
double turned_degrees(double a_rad, double b_rad) {
    return std::remainder(a_rad - b_rad, std::numbers::pi / 2) * 180 / std::numbers::pi;
}

TEST(SearchPeriodogram, RecoversTheGridWithAThirdOfTheDotsMissing) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        const double spacing = rng.uniform(8, 30);
        const double angle = rng.uniform(-3.1, 3.1);
        const Vec2 image{24 * spacing, 20 * spacing};
        const Vec2 centre{(image.x - 1) / 2, (image.y - 1) / 2};
        const Mesh mesh = square_mesh(
            spacing, angle, centre + Vec2{rng.uniform(0, spacing), rng.uniform(0, spacing)});
        const auto displacement = [&](int, int) { return random_displacement(rng); };
        std::vector<PlacedDot> placed;
        for (const PlacedDot& dot : placed_dots(mesh, 40, image, displacement)) {
            if (rng.uniform() > 0.3) placed.push_back(dot);
        }
        const std::vector<DetectedDot> dots = dots_of(placed);
        std::array<std::uint16_t, kMaxSeeds> seeds;
        const int count = choose_seeds(dots, fixed(centre, 8), seeds);
        ASSERT_GE(count, 150);

        const double off = i % 2 == 0 ? 1.06 : 0.94;
        const bool is_anywhere = i % 8 < 4;
        const double turned = radians(is_anywhere ? 40 : 6) * (i % 4 < 2 ? 1 : -1);
        Lattice lattice = lattice_of(square_mesh(off * spacing, angle + turned, centre));
        search_periodogram(dots, std::span(seeds).first(static_cast<std::size_t>(count)),
                           fixed(centre, 8), is_anywhere ? 45 : 12, lattice);
        const Mesh found = mesh_of(lattice);
        EXPECT_NEAR(length(found.u) / spacing, 1, 0.01);
        EXPECT_NEAR(turned_degrees(std::atan2(found.u.y, found.u.x), angle), 0, 0.5);
        EXPECT_NEAR(length(found.v) / spacing, 1, 0.01);
        EXPECT_NEAR(turned_degrees(std::atan2(found.v.y, found.v.x), angle), 0, 0.5);
        // The origin may be at any intersection. With 150 dots, each displaced by 0.12 spacings
        // (rms per axis), the standard error of the origin is 0.01 spacings.
        const Vec2 at = mesh.inverse(found.origin);
        EXPECT_NEAR(std::remainder(at.x, 1), 0, 0.06);
        EXPECT_NEAR(std::remainder(at.y, 1), 0, 0.06);
    }
}

TEST(SearchPeriodogram, RecoversTheGridThatATiltedCameraSees) {
    // The camera is tilted by 30 degrees about a random axis. The tilt foreshortens the grid in one
    // direction by a factor of cos(30 degrees).
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        const double spacing = rng.uniform(8, 30);
        const double axis = rng.uniform(-3.1, 3.1);
        const auto seen = [&](Vec2 p) {
            const Vec2 along{std::cos(axis), std::sin(axis)};
            const double lost = (1 - std::cos(radians(30))) * (p.x * along.x + p.y * along.y);
            return p - lost * along;
        };
        const Vec2 image{24 * spacing, 20 * spacing};
        const Vec2 centre{(image.x - 1) / 2, (image.y - 1) / 2};
        const Mesh flat = square_mesh(spacing, rng.uniform(-3.1, 3.1), centre);
        const Mesh mesh{seen(flat.u), seen(flat.v), centre};
        const auto displacement = [&](int, int) { return random_displacement(rng); };
        const std::vector<DetectedDot> dots = dots_of(placed_dots(mesh, 40, image, displacement));
        std::array<std::uint16_t, kMaxSeeds> seeds;
        const int count = choose_seeds(dots, fixed(centre, 8), seeds);
        // The search starts from a square grid whose spacing is 3 % too small.
        Lattice lattice = lattice_of({0.97 * flat.u, 0.97 * flat.v, centre});
        search_periodogram(dots, std::span(seeds).first(static_cast<std::size_t>(count)),
                           fixed(centre, 8), 12, lattice);
        const Mesh found = mesh_of(lattice);
        EXPECT_LT(length(found.u - mesh.u), 0.02 * spacing);
        EXPECT_LT(length(found.v - mesh.v), 0.02 * spacing);
    }
}

TEST(SearchPeriodogram, LeavesAGoodEstimateGood) {
    const Vec2 centre{150, 120};
    const Mesh mesh = square_mesh(12, 0.3, {153, 118});
    const auto dots = dots_of(placed_dots(mesh, 30, {301, 241}, [](int, int) { return Vec2{}; }));
    std::array<std::uint16_t, kMaxSeeds> seeds;
    const int count = choose_seeds(dots, fixed(centre, 8), seeds);
    Lattice lattice = lattice_of(mesh);
    search_periodogram(dots, std::span(seeds).first(static_cast<std::size_t>(count)),
                       fixed(centre, 8), 12, lattice);
    const Mesh found = mesh_of(lattice);
    // The search ends with steps of 1/8 degree and 1/640 of the spacing.
    EXPECT_NEAR(length(found.u), 12, 12.0 / 640);
    EXPECT_NEAR(turned_degrees(std::atan2(found.u.y, found.u.x), 0.3), 0, 0.13);
    const Vec2 at = mesh.inverse(found.origin);
    EXPECT_NEAR(std::remainder(at.x, 1), 0, 0.01);
    EXPECT_NEAR(std::remainder(at.y, 1), 0, 0.01);
}

}  // namespace
}  // namespace dotpose::core_test::periodogram_search_test
