// Tests that predictions follow the motion of the camera. The expected values are computed from
// plane geometry in double precision.
#include "dotpose/prediction.hpp"

#include <gtest/gtest.h>

#include "planes.hpp"

namespace dotpose::core_test::prediction_test {
namespace {

constexpr std::uint64_t kSeed = 73;

/// Returns the pattern point seen at an image point, in spacings relative to the cell `from`.
Vec2 seen_from(const Prediction& p, Vec2 px, Cell from) {
    const Vec2 at = formula(p.pattern_from_image, px);
    return {at.x + p.place.cell.x - from.x, at.y + p.place.cell.y - from.y};
}

Prediction random_prediction(Rng& rng) {
    Prediction p;
    p.pattern_from_image = affine_plane(188, rng.uniform(6, 40), 1.1, rng);
    p.pattern_from_image.perspective_q30 =
        fixed({rng.uniform(-1e-3, 1e-3), rng.uniform(-1e-3, 1e-3)}, 30);
    p.place = {{200'000'000, 300'000'000}, {5, 60}};
    p.displacement_q16 = 10000;
    p.sigma_q16 = 4000;
    return p;
}

TEST(Prediction, LikeAFixTakesItsPlane) {
    Fix fix;
    fix.pattern_from_image.du_q24 = {1, 2};
    fix.place = {{3, 4}, {5, 6}};
    fix.displacement_q16 = 7;
    const Prediction p = Prediction::like(fix);
    EXPECT_EQ(p.pattern_from_image.du_q24, (FixedVec{1, 2}));
    EXPECT_EQ(p.place, fix.place);
    EXPECT_EQ(p.displacement_q16, 7);
}

TEST(Prediction, MovesAndTurnsAboutThePivot) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const Prediction before = random_prediction(rng);
        const Vec2 by{rng.uniform(-300, 300), rng.uniform(-300, 300)};
        const double turn = rng.uniform(-3, 3);
        const Vec2 pivot{rng.uniform(0, 188), rng.uniform(0, 188)};
        const auto turn_bam = static_cast<std::int32_t>(turn * 2147483648.0 / std::numbers::pi);
        const Prediction after =
            moved(before, CodeVariant::anoto, fixed(by, 16), turn_bam, fixed(pivot, 8));
        const Cell from = before.place.cell;
        const Vec2 pivot_before = seen_from(before, pivot, from);
        for (int k = 0; k < 5; ++k) {
            const Vec2 px{rng.uniform(0, 188), rng.uniform(0, 188)};
            const Vec2 arm = seen_from(before, px, from) - pivot_before;
            const Vec2 expected = pivot_before + by +
                                  Vec2{std::cos(turn) * arm.x - std::sin(turn) * arm.y,
                                       std::sin(turn) * arm.x + std::cos(turn) * arm.y};
            EXPECT_LT(length(seen_from(after, px, from) - expected), 2e-3);
        }
        EXPECT_EQ(after.place.section, before.place.section);
        EXPECT_EQ(after.displacement_q16, before.displacement_q16);
        EXPECT_EQ(after.sigma_q16, before.sigma_q16);
        // The origin of the plane is an intersection near its centre.
        EXPECT_GE(after.pattern_from_image.at_centre_q16.x, 0);
        EXPECT_LT(after.pattern_from_image.at_centre_q16.x, 65536);
    }
}

TEST(Prediction, GoesOnPastTheEndOfTheCode) {
    for (const CodeVariant code : kCodeVariants) {
        Prediction p;
        p.pattern_from_image.du_q24 = {1 << 20, 0};
        p.pattern_from_image.dv_q24 = {0, 1 << 20};
        p.place = {{kPositionsPerAxis - 2, 1}, {7, 8}};
        const Prediction after = moved(p, code, fixed({5.25, -3.5}, 16), 0, {});
        EXPECT_EQ(after.place, moved(code, p.place, 5, -4));
        EXPECT_EQ(after.pattern_from_image.at_centre_q16, fixed({0.25, 0.5}, 16));
    }
}

TEST(Prediction, AttemptsHaveNames) {
    EXPECT_STREQ(name(Attempt::tracked), "tracked");
    EXPECT_STREQ(name(Attempt::first), "first");
    EXPECT_STREQ(name(Attempt::second), "second");
    EXPECT_STREQ(name(Attempt::device), "device");
}

}  // namespace
}  // namespace dotpose::core_test::prediction_test
