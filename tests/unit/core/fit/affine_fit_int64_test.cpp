// Affine least-squares maps, compared with a second solution in long double precision.
#include "core/fit/affine_fit_int64.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "../geometry.hpp"

namespace dotpose::core_test::affine_fit_int64_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 21;

struct Pair {
    FixedVec source;
    FixedVec target;
};

struct Reference {
    long double mean_x = 0, mean_y = 0;
    long double xx = 0, xy = 0, yy = 0;
    /// The solution for one target coordinate: slopes along x and y, and the value at source (0,
    /// 0).
    struct Line {
        long double dx, dy, offset;
    } x{}, y{};
};

/// Solves the normal equations about the means.
Reference least_squares(const std::vector<Pair>& pairs) {
    Reference r;
    const auto n = static_cast<long double>(pairs.size());
    long double mean_tx = 0;
    long double mean_ty = 0;
    for (const auto& [s, t] : pairs) {
        r.mean_x += s.x / n;
        r.mean_y += s.y / n;
        mean_tx += t.x / n;
        mean_ty += t.y / n;
    }
    long double xtx = 0, ytx = 0, xty = 0, yty = 0;
    for (const auto& [s, t] : pairs) {
        const long double x = s.x - r.mean_x;
        const long double y = s.y - r.mean_y;
        r.xx += x * x;
        r.xy += x * y;
        r.yy += y * y;
        xtx += x * (t.x - mean_tx);
        ytx += y * (t.x - mean_tx);
        xty += x * (t.y - mean_ty);
        yty += y * (t.y - mean_ty);
    }
    const long double determinant = r.xx * r.yy - r.xy * r.xy;
    const auto line = [&](long double xt, long double yt, long double mean_t) {
        const long double dx = (xt * r.yy - yt * r.xy) / determinant;
        const long double dy = (yt * r.xx - xt * r.xy) / determinant;
        return Reference::Line{dx, dy, mean_t - dx * r.mean_x - dy * r.mean_y};
    };
    r.x = line(xtx, ytx, mean_tx);
    r.y = line(xty, yty, mean_ty);
    return r;
}

AffineFitInt64 fit_of(const std::vector<Pair>& pairs) {
    AffineFitInt64 fit;
    for (const auto& [s, t] : pairs)
        fit.add(s, t);
    return fit;
}

/// Compares the values of the two maps at the points. The entries of the integer map are rounded to
/// 2^-fraction_bits. The tolerance is twice the resulting error plus one unit.
void expect_same_map(const std::vector<Pair>& pairs, int fraction_bits) {
    AffineMap map;
    ASSERT_TRUE(fit_of(pairs).solve(fraction_bits, map));
    const Reference r = least_squares(pairs);
    const long double unit = std::ldexp(1.0L, -fraction_bits);
    for (const auto& [s, t] : pairs) {
        const long double tolerance =
            1 + unit * (std::abs(s.x - r.mean_x) + std::abs(s.y - r.mean_y));
        const long double x = unit * (static_cast<long double>(map.offset_x) +
                                      static_cast<long double>(map.dx.x) * s.x +
                                      static_cast<long double>(map.dy.x) * s.y);
        const long double y = unit * (static_cast<long double>(map.offset_y) +
                                      static_cast<long double>(map.dx.y) * s.x +
                                      static_cast<long double>(map.dy.y) * s.y);
        ASSERT_LE(std::abs(x - (r.x.offset + r.x.dx * s.x + r.x.dy * s.y)), tolerance);
        ASSERT_LE(std::abs(y - (r.y.offset + r.y.dx * s.x + r.y.dy * s.y)), tolerance);
    }
}

std::int32_t whole(double value) {
    return static_cast<std::int32_t>(std::lround(value));
}

