// Tests the posterior of the distortion terms against numerical integration.
#include "core/fit/posterior.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "dotpose/tools/random.hpp"

namespace dotpose::core_test::posterior_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 62;
constexpr DistortionPrior kTwo{kTilt, 2, {{{0.3F, 0}, {0.5F, 0.02F}, {0.2F, 0.2F}}}};
constexpr DistortionPrior kOne{kBend, 1, {{{0.6F, 0}, {0.3F, 0.02F}, {0.1F, 0.2F}}}};

/// Returns the normal equations of random points. The points determine all parameters, and the
/// errors of the parameters are correlated.
PlaneNormal random_normal(Rng& rng) {
    const auto random = [&] {
        Four values;
        for (int i = 0; i < 4; ++i)
            values[i] = static_cast<float>(rng.uniform(-1, 1));
        return values;
    };
    PlaneSums sums;
    for (int i = 0; i < 8; ++i)
        sums.add({random(), random()}, {{Four{}, Four{}}, Four{1, 1, 1, 1}});
    PlaneNormal normal(sums.all());
    EXPECT_TRUE(normal.decompose());
    return normal;
}

double density(double x, double variance) {
    return std::exp(-x * x / (2 * variance)) / std::sqrt(variance);
}

/// Posterior mean and covariance of the whitened terms, computed by summation over a fine grid of
/// values.
struct Integral {
    double mean[2] = {};
    double covariance[2][2] = {};

    Integral(const DistortionPrior& terms, const PlaneNormal& normal, const double (&seen)[2],
             double variance, double unit) {
        const std::size_t i = terms.first;
        const double a = normal.factor(i, i);
        const double b = terms.count > 1 ? normal.factor(i + 1, i) : 0;
        const double c = terms.count > 1 ? normal.factor(i + 1, i + 1) : 0;
        double sum = 0;
        double sums[2] = {};
        double squares[2][2] = {};
        const auto add = [&](double p, double q, double probability) {
            const double white[2] = {a * p + b * q, c * q};
            const double weight = probability * density(seen[0] - white[0], variance) *
                                  density(seen[1] - white[1], variance);
            sum += weight;
            for (int r = 0; r < 2; ++r) {
                sums[r] += weight * white[r];
                for (int s = 0; s < 2; ++s)
                    squares[r][s] += weight * white[r] * white[s];
            }
        };
        for (const DistortionPrior::Kind& kind : terms.kinds) {
            const double deviation = static_cast<double>(kind.deviation) * unit;
            const auto probability = static_cast<double>(kind.probability);
            if (deviation == 0) {
                add(0, 0, probability);
                continue;
            }
            constexpr int kSteps = 300;
            constexpr double kReach = 6;
            constexpr double kStep = 2 * kReach / kSteps;
            const double per_step = kStep / std::sqrt(2 * std::acos(-1.0));
            for (int m = -kSteps / 2; m <= kSteps / 2; ++m) {
                const double x = m * kStep;
                if (terms.count == 1) {
                    add(x * deviation, 0, probability * per_step * density(x, 1));
                    continue;
                }
                for (int n = -kSteps / 2; n <= kSteps / 2; ++n) {
                    const double y = n * kStep;
                    add(x * deviation, y * deviation,
                        probability * per_step * per_step * density(x, 1) * density(y, 1));
                }
            }
        }
        for (int r = 0; r < 2; ++r) {
            mean[r] = sums[r] / sum;
            for (int s = 0; s < 2; ++s)
                covariance[r][s] = squares[r][s] / sum - sums[r] * sums[s] / (sum * sum);
        }
    }
};

void expect_integral(const DistortionPrior& terms, Rng& rng) {
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE(testing::Message() << "case " << i << ", seed " << kSeed);
        const PlaneNormal normal = random_normal(rng);
        const double variance = rng.uniform(0.01, 0.05);
        const double unit = rng.uniform(0.5, 2);
        const double reach = 5 * std::sqrt(variance) * rng.uniform();
        const double seen[2] = {rng.uniform(-reach, reach),
                                terms.count > 1 ? rng.uniform(-reach, reach) : 0};
        Parameters whitened{};
        for (std::size_t k = 0; k < terms.count; ++k)
            whitened[terms.first + k] = static_cast<float>(seen[k]);
        const Posterior posterior = posterior_of(
            terms, normal, whitened, static_cast<float>(variance), static_cast<float>(unit));
        const Integral expected(terms, normal, seen, variance, unit);
        for (std::size_t r = 0; r < terms.count; ++r) {
            EXPECT_NEAR(posterior.mean[r], expected.mean[r], 0.001 * std::sqrt(variance));
            for (std::size_t s = 0; s < terms.count; ++s)
                EXPECT_NEAR(posterior.covariance[r][s], expected.covariance[r][s],
                            0.001 * variance);
        }
    }
}

TEST(Posterior, OfTwoTermsIsTheIntegralOverAllTheyMightBe) {
    Rng rng(kSeed);
    expect_integral(kTwo, rng);
}

TEST(Posterior, OfOneTermIsTheIntegralOverAllItMightBe) {
    Rng rng(kSeed);
    expect_integral(kOne, rng);
}

TEST(Posterior, WhatIsSeenBeyondDoubtIsKept) {
    Rng rng(kSeed);
    const PlaneNormal normal = random_normal(rng);
    Parameters whitened{};
    whitened[kTilt] = 0.1F;
    whitened[kTilt + 1] = -0.2F;
    const Posterior posterior = posterior_of(kTwo, normal, whitened, 1e-8F, 1);
    EXPECT_NEAR(posterior.mean[0], 0.1, 1e-4);
    EXPECT_NEAR(posterior.mean[1], -0.2, 1e-4);
    EXPECT_NEAR(posterior.covariance[0][0], 1e-8, 1e-10);
}

TEST(Posterior, TermsThatNothingTellsAreNone) {
    const Posterior posterior = posterior_of(kTwo, PlaneNormal{}, Parameters{}, 0.01F, 1);
    EXPECT_EQ(posterior.mean[0], 0);
    EXPECT_EQ(posterior.covariance[1][1], 0);
}

}  // namespace
}  // namespace dotpose::core_test::posterior_test
