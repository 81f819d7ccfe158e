// Tests the growth of grids from dots on tilted planes, and from dots that do not form a grid. The
// positions of the dots are computed in double precision.
#include "core/lattice/outwards.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "core/kernels/select.hpp"

namespace dotpose::core_test::outwards_test {
namespace {

using core::FloatPlane;

constexpr std::uint64_t kSeed = 75;

struct Trouble {
    double missing = 0;
    double extra = 0;      ///< number of false dots per true dot, at random positions
    double jitter_px = 0;  ///< standard deviation of the dot positions, per axis
    double displacement = 1 / 6.0;
};

struct Size {
    int width_px = 224;
    int height_px = 160;
    int max_cell = 70;  ///< cells beyond this one, along each axis, are not in the patch
};

std::unique_ptr<Patch> empty_patch(int scale = 1, Size size = {}) {
    auto patch = std::make_unique<Patch>();
    patch->scale = scale;
    patch->width_px = size.width_px;
    patch->height_px = size.height_px;
    return patch;
}

void finish_patch(Patch& patch, const std::vector<Vec2>& dots) {
    patch.dots.count = static_cast<int>(std::min<std::size_t>(dots.size(), PatchDots::kMax));
    patch.dots.x.fill(kNoDot_px);
    patch.dots.y.fill(kNoDot_px);
    for (std::size_t i = 0; i < static_cast<std::size_t>(patch.dots.count); ++i) {
        patch.dots.x[i] = static_cast<float>(dots[i].x);
        patch.dots.y[i] = static_cast<float>(dots[i].y);
    }
}

std::unique_ptr<Patch> patch_of(const FloatPlane& plane, const Trouble& trouble, Rng& rng,
                                int scale = 1, Size size = {}) {
    auto patch = empty_patch(scale, size);
    const Vec2 half = 0.5 * scale * Vec2(size.width_px, size.height_px);
    std::vector<Vec2> dots;
    for (int j = -size.max_cell; j <= size.max_cell; ++j) {
        for (int i = -size.max_cell; i <= size.max_cell; ++i) {
            const Vec2 d = 6 * trouble.displacement * random_displacement(rng);
            // A point behind the horizon of a tilted plane has no image point, so `at` may be NaN.
            // The negated condition below also excludes NaN.
            const Vec2 at = image_of(plane, {i + d.x, j + d.y});
            const Vec2 seen = at + trouble.jitter_px * Vec2{rng.normal(), rng.normal()};
            if (!(std::abs(seen.x) < half.x - 2 && std::abs(seen.y) < half.y - 2)) continue;
            if (rng.uniform() >= trouble.missing) dots.push_back(seen);
            if (rng.uniform() < trouble.extra) {
                dots.push_back({rng.uniform(-half.x, half.x), rng.uniform(-half.y, half.y)});
            }
        }
    }
    finish_patch(*patch, dots);
    return patch;
}

/// Returns the maximum distance between the pattern points that two planes assign to the same image
/// point. Considers image points up to `half_px` from the centre. Ignores offsets of whole cells
/// and rotations by quarter turns.
double difference(const FloatPlane& found, const FloatPlane& truth, Vec2 half_px) {
    double least = 1e9;
    for (int quarters = 0; quarters < 4; ++quarters) {
        const auto turned = [&](Vec2 v) {
            for (int i = 0; i < quarters; ++i)
                v = {-v.y, v.x};
            return v;
        };
        const Vec2 offset = formula(found, {}) - turned(formula(truth, {}));
        const Vec2 whole{std::round(offset.x), std::round(offset.y)};
        double most = 0;
        for (const double u : {-1.0, 0.0, 1.0}) {
            for (const double v : {-1.0, 0.0, 1.0}) {
                const Vec2 px{u * half_px.x, v * half_px.y};
                most =
                    std::max(most, length(formula(found, px) - turned(formula(truth, px)) - whole));
            }
        }
        least = std::min(least, most);
    }
    return least;
}

TEST(FindGrid, FindsThePlaneOfTiltedCameras) {
    Rng rng(kSeed);
    int found = 0;
    int exact = 0;
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        // The camera is tilted by up to 20 degrees, and its focal length is 350 px.
        const double tilt = std::tan(radians(rng.uniform(0, 20))) / 350;
        const double spacing_px = rng.uniform(6, 20);
        const FloatPlane truth = random_float_plane(spacing_px, tilt, rng);
        const auto patch = patch_of(truth, {0.03, 0.01, 0.02 * spacing_px}, rng);
        core::PatchGrid grid;
        if (!core::find_grid(core::kernels(), *patch, core::whole_view(*patch), grid)) continue;
        ++found;
        EXPECT_LT(difference(grid.grid_from_image, truth, {20, 20}), 0.1);
        EXPECT_NEAR(grid.displacement, 1 / 6.0, 0.03);
        EXPECT_LT(grid.variance, 0.003);
        // The plane must be accurate enough for the windows around the intersections to contain the
        // dots. One of the grids found may be less accurate, because its growth ended early. Such a
        // grid is rejected later, when its dots are measured.
        exact += difference(grid.grid_from_image, truth, {56, 40}) < 0.15 &&
                 difference(grid.grid_from_image, truth, {112, 80}) < 0.45;
    }
    EXPECT_GE(found, 56);
    EXPECT_GE(exact, found - 1);
}

TEST(FindGrid, FindsThePlaneOfSmallViews) {
    // In a few of these views, the first planes assign outer dots to false dot positions.
    Rng rng(kSeed);
    constexpr Size kSmall{84, 84, 12};
    for (int i = 0; i < 4000; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const FloatPlane truth = random_float_plane(6.5, 0, rng);
        const auto patch = patch_of(truth, {.jitter_px = 0.2}, rng, 1, kSmall);
        core::PatchGrid grid;
        ASSERT_TRUE(core::find_grid(core::kernels(), *patch, core::whole_view(*patch), grid));
        EXPECT_LT(difference(grid.grid_from_image, truth, {42, 42}), 0.1);
    }
}

TEST(FindGrid, FindsGridsWithManyDotsMissingAndTooMany) {
    Rng rng(kSeed);
    int found = 0;
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const FloatPlane truth = random_float_plane(rng.uniform(7, 14), 1e-4, rng);
        const auto patch = patch_of(truth, {0.15, 0.05, 0.4}, rng);
        core::PatchGrid grid;
        if (!core::find_grid(core::kernels(), *patch, core::whole_view(*patch), grid)) continue;
        ++found;
        EXPECT_LT(difference(grid.grid_from_image, truth, {56, 40}), 0.15);
    }
    EXPECT_GE(found, 45);
}