/// Returns points of an image, in 1/256 px, and their noisy places on a pattern, in 2^-16 spacings.
std::vector<Pair> image_and_pattern(Rng& rng, int count, double side_px, double spacing_px) {
    const double angle = rng.uniform(0, 6.3);
    const double step = 256 / spacing_px;
    const double offset = rng.uniform(-3e6, 3e6);
    std::vector<Pair> pairs;
    for (int i = 0; i < count; ++i) {
        const double x = 256 * rng.uniform(-side_px, side_px);
        const double y = 256 * rng.uniform(-side_px, side_px);
        const double tx = offset + step * (std::cos(angle) * x - std::sin(angle) * y);
        const double ty = -offset + step * (std::sin(angle) * x + std::cos(angle) * y);
        pairs.push_back({{whole(x), whole(y)},
                         {whole(tx + 5000 * rng.normal()), whole(ty + 5000 * rng.normal())}});
    }
    return pairs;
}

TEST(Affine, AgreesWithLongDouble) {
    Rng rng(kSeed);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "set " << i << ", seed " << kSeed);
        const int count = 3 + static_cast<int>(rng.below(400));
        const double spacing_px = rng.uniform(6, 60);
        // The image is at most 100 spacings wide, to keep the target below 2^24.
        const double side_px = std::min(rng.uniform(20, 2000), 100 * spacing_px);
        expect_same_map(image_and_pattern(rng, count, side_px, spacing_px), 16);
    }
}

TEST(Affine, RecoversAnExactMap) {
    std::vector<Pair> pairs;
    for (int j = -7; j <= 9; ++j) {
        for (int i = -12; i <= 4; ++i) {
            pairs.push_back(
                {{i * 256, j * 256}, {3 * i * 256 - 2 * j * 256 + 77, 5 * j * 256 - 1000}});
        }
    }
    AffineMap map;
    ASSERT_TRUE(fit_of(pairs).solve(16, map));
    EXPECT_NEAR(map.dx.x, 3 * 65536, 1);
    EXPECT_NEAR(map.dy.x, -2 * 65536, 1);
    EXPECT_NEAR(map.dx.y, 0, 1);
    EXPECT_NEAR(map.dy.y, 5 * 65536, 1);
    EXPECT_NEAR(static_cast<double>(map.offset_x), 77 * 65536, 65536 / 16);
    EXPECT_NEAR(static_cast<double>(map.offset_y), -1000 * 65536, 65536 / 16);
}

TEST(Affine, ThreePointsFitExactly) {
    expect_same_map({{{0, 0}, {10, -10}}, {{1000, 0}, {3000, 400}}, {{0, 900}, {-500, 7000}}}, 16);
}

TEST(Affine, PointsOnALineDetermineNothing) {
    AffineMap map;
    EXPECT_FALSE(AffineFitInt64{}.solve(16, map));
    EXPECT_FALSE(fit_of({{{0, 0}, {1, 1}}, {{5, 9}, {3, 4}}}).solve(16, map));
    const std::vector<FixedVec> directions{{1, 0}, {0, 1}, {1, 1}, {-3, 7}, {100, 1}, {1, 1000}};
    for (const FixedVec d : directions) {
        for (const FixedVec corner : {FixedVec{0, 0}, FixedVec{8000000, -8000000}}) {
            AffineFitInt64 fit;
            for (int i = 0; i < 200; ++i) {
                fit.add({corner.x + i * d.x, corner.y + i * d.y}, {i, i * i % 71});
            }
            EXPECT_FALSE(fit.solve(16, map)) << d.x << ", " << d.y << " from " << corner.x;
        }
    }
    AffineFitInt64 one_place;
    for (int i = 0; i < 50; ++i)
        one_place.add({-123456, 654321}, {i, -i});
    EXPECT_FALSE(one_place.solve(16, map));
}

TEST(Affine, AStripOfDotsStillFits) {
    // The strip is 40 cells long and 2 cells wide, which is well-conditioned.
    Rng rng(kSeed);
    std::vector<Pair> pairs;
    for (int i = 0; i < 80; ++i) {
        const FixedVec s{i / 2 * 2816, i % 2 * 2816};
        pairs.push_back({s,
                         {23 * s.x - 5 * s.y + whole(5000 * rng.normal()),
                          5 * s.x + 23 * s.y + whole(5000 * rng.normal())}});
    }
    expect_same_map(pairs, 16);
}

