// Tests the quick estimate of how much of the residuals a rotation during the readout explains. The
// positions of the dots are computed in double precision.
#include "core/pose/turn_fit.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "owned_dots.hpp"

namespace dotpose::core_test::turn_fit_test {
namespace {

using core::FloatPlane;

constexpr std::uint64_t kSeed = 79;
constexpr double kDisplacement = 1 / 6.0;
constexpr double kNoise_px = 0.1;
constexpr int kPlanes = 40;

/// Returns the image point at which a scene point appears if the scene rotates about the image
/// centre by `rad_per_row`, starting from its position in the middle row.
Vec2 seen_while_turning(Vec2 px, double rad_per_row) {
    Vec2 seen = px;
    for (int i = 0; i < 50; ++i) {
        const double angle = rad_per_row * seen.y;
        seen = {std::cos(angle) * px.x - std::sin(angle) * px.y,
                std::sin(angle) * px.x + std::cos(angle) * px.y};
    }
    return seen;
}

/// Adds the dots on the plane that are visible in an image of 96 x 96 px.
void show_dots(const FloatPlane& plane, double rad_per_row, Rng& rng, OwnedDots& owned) {
    for (int j = -14; j <= 14; ++j) {
        for (int i = -14; i <= 14; ++i) {
            const auto symbol = static_cast<Symbol>(rng.below(4));
            const Vec2 place{i + kDisplacement * dx(symbol), j + kDisplacement * dy(symbol)};
            const Vec2 px = seen_while_turning(image_of(plane, place), rad_per_row) +
                            kNoise_px * Vec2{rng.normal(), rng.normal()};
            if (std::abs(px.x) < 46 && std::abs(px.y) < 46) owned.add({i, j}, symbol, px);
        }
    }
}

float gain_of(const OwnedDots& owned, const FloatPlane& plane) {
    constexpr float kReach_px = 49;
    constexpr float kLimit = 1;
    return core::gain_of_turn({}, kReach_px, owned.dots, plane, static_cast<float>(kDisplacement),
                              kLimit);
}

TEST(GainOfTurn, IsLargeIfTheSceneTurns) {
    Rng rng(kSeed);
    for (int i = 0; i < kPlanes; ++i) {
        const FloatPlane plane = random_float_plane(rng.uniform(6, 10), 0, rng);
        OwnedDots owned;
        constexpr double kTurn_rad = 0.035;  // 2 degrees
        show_dots(plane, (i % 2 == 0 ? kTurn_rad : -kTurn_rad) / 96, rng, owned);
        EXPECT_GT(gain_of(owned, plane), 0.5F) << i << ", seed " << kSeed;
    }
}

/// Expects a small gain for still scenes. `change` makes the plane wrong before the gain is
/// computed.
template <typename Change>
void expect_small_gain(Change change) {
    Rng rng(kSeed);
    for (int i = 0; i < kPlanes; ++i) {
        FloatPlane plane = random_float_plane(rng.uniform(6, 10), 0, rng);
        OwnedDots owned;
        show_dots(plane, 0, rng, owned);
        change(plane);
        // Noise alone gives dots * gain a chi-squared distribution with one degree of freedom.
        EXPECT_LT(gain_of(owned, plane), 16.0F / static_cast<float>(owned.dots.count))
            << i << ", seed " << kSeed;
    }
}

TEST(GainOfTurn, IsSmallForNoise) {
    expect_small_gain([](FloatPlane&) {});
}

TEST(GainOfTurn, ExcludesWhatThePlaneAbsorbs) {
    expect_small_gain([](FloatPlane& plane) {
        plane.at_x += 0.1F;
        plane.du_y += 1e-3F;
        plane.tilt_x += 2e-4F;
        plane.tilt_y -= 2e-4F;
    });
}

}  // namespace
}  // namespace dotpose::core_test::turn_fit_test
