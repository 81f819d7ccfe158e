// Tests the undistortion (paper, equations 1-2) against a computation in double precision.
#include "core/detect/undistort.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"

namespace dotpose::core_test::undistort_test {
namespace {

constexpr std::uint64_t kSeed = 23;

TEST(Undistort, IsEquations1And2) {
    Rng rng(kSeed);
    for (const Vec2 size : {Vec2{64, 64}, Vec2{188, 120}, Vec2{640, 480}, Vec2{4096, 4096}}) {
        const Vec2 centre{(size.x - 1) / 2, (size.y - 1) / 2};
        // The lens changes the distance of the corner from the centre by a factor between 1/2 and
        // 2.
        for (const double at_corner : {-0.5, -0.2, -0.01, 0.0, 0.01, 0.3, 1.0}) {
            const double k = at_corner / (centre.x * centre.x + centre.y * centre.y);
            std::vector<DetectedDot> dots;
            for (int i = 0; i < 500; ++i) {
                dots.push_back(dot_at({rng.uniform(0, size.x - 1), rng.uniform(0, size.y - 1)}));
            }
            const std::vector<DetectedDot> before = dots;
            core::undistort(FixedLens::from_k(k), fixed(centre, 8), dots);
            for (std::size_t i = 0; i < dots.size(); ++i) {
                const Vec2 r = real(before[i].centre_q8, 8) - centre;
                const Vec2 expected = centre + 1 / (1 + k * (r.x * r.x + r.y * r.y)) * r;
                const Vec2 found = real(dots[i].centre_q8, 8);
                // k is rounded to a multiple of 2^-40. At the corner of the largest image, this
                // changes k r^2 by up to 4e-6, and a strong distortion magnifies the error.
                const double tolerance = 0.51 / 256 + 4e-5 * length(r);
                ASSERT_NEAR(found.x, expected.x, tolerance) << "k " << k << ", seed " << kSeed;
                ASSERT_NEAR(found.y, expected.y, tolerance) << "k " << k << ", seed " << kSeed;
                ASSERT_EQ(dots[i].mass, before[i].mass);
            }
        }
    }
}

TEST(Undistort, DistortedIsTheInverse) {
    Rng rng(kSeed);
    for (const Vec2 size : {Vec2{64, 64}, Vec2{188, 120}, Vec2{640, 480}, Vec2{4096, 4096}}) {
        const FixedVec centre = fixed({(size.x - 1) / 2, (size.y - 1) / 2}, 8);
        const Vec2 half = real(centre, 8);
        for (const double at_corner : {-0.12, -0.01, 0.0, 0.05, 0.2}) {
            const FixedLens lens =
                FixedLens::from_k(at_corner / (half.x * half.x + half.y * half.y));
            for (int i = 0; i < 200; ++i) {
                const FixedVec seen = fixed({rng.uniform(0, size.x), rng.uniform(0, size.y)}, 8);
                const FixedVec again =
                    core::distorted(lens, centre, core::undistorted(lens, centre, seen));
                // `distorted` and its inverse both round to 1/256 px. A distortion of 0.2 in the
                // corner magnifies the rounding error up to twofold.
                ASSERT_LE(std::abs(again.x - seen.x), 3) << at_corner << ", seed " << kSeed;
                ASSERT_LE(std::abs(again.y - seen.y), 3) << at_corner << ", seed " << kSeed;
            }
        }
    }
}

TEST(Undistort, TheLensMayBeCentredElsewhere) {
    const FixedVec image_centre{94 * 256, 60 * 256};
    FixedLens lens = FixedLens::from_k(-1e-5);
    const FixedLens centred = lens;
    lens.centre_dx_q8 = 3 * 256;
    lens.centre_dy_q8 = -2 * 256;
    const auto shifted = [](FixedVec p) { return FixedVec{p.x + 3 * 256, p.y - 2 * 256}; };
    for (const FixedVec seen :
         {FixedVec{0, 0}, FixedVec{180 * 256, 20 * 256}, FixedVec{97 * 256, 58 * 256}}) {
        EXPECT_EQ(core::undistorted(lens, image_centre, shifted(seen)),
                  shifted(core::undistorted(centred, image_centre, seen)));
        EXPECT_EQ(core::distorted(lens, image_centre, shifted(seen)),
                  shifted(core::distorted(centred, image_centre, seen)));
    }
}

// Regression: `distorted` overflowed for points far outside the image. Such points occur on a plane
// that is seen edge-on.
TEST(Undistort, PointsFarOutsideTheImageKeepTheirDirection) {
    for (const std::int32_t k_q40 : {-385875968, INT32_MIN, INT32_MAX}) {
        const FixedLens lens{k_q40};
        for (const int far_px : {4096, 11'500, 1'000'000}) {
            const FixedVec r{far_px * 256, -far_px * 128};
            // `distorted` multiplies by 2 / (1 + root), where the root is limited to the range 0 to
            // 4. For these barrel distortions, the root is 4. For these pincushion distortions, no
            // image point maps to this distance, and the root is 0.
            const int fifths = k_q40 < 0 ? 2 : 10;
            const FixedVec seen = core::distorted(lens, {}, r);
            EXPECT_NEAR(seen.x, r.x / 5 * fifths, far_px) << k_q40;
            EXPECT_NEAR(seen.y, r.y / 5 * fifths, far_px) << k_q40;
            const FixedVec unseen = core::undistorted(lens, {}, r);
            EXPECT_GE(unseen.x, 0) << k_q40;
            EXPECT_LE(unseen.y, 0) << k_q40;
        }
    }
}

TEST(Undistort, NoLensMovesNothing) {
    std::vector<DetectedDot> dots{dot_at({1.25, 3.5}), dot_at({4000.75, 12})};
    core::undistort({}, {2048 * 256, 2048 * 256}, dots);
    EXPECT_EQ(dots[0].centre_q8, (FixedVec{320, 896}));
    EXPECT_EQ(dots[1].centre_q8, (FixedVec{1024192, 3072}));
}

}  // namespace
}  // namespace dotpose::core_test::undistort_test
