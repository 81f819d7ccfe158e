// Tests `refine_grid`, which starts from a rough estimate in the middle of the image and refines
// the grid over the whole image.
#include "core/lattice/refine_grid.hpp"

#include <gtest/gtest.h>

#include "grids.hpp"

namespace dotpose::core_test::refine_grid_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 27;

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
        // The vectors of the mesh are the grid axes projected into the image, at the image centre.
        const Vec2 middle = projection.pixel_from_offset({});
        const Mesh mesh{projection.pixel_from_offset({kDefaultSpacing_mm, 0}) - middle,
                        projection.pixel_from_offset({0, kDefaultSpacing_mm}) - middle, middle};
        PlaneFromImage plane;
        ASSERT_EQ(refine_grid(dots_of(placed), {}, centre_q8({320, 240}),
                              lattice_of(spoilt(mesh, rng)), plane),
                  Status::ok);
        expect_grid(plane, placed, places, 0.05);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(RefineGrid, LeavesOutWhatLiesBetweenIntersections) {
    Rng rng(kSeed);
    const Vec2 image{188, 120};
    const Mesh mesh = square_mesh(11, 0.3, {93, 60});
    const auto placed = displaced_dots(mesh, 20, image, rng);
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
    expect_grid(plane, placed, intersections(mesh, placed), 0.05);
}

}  // namespace
}  // namespace dotpose::core_test::refine_grid_test
