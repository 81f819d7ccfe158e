// The grid over the whole image from a rough estimate in its middle.
#include "core/lattice/refine.hpp"

#include <gtest/gtest.h>

#include "grids.hpp"

namespace dotpose::core_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 27;

TEST(RefineGrid, ReachesOverTheWholeImage) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const double spacing = rng.uniform(6, 60);
        const Vec2 image{std::min(spacing * rng.uniform(12, 50), 4096.0),
                         std::min(spacing * rng.uniform(10, 40), 4096.0)};
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed << ", " << image.x
                                        << " x " << image.y << " at " << spacing);
        Mesh mesh = square_mesh(spacing, rng.uniform(0, 6.3), {image.x / 2, image.y / 2});
        if (i % 2 == 1) mesh.v = mesh.v + rng.uniform(-0.1, 0.1) * mesh.u;  // seen from aside
        const auto placed =
            placed_dots(mesh, 45, image, [&](int, int) { return random_displacement(rng); });
        PlaneFromImage plane;
        ASSERT_EQ(refine_grid(dots_of(placed), {}, centre_q8(image), lattice_of(spoilt(mesh, rng)),
                              plane),
                  Status::ok);
        // Displacements are noise of 0.12 spacings here. At the corners, where it shows most, a fit
        // of 8 parameters to 100 dots or more is off by 0.12 sqrt(8 / 100) times 2, rarely 3 times
        // that.
        expect_grid(plane, placed, intersections(mesh, placed), 0.25);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(RefineGrid, ReachesOverATiltedPage) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        CameraModel camera;
        camera.width_px = 320;
        camera.height_px = 240;
        CameraPose pose;
        pose.theta_rad = rng.uniform(-3, 3);
        pose.tilt_x_rad = radians(rng.uniform(-8, 8));
        pose.tilt_y_rad = radians(rng.uniform(-8, 8));
        const Projection projection(camera, pose);
        std::vector<PlacedDot> placed;
        std::vector<Vec2> places;
        for (int y = -30; y <= 30; ++y) {
            for (int x = -30; x <= 30; ++x) {
                const Vec2 cell{static_cast<double>(x), static_cast<double>(y)};
                const Vec2 p = projection.pixel_from_offset(kDefaultSpacing_mm *
                                                            (cell + random_displacement(rng)));
                if (p.x < 1 || p.y < 1 || p.x > 318 || p.y > 238) continue;
                placed.push_back({{x, y}, p});
                places.push_back(projection.pixel_from_offset(kDefaultSpacing_mm * cell));
            }
        }
        // The grid's axes as the camera sees them in the middle.
        const Vec2 middle = projection.pixel_from_offset({});
        const Mesh mesh{projection.pixel_from_offset({kDefaultSpacing_mm, 0}) - middle,
                        projection.pixel_from_offset({0, kDefaultSpacing_mm}) - middle, middle};
        PlaneFromImage plane;
        ASSERT_EQ(refine_grid(dots_of(placed), {}, centre_q8({320, 240}),
                              lattice_of(spoilt(mesh, rng)), plane),
                  Status::ok);
        expect_grid(plane, placed, places, 0.25);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(RefineGrid, LeavesOutWhatLiesBetweenIntersections) {
    Rng rng(kSeed);
    const Vec2 image{188, 120};
    const Mesh mesh = square_mesh(11, 0.3, {93, 60});
    const auto placed =
        placed_dots(mesh, 20, image, [&](int, int) { return random_displacement(rng); });
    auto dots = dots_of(placed);
    for (int i = -6; i < 6; ++i) {
        const auto place =
            static_cast<std::ptrdiff_t>(rng.below(static_cast<std::uint32_t>(dots.size())));
        dots.insert(dots.begin() + place, dot_at(mesh.at(i + 0.5, i % 4 + 0.46)));
    }
    PlaneFromImage plane;
    ASSERT_EQ(refine_grid(dots, {}, centre_q8(image), lattice_of(spoilt(mesh, rng)), plane),
              Status::ok)
        << "seed " << kSeed;
    expect_grid(plane, placed, intersections(mesh, placed), 0.25);
}

TEST(RefineGrid, RefusesAPlainGrid) {
    Rng rng(kSeed);
    for (const double jitter : {0.0, 0.03}) {
        const Vec2 image{188, 120};
        const Mesh mesh = square_mesh(11, 0.7, {93, 60});
        const auto placed = placed_dots(mesh, 20, image, [&](int, int) {
            return Vec2{jitter * rng.normal(), jitter * rng.normal()};
        });
        PlaneFromImage plane;
        EXPECT_EQ(refine_grid(dots_of(placed), {}, centre_q8(image), lattice_of(spoilt(mesh, rng)),
                              plane),
                  Status::no_displacement)
            << "seed " << kSeed;
        expect_grid(plane, placed, intersections(mesh, placed), jitter == 0 ? 0.002 : 0.06);
    }
}

TEST(RefineGrid, RefusesScatteredDots) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const int count = 60 + static_cast<int>(rng.below(200));
        std::vector<Dot> dots;
        for (int d = 0; d < count; ++d)
            dots.push_back(dot_at({rng.uniform(2, 185), rng.uniform(2, 117)}));
        const Lattice lattice =
            lattice_of(square_mesh(rng.uniform(8, 16), rng.uniform(0, 6.3), {93, 60}));
        PlaneFromImage plane;
        EXPECT_EQ(refine_grid(dots, {}, centre_q8({188, 120}), lattice, plane), Status::no_grid)
            << "set " << i << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test