TEST(Affine, HoldsAtItsDocumentedLimits) {
    // 2^14 points with coordinates up to 2^24 - 1. The sanitizer reports any overflow.
    constexpr int kMost = 1 << 14;
    constexpr std::int32_t kFar = (1 << 24) - 1;
    Rng rng(kSeed);
    const auto anywhere = [&] { return static_cast<std::int32_t>(rng.below(2 * kFar + 1)) - kFar; };
    std::vector<Pair> corners;
    std::vector<Pair> identity;
    std::vector<Pair> far_off;
    for (int i = 0; i < kMost; ++i) {
        const FixedVec corner{i & 1 ? kFar : -kFar, i & 2 ? kFar : -kFar};
        corners.push_back({corner, {-corner.y, corner.x}});
        const FixedVec any{anywhere(), anywhere()};
        identity.push_back({any, any});
        const FixedVec distant{kFar - static_cast<std::int32_t>(rng.below(200000)),
                               -kFar + static_cast<std::int32_t>(rng.below(200000))};
        far_off.push_back({distant, {distant.y, -distant.x}});
    }
    expect_same_map(corners, 16);
    expect_same_map(identity, 16);
    expect_same_map(far_off, 16);
}

TEST(Affine, MomentsAndMeanAreThoseOfTheSources) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        const std::vector<Pair> pairs =
            image_and_pattern(rng, 1 + static_cast<int>(rng.below(300)), 2000, 11 * 40);
        const AffineFitInt64 fit = fit_of(pairs);
        const Reference r = least_squares(pairs);
        const AffineFitInt64::Moments m = fit.source_moments();
        ASSERT_EQ(fit.count(), static_cast<int>(pairs.size()));
        ASSERT_NEAR(fit.source_mean().x, static_cast<double>(r.mean_x), 0.51);
        ASSERT_NEAR(fit.source_mean().y, static_cast<double>(r.mean_y), 0.51);
        ASSERT_NEAR(static_cast<double>(m.xx), static_cast<double>(r.xx), 1);
        ASSERT_NEAR(static_cast<double>(m.xy), static_cast<double>(r.xy), 1);
        ASSERT_NEAR(static_cast<double>(m.yy), static_cast<double>(r.yy), 1);
    }
    EXPECT_EQ(AffineFitInt64{}.source_mean(), FixedVec{});
    EXPECT_EQ(AffineFitInt64{}.source_moments().xx, 0);
}

TEST(Affine, ScaledQuotientsAreRounded) {
    EXPECT_EQ(scaled_quotient(0, 5, 60), 0);
    EXPECT_EQ(scaled_quotient(1, 3, 0), 0);
    EXPECT_EQ(scaled_quotient(-7, 2, -1), -2);
    Rng rng(kSeed);
    for (int i = 0; i < 100000; ++i) {
        const auto n = static_cast<std::int64_t>(rng.bits()) >> (2 + rng.below(61));
        const auto d = static_cast<std::int64_t>((rng.bits() >> (2 + rng.below(61))) + 1);
        const int shift = static_cast<int>(rng.below(100)) - 40;
        const long double exact =
            std::ldexp(static_cast<long double>(n) / static_cast<long double>(d), shift);
        if (std::abs(exact) > 1073741824.0L) continue;
        // The bits dropped from the divisor amount to 2^-29 of the result.
        const double tolerance = 1.01 + std::ldexp(static_cast<double>(std::abs(exact)), -28);
        ASSERT_NEAR(scaled_quotient(n, d, shift), static_cast<double>(exact), tolerance)
            << n << " * 2^" << shift << " / " << d << ", seed " << kSeed;
    }
}

}  // namespace
}  // namespace dotpose::core_test::affine_fit_int64_test
