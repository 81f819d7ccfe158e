// Least-squares planes, from points with a known plane in double precision.
#include "core/fit/plane_fit_int64.hpp"

#include <gtest/gtest.h>

#include "../geometry.hpp"
#include "dotpose/options.hpp"

namespace dotpose::core_test::plane_fit_int64_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 41;

/// The formula of PlaneFromImage in double precision.
struct TruePlane {
    Vec2 centre;
    Vec2 at_centre;
    Vec2 du;
    Vec2 dv;
    Vec2 perspective;
    double lens = 0;

    Vec2 operator()(Vec2 p) const {
        const Vec2 r = p - centre;
        const double divisor =
            1 + perspective.x * r.x + perspective.y * r.y + lens * (r.x * r.x + r.y * r.y);
        return at_centre + 1 / divisor * (r.x * du + r.y * dv);
    }
};

/// Returns a plane whose perspective changes the scale by up to 10 % towards the border, and whose
/// lens changes it by up to 10 % towards the corners.
TruePlane random_plane(Rng& rng, Vec2 image_px, double spacing_px, Terms terms) {
    const double angle = rng.uniform(0, 6.3);
    const Vec2 du{std::cos(angle) / spacing_px, std::sin(angle) / spacing_px};
    TruePlane plane;
    plane.centre = {(image_px.x - 1) / 2, (image_px.y - 1) / 2};
    plane.at_centre = {rng.uniform(-3, 3), rng.uniform(-3, 3)};
    plane.du = du;
    plane.dv = {-du.y * rng.uniform(0.9, 1.1), du.x * rng.uniform(0.9, 1.1)};
    const auto some = [&] { return (rng.below(2) == 0 ? 1 : -1) * rng.uniform(0.02, 0.1); };
    if (terms >= Terms::perspective) {
        plane.perspective = {some() / plane.centre.x, some() / plane.centre.y};
    }
    if (terms >= Terms::lens) {
        const double corner = length(plane.centre);
        plane.lens = some() / (corner * corner);
    }
    return plane;
}

struct Pair {
    FixedVec image_point_q8;
    FixedVec target_q16;
};

/// Returns points all over the image with their places in the plane, rounded to fixed point, with
/// noise.
std::vector<Pair> pairs(const TruePlane& plane, Vec2 image_px, int count, Rng& rng,
                        double noise_spacings = 0) {
    std::vector<Pair> result;
    for (int i = 0; i < count; ++i) {
        const FixedVec p =
            fixed({rng.uniform(0, image_px.x - 1), rng.uniform(0, image_px.y - 1)}, 8);
        Vec2 target = plane(real(p, 8));
        if (noise_spacings > 0) {
            target = target + noise_spacings * Vec2{rng.normal(), rng.normal()};
        }
        result.push_back({p, fixed(target, 16)});
    }
    return result;
}

bool fit(const PlaneFromImage& estimate, const std::vector<Pair>& points, FittedPlane& fitted,
         Terms most = Terms::lens) {
    const auto visit = [&](auto use) {
        for (const Pair& p : points)
            use(p.image_point_q8, p.target_q16);
    };
    return fit_significant_plane(estimate, most, visit, fitted);
}

/// Returns an estimate of the plane at the centre, with an error of up to a twentieth of a spacing.
PlaneFromImage guess(const TruePlane& plane, Rng& rng) {
    PlaneFromImage estimate;
    estimate.centre_q8 = fixed(plane.centre, 8);
    const Vec2 off{rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05)};
    estimate.at_centre_q16 = fixed(plane.at_centre + off, 16);
    return estimate;
}

/// Returns the maximum error, in spacings, over a raster that includes the corners.
double worst_error(const PlaneFromImage& found, const TruePlane& plane, Vec2 image_px) {
    double worst = 0;
    for (int n = 0; n <= 10; ++n) {
        for (int m = 0; m <= 10; ++m) {
            const FixedVec p = fixed({(image_px.x - 1) * n / 10, (image_px.y - 1) * m / 10}, 8);
            worst =
                std::max(worst, length(real(plane_point_q16(found, p), 16) - plane(real(p, 8))));
        }
    }
    return worst;
}

