// Tests `grow_grid`, which starts from a rough estimate in the middle of the image and extends the
// grid over the whole image. The grids have no perspective.
#include "device/grow.hpp"

#include <gtest/gtest.h>

#include "../core/lattice/grids.hpp"

namespace dotpose::core_test::grow_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 47;
constexpr Vec2 kImage_px{188, 120};

Mesh small_mesh(Rng& rng) {
    return square_mesh(rng.uniform(8, 13), rng.uniform(0, 6.3),
                       {rng.uniform(88, 99), rng.uniform(55, 65)});
}

TEST(GrowGrid, ReachesOverTheLargestImage) {
    Rng rng(kSeed);
    for (const double angle : {0.0, 0.3, 0.785}) {
        SCOPED_TRACE(testing::Message() << "angle " << angle << ", seed " << kSeed);
        // The dots extend to the corners. Their number is close to the capacity of the largest
        // workspace.
        constexpr Vec2 kLargest_px{4096, 4096};
        const Mesh mesh = square_mesh(33, angle, {2048, 2048});
        const auto placed = displaced_dots(mesh, 95, kLargest_px, rng);
        ASSERT_GT(placed.size(), 14000u);
        ASSERT_LE(placed.size(), 16384u);
        PlaneFromImage plane;
        ASSERT_EQ(grow_grid(dots_of(placed), {}, centre_q8(kLargest_px),
                            lattice_of(spoilt(mesh, rng)), plane),
                  Status::ok);
        EXPECT_TRUE(is_affine(plane));
        expect_grid(plane, placed, intersections(mesh, placed), affine_tolerance(placed));
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// Between fits, `grow_grid` stores the cells of a limited number of dots. With more dots, each fit
/// computes its sums over all dots instead of updating them for dots whose cell has changed. The
/// result must be the same.
TEST(GrowGrid, IsTheSameWithManyMoreDotsFarOff) {
    Rng rng(kSeed);
    for (int i = 0; i < 50; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        const Mesh mesh = small_mesh(rng);
        auto dots = dots_of(displaced_dots(mesh, 20, kImage_px, rng));
        dots.push_back(dot_at({rng.uniform(2, 185), rng.uniform(2, 117)}));
        const Lattice first = lattice_of(spoilt(mesh, rng));
        PlaneFromImage plane;
        ASSERT_EQ(grow_grid(dots, {}, centre_q8(kImage_px), first, plane), Status::ok);
        // Dots more than 500 cells away are ignored. The additional dots are 530 cells away because
        // the first estimate of the spacing may be 3 % too large.
        const Vec2 far = mesh.at(530, 0);
        dots.resize(dots.size() + 5000, dot_at(far));
        PlaneFromImage same;
        ASSERT_EQ(grow_grid(dots, {}, centre_q8(kImage_px), first, same), Status::ok);
        EXPECT_EQ(same.at_centre_q16, plane.at_centre_q16);
        EXPECT_EQ(same.du_q24, plane.du_q24);
        EXPECT_EQ(same.dv_q24, plane.dv_q24);
    }
}

TEST(GrowGrid, BearsGapsAndDotsWhereNoneShouldBe) {
    Rng rng(kSeed);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "grid " << i << ", seed " << kSeed);
        const Mesh mesh = small_mesh(rng);
        const auto placed = displaced_dots(mesh, 20, kImage_px, rng);
        // One dot in six is missing, and so are all dots in a strip, as if hidden by a stroke. For
        // one dot in twelve, a spurious dot is added at a random position.
        const double strip = rng.uniform(20, 160);
        std::vector<DetectedDot> dots;
        for (const PlacedDot& d : placed) {
            if (std::abs(d.centre_px.x - strip) < 8) continue;
            const double fate = rng.uniform();
            if (fate > 1 / 6.0) dots.push_back(dot_at(d.centre_px));
            if (fate > 11 / 12.0)
                dots.push_back(dot_at({rng.uniform(2, 185), rng.uniform(2, 117)}));
        }
        PlaneFromImage plane;
        ASSERT_EQ(grow_grid(dots, {}, centre_q8(kImage_px), lattice_of(spoilt(mesh, rng)), plane),
                  Status::ok);
        // The correct cells must be found even with missing and spurious dots. The tolerance is
        // large because spurious dots increase the errors.
        expect_grid(plane, placed, intersections(mesh, placed), 0.25);
        if (testing::Test::HasFatalFailure()) return;
    }
}

TEST(GrowGrid, LeavesOutWhatLiesBetweenIntersections) {
    Rng rng(kSeed);
    const Mesh mesh = square_mesh(11, 0.3, {93, 60});
    auto dots = dots_of(displaced_dots(mesh, 20, kImage_px, rng));
    PlaneFromImage without;
    PlaneFromImage with;
    const Lattice first = lattice_of(spoilt(mesh, rng));
    ASSERT_EQ(grow_grid(dots, {}, centre_q8(kImage_px), first, without), Status::ok);
    for (int i = -6; i < 6; ++i)
        dots.push_back(dot_at(mesh.at(i + 0.5, i % 4 + 0.46)));
    ASSERT_EQ(grow_grid(dots, {}, centre_q8(kImage_px), first, with), Status::ok);
    EXPECT_EQ(with.at_centre_q16, without.at_centre_q16) << "seed " << kSeed;
    EXPECT_EQ(with.du_q24, without.du_q24);
    EXPECT_EQ(with.dv_q24, without.dv_q24);
}

TEST(GrowGrid, RefusesWhatDoesNotSpanAPlane) {
    const Mesh mesh = square_mesh(11, 0, {93, 60});
    PlaneFromImage plane;
    const auto status_of = [&](const std::vector<DetectedDot>& dots) {
        return grow_grid(dots, {}, centre_q8(kImage_px), lattice_of(mesh), plane);
    };
    EXPECT_EQ(status_of({}), Status::no_grid);
    EXPECT_EQ(status_of({dot_at({93, 60}), dot_at({104, 62})}), Status::no_grid);
    std::vector<DetectedDot> row;
    for (int i = -8; i <= 8; ++i)
        row.push_back(dot_at(mesh.at(i, 0)));
    EXPECT_EQ(status_of(row), Status::no_grid);
}

}  // namespace
}  // namespace dotpose::core_test::grow_test