TEST(FindGrid, FindsCoarseGridsInReducedPatches) {
    Rng rng(kSeed);
    for (const int scale : {2, 4}) {
        const FloatPlane truth = random_float_plane(11.0 * scale, 1e-4 / scale, rng);
        const auto patch = patch_of(truth, {}, rng, scale);
        core::PatchGrid grid;
        ASSERT_TRUE(core::find_grid(core::kernels(), *patch, core::whole_view(*patch), grid))
            << scale;
        EXPECT_LT(difference(grid.grid_from_image, truth, {112.0 * scale, 80.0 * scale}), 0.05);
        // At the wrong scale, the spacing is outside the range of the search. The search may still
        // find the true grid, but must not find any other grid.
        patch->scale = scale == 2 ? 4 : 1;
        EXPECT_FALSE(core::find_grid(core::kernels(), *patch, core::whole_view(*patch), grid) &&
                     difference(grid.grid_from_image, truth, {40, 40}) > 0.2);
    }
}

TEST(FindGrid, RefusesWhatIsNoGrid) {
    Rng rng(kSeed);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        core::PatchGrid grid;
        // These dots are at random positions.
        const auto scattered = empty_patch();
        std::vector<Vec2> dots;
        const int count = 60 + static_cast<int>(rng.below(400));
        for (int k = 0; k < count; ++k)
            dots.push_back({rng.uniform(-110, 110), rng.uniform(-78, 78)});
        finish_patch(*scattered, dots);
        EXPECT_FALSE(
            core::find_grid(core::kernels(), *scattered, core::whole_view(*scattered), grid));
        // These dots are on their intersections, without displacement.
        const auto plain =
            patch_of(random_float_plane(rng.uniform(7, 15), 1e-4, rng), {0, 0, 0.02, 0}, rng);
        EXPECT_FALSE(core::find_grid(core::kernels(), *plain, core::whole_view(*plain), grid));
        // There are too few dots.
        const auto few = patch_of(random_float_plane(11, 0, rng), {}, rng);
        few->dots.count = 39;
        EXPECT_FALSE(core::find_grid(core::kernels(), *few, core::whole_view(*few), grid));
        few->dots.count = 0;
        EXPECT_FALSE(core::find_grid(core::kernels(), *few, core::whole_view(*few), grid));
    }
}

TEST(FindGrid, AllFormsOfTheKernelsGiveTheSame) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        const FloatPlane truth = random_float_plane(rng.uniform(6, 16), 3e-4, rng);
        const auto patch = patch_of(truth, {0.05, 0.02, 0.3}, rng);
        core::PatchGrid a;
        core::PatchGrid b;
        ASSERT_EQ(core::find_grid(core::portable_kernels(), *patch, core::whole_view(*patch), a),
                  core::find_grid(core::kernels(), *patch, core::whole_view(*patch), b));
        EXPECT_EQ(a.grid_from_image.at_x, b.grid_from_image.at_x);
        EXPECT_EQ(a.grid_from_image.dv_y, b.grid_from_image.dv_y);
        EXPECT_EQ(a.grid_from_image.tilt_y, b.grid_from_image.tilt_y);
        EXPECT_EQ(a.displacement, b.displacement);
        EXPECT_EQ(a.variance, b.variance);
    }
}

}  // namespace
}  // namespace dotpose::core_test::outwards_test
