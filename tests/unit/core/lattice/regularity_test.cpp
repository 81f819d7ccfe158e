// Tests the behaviour common to `grow_grid` and `refine_grid`. Both functions start from a rough
// estimate in the middle of the image, extend the grid over the whole image, and reject dots that
// do not form a grid.
#include "core/lattice/regularity.hpp"

#include <ostream>

#include <gtest/gtest.h>

#include "core/lattice/refine_grid.hpp"
#include "device/grow.hpp"
#include "grids.hpp"

namespace dotpose::core_test::regularity_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 47;
constexpr Vec2 kImage_px{188, 120};

/// Returns the tolerance, in spacings, for a fit to displaced dots. The displacements act as noise
/// of 0.12 spacings rms per axis. A fit of 8 parameters to at least 100 dots has an rms error of
/// 0.12 sqrt(8 / 100) = 0.034, and up to 3 times as much at the corners.
double perspective_tolerance(const std::vector<PlacedDot>&) {
    return 0.25;
}

struct Stage {
    const char* name;
    decltype(grow_grid)* find_grid;
    /// Returns the tolerance, in spacings, for a fit to displaced dots.
    double (*tolerance)(const std::vector<PlacedDot>& dots);
    double plain_tolerance;  ///< tolerance for a fit to undisplaced dots, in spacings
};
void PrintTo(const Stage& stage, std::ostream* out) {
    *out << stage.name;
}

class OutwardGrid : public testing::TestWithParam<Stage> {};
INSTANTIATE_TEST_SUITE_P(
    , OutwardGrid,
    testing::Values(Stage{"grown", grow_grid, affine_tolerance, 0.006},  // rounds dots to 1/8 px
                    Stage{"refined", refine_grid, perspective_tolerance, 0.002}),
    [](const auto& test) { return test.param.name; });

TEST_P(OutwardGrid, ReachesOverTheWholeImage) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        const double spacing = rng.uniform(6, 60);
        const Vec2 image{std::min(spacing * rng.uniform(12, 50), 4096.0),
                         std::min(spacing * rng.uniform(10, 40), 4096.0)};
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed << ", " << image.x
                                        << " x " << image.y << " at " << spacing);
        Mesh mesh = square_mesh(spacing, rng.uniform(0, 6.3), {image.x / 2, image.y / 2});
        if (i % 2 == 1) mesh.v = mesh.v + rng.uniform(-0.1, 0.1) * mesh.u;  // shear
        const auto placed = displaced_dots(mesh, 45, image, rng);
        PlaneFromImage plane;
        ASSERT_EQ(GetParam().find_grid(dots_of(placed), {}, centre_q8(image),
                                       lattice_of(spoilt(mesh, rng)), plane),
                  Status::ok);
        expect_grid(plane, placed, intersections(mesh, placed), GetParam().tolerance(placed));
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST_P(OutwardGrid, RefusesAPlainGrid) {
    Rng rng(kSeed);
    for (const double jitter : {0.0, 0.03}) {
        const Mesh mesh = square_mesh(11, 0.7, {93, 60});
        const auto placed = placed_dots(mesh, 20, kImage_px, [&](int, int) {
            return Vec2{jitter * rng.normal(), jitter * rng.normal()};
        });
        PlaneFromImage plane;
        EXPECT_EQ(GetParam().find_grid(dots_of(placed), {}, centre_q8(kImage_px),
                                       lattice_of(spoilt(mesh, rng)), plane),
                  Status::no_displacement)
            << "seed " << kSeed;
        expect_grid(plane, placed, intersections(mesh, placed),
                    jitter == 0 ? GetParam().plain_tolerance : 0.06);
    }
}

TEST_P(OutwardGrid, RefusesScatteredDots) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const int count = 60 + static_cast<int>(rng.below(200));
        std::vector<DetectedDot> dots;
        for (int d = 0; d < count; ++d)
            dots.push_back(dot_at({rng.uniform(2, 185), rng.uniform(2, 117)}));
        const Lattice lattice =
            lattice_of(square_mesh(rng.uniform(8, 16), rng.uniform(0, 6.3), {93, 60}));
        PlaneFromImage plane;
        EXPECT_EQ(GetParam().find_grid(dots, {}, centre_q8(kImage_px), lattice, plane),
                  Status::no_grid)
            << "set " << i << ", seed " << kSeed;
    }
}

/// The verdict requires that at least 7 out of 10 dots are near their intersections, and that the
/// mean squared offset is between 1/256 and 1/10.
TEST(Regularity, JudgesByItsBounds) {
    const auto verdict = [](int near, double mean_square) {
        const Regularity regularity{100, near, 9};
        return regularity.verdict(std::lround(mean_square * (1 << 20)));
    };
    EXPECT_EQ(verdict(70, 1.0 / 36), Status::ok);
    EXPECT_EQ(verdict(69, 1.0 / 36), Status::no_grid);
    EXPECT_EQ(verdict(100, 0.0999), Status::ok);
    EXPECT_EQ(verdict(100, 0.1001), Status::no_grid);
    EXPECT_EQ(verdict(100, 1 / 255.0), Status::ok);
    EXPECT_EQ(verdict(100, 1 / 257.0), Status::no_displacement);
    EXPECT_EQ(verdict(69, 0), Status::no_grid);
}

}  // namespace
}  // namespace dotpose::core_test::regularity_test