TEST(PlaneFitInt64, RecoversEachKindOfPlane) {
    Rng rng(kSeed);
    for (const Terms terms : {Terms::affine, Terms::perspective, Terms::lens}) {
        for (int i = 0; i < 100; ++i) {
            const Vec2 image = i % 2 == 0 ? Vec2{188, 120} : Vec2{1280, 960};
            const double spacing = i % 2 == 0 ? rng.uniform(7, 15) : rng.uniform(20, 60);
            SCOPED_TRACE(testing::Message() << "terms " << static_cast<int>(terms) << ", plane "
                                            << i << ", seed " << kSeed);
            const TruePlane truth = random_plane(rng, image, spacing, terms);
            const auto points = pairs(truth, image, 150, rng);
            // The second fit has the correct centre, without which the lens term is not exact.
            FittedPlane first;
            ASSERT_TRUE(fit(guess(truth, rng), points, first));
            FittedPlane found;
            ASSERT_TRUE(fit(first.plane, points, found));
            ASSERT_GE(found.terms, terms);
            ASSERT_EQ(found.points, 150);
            ASSERT_LT(worst_error(found.plane, truth, image), 1e-3);
        }
    }
}

TEST(PlaneFitInt64, FewerTermsThanThePlaneHasLeaveResiduals) {
    Rng rng(kSeed);
    const Vec2 image{188, 120};
    const TruePlane truth = random_plane(rng, image, 11, Terms::lens);
    const auto points = pairs(truth, image, 150, rng);
    std::int64_t before = INT64_MAX;
    for (const Terms most : {Terms::affine, Terms::perspective, Terms::lens}) {
        FittedPlane found;
        ASSERT_TRUE(fit(guess(truth, rng), points, found, most));
        EXPECT_EQ(found.terms, most);
        EXPECT_LT(found.squared_residuals, before / 2);
        before = found.squared_residuals;
        if (most == Terms::lens) continue;
        EXPECT_EQ(found.plane.lens_q40, 0);
        EXPECT_GT(worst_error(found.plane, truth, image), 0.02);
    }
}

/// Returns the number of times that each set of terms is chosen in 200 draws of noise.
std::array<int, 3> choices(double tilt_rad, Rng& rng) {
    constexpr int kDraws = 200;
    constexpr double kFocalLength_px = 200;
    const Vec2 image{188, 120};
    std::array<int, 3> chosen{};
    for (int i = 0; i < kDraws; ++i) {
        TruePlane truth = random_plane(rng, image, 11, Terms::affine);
        // In a pinhole camera, the scale changes by tan(tilt) / focal length per px.
        const double direction = rng.uniform(0, 6.3);
        truth.perspective =
            std::tan(tilt_rad) / kFocalLength_px * Vec2{std::cos(direction), std::sin(direction)};
        FittedPlane found;
        const auto points = pairs(truth, image, 180, rng, 0.05);
        if (!fit(guess(truth, rng), points, found)) continue;
        ++chosen[static_cast<std::size_t>(found.terms)];
    }
    return chosen;
}

TEST(PlaneFitInt64, NoiseIsTakenForATiltAsOftenAsChanceHasIt) {
    Rng rng(kSeed);
    const auto [affine, perspective, lens] = choices(0, rng);
    SCOPED_TRACE(testing::Message() << affine << " affine, " << perspective << " perspective, "
                                    << lens << " lens, seed " << kSeed);
    EXPECT_EQ(affine + perspective + lens, 200);
    // By chance, two parameters gain less than their mean, chi^2(2) < 2, in 1 - 1/e of the draws:
    // in 126, with a standard deviation of 7.
    EXPECT_GT(affine, 100);
    EXPECT_NEAR(affine, 126, 27);
    // chi^2(1) > 6 occurs in 1.4 % of the other 37 %, and chi^2(3) > 18 almost never.
    EXPECT_LE(lens, 6);
}

TEST(PlaneFitInt64, ATiltOfTenDegreesIsSeen) {
    Rng rng(kSeed);
    const auto [affine, perspective, lens] = choices(radians(10), rng);
    SCOPED_TRACE(testing::Message() << affine << " affine, " << perspective << " perspective, "
                                    << lens << " lens, seed " << kSeed);
    EXPECT_EQ(affine, 0);
    // chi^2(1) > 6, which adds a lens, occurs in 1.4 %.
    EXPECT_GE(perspective, 188);
    EXPECT_EQ(affine + perspective + lens, 200);
}

TEST(PlaneFitInt64, WhatDoesNotDetermineAPlaneGivesNone) {
    Rng rng(kSeed);
    const Vec2 image{188, 120};
    const TruePlane truth = random_plane(rng, image, 11, Terms::perspective);
    const PlaneFromImage estimate = guess(truth, rng);
    FittedPlane found;
    for (const int count : {0, 1, 2}) {
        EXPECT_FALSE(fit(estimate, pairs(truth, image, count, rng), found)) << count;
    }
    const auto line = [&](double slope) {
        std::vector<Pair> points;
        for (int i = 0; i < 100; ++i) {
            const FixedVec p = fixed({10 + 1.5 * i, 20 + slope * i}, 8);
            points.push_back({p, fixed(truth(real(p, 8)), 16)});
        }
        return points;
    };
    for (const double slope : {0.0, 0.75, -0.125})
        EXPECT_FALSE(fit(estimate, line(slope), found)) << slope;
    const std::vector<Pair> heap(50, line(0)[0]);
    EXPECT_FALSE(fit(estimate, heap, found));
    // One point that is not on the line is sufficient for an affine map.
    auto points = line(0);
    const FixedVec beside = fixed({90, 90}, 8);
    points.push_back({beside, fixed(truth(real(beside, 8)), 16)});
    EXPECT_TRUE(fit(estimate, points, found, Terms::affine));
}

TEST(PlaneFitInt64, HoldsForTheLargestImageAndMostPoints) {
    // The corners of the image are almost 256 spacings from its centre along one axis.
    const Vec2 image{4096, 4096};
    for (const Terms terms : {Terms::affine, Terms::perspective, Terms::lens}) {
        SCOPED_TRACE(testing::Message() << "terms " << static_cast<int>(terms));
        TruePlane truth;
        truth.centre = {2047.5, 2047.5};
        truth.at_centre = {100.25, -80.5};
        const double step = std::sqrt(0.5) / 12;
        truth.du = {step, step};
        truth.dv = {-step, step};
        if (terms >= Terms::perspective) truth.perspective = {0.02 / 2048, -0.03 / 2048};
        if (terms >= Terms::lens) truth.lens = 0.02 / (2 * 2048.0 * 2048.0);
        std::vector<Pair> points;
        for (int n = 0; n < 128; ++n) {
            for (int m = 0; m < 128; ++m) {
                const FixedVec p = fixed({4095.0 * n / 127, 4095.0 * m / 127}, 8);
                points.push_back({p, fixed(truth(real(p, 8)), 16)});
            }
        }
        PlaneFromImage estimate;
        estimate.centre_q8 = fixed(truth.centre, 8);
        estimate.at_centre_q16 = fixed(truth.at_centre, 16);
        FittedPlane found;
        ASSERT_TRUE(fit(estimate, points, found));
        EXPECT_GE(found.terms, terms);
        // At the corners, at 240 spacings, one unit of the lens (2^-40 r^2) causes an error of
        // 8e-6, and one unit of the perspective (2^-30 per px and axis) an error of 4e-6.
        EXPECT_LT(worst_error(found.plane, truth, image), 3e-3);
    }
}

}  // namespace
}  // namespace dotpose::core_test::plane_fit_int64_test
