// Tests the correction of the bias of facing dots. Two neighbouring dots face each other if they
// are displaced towards each other. Their measured centres are then shifted towards each other,
// whereas the measured centres of other dots are not.
#include "core/pose/facing_dots.hpp"

#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "../float_planes.hpp"
#include "owned_dots.hpp"

namespace dotpose::core_test::facing_dots_test {
namespace {

using core::FloatPlane;

constexpr std::uint64_t kSeed = 95;
constexpr double kDisplacement = 1 / 6.0;
constexpr double kNoise = 0.005;  // in spacings

/// Measured dots, and their true positions in the image. The measured centres of facing dots are
/// shifted towards each other.
class FacingFrame {
  public:
    /// `pull` is the shift of each of two facing dots towards the other, in spacings.
    FacingFrame(const FloatPlane& plane, double pull, Rng& rng) {
        for (int j = -8; j <= 8; ++j) {
            for (int i = -12; i <= 12; ++i)
                symbols_[{i, j}] = static_cast<Symbol>(rng.below(4));
        }
        for (int j = -8; j <= 8; ++j) {
            for (int i = -12; i <= 12; ++i) {
                const Vec2 place = place_of(i, j);
                const Vec2 noise{kNoise * rng.normal(), kNoise * rng.normal()};
                truth_.push_back(image_of(plane, place + noise));
                owned_.add({i, j}, symbols_[{i, j}],
                           image_of(plane, place + noise + pull * facing(i, j)));
                if (rng.uniform() < 0.05) owned_.dots.x[truth_.size() - 1] = kNoDot_px;
            }
        }
    }

    /// Returns the mean distance, in px, of the measured dots from their true positions.
    double mean_error_px() const {
        double sum = 0;
        int count = 0;
        for (std::size_t k = 0; k < truth_.size(); ++k) {
            if (owned_.dots.x[k] >= kNoDot_px) continue;
            sum += length(truth_[k] - Vec2{owned_.dots.x[k], owned_.dots.y[k]});
            ++count;
        }
        return sum / count;
    }
    MeasuredDots& dots() { return owned_.dots; }
    std::size_t count() const { return truth_.size(); }

  private:
    Vec2 place_of(int i, int j) {
        const Symbol symbol = symbols_[{i, j}];
        return {i + kDisplacement * dx(symbol), j + kDisplacement * dy(symbol)};
    }
    /// Returns the direction from a dot to the neighbour that it faces, or (0, 0) if it faces no
    /// neighbour.
    Vec2 facing(int i, int j) {
        const Symbol own = symbols_[{i, j}];
        const std::pair<int, int> other{i + dx(own), j + dy(own)};
        if (!symbols_.contains(other)) return {0, 0};
        const Symbol there = symbols_[other];
        const bool faces = dx(there) == -dx(own) && dy(there) == -dy(own);
        return faces ? Vec2{1.0 * dx(own), 1.0 * dy(own)} : Vec2{0, 0};
    }

    std::map<std::pair<int, int>, Symbol> symbols_;
    std::vector<Vec2> truth_;
    OwnedDots owned_;
};

core::PoseFit fit_with(double pull) {
    core::PoseFit fit;
    fit.displacement = static_cast<float>(kDisplacement);
    // A quarter of the dots are shifted along one of the two axes, so one coordinate in eight is
    // shifted.
    fit.variance = static_cast<float>(kNoise * kNoise + pull * pull / 8);
    return fit;
}

TEST(FacingDots, AreMovedApartByWhatDrawsThemTogether) {
    Rng rng(kSeed);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const double spacing_px = rng.uniform(7, 12);
        const FloatPlane plane = random_float_plane(spacing_px, rng.uniform(0, 4e-4), rng);
        constexpr double kPull = 0.014;
        FacingFrame frame(plane, kPull, rng);
        // A quarter of the dots face a neighbour.
        EXPECT_NEAR(frame.mean_error_px(), kPull * spacing_px / 4, kPull * spacing_px / 12);
        ASSERT_TRUE(core::correct_neighbour_bias(plane, fit_with(kPull), frame.dots()));
        EXPECT_LT(frame.mean_error_px(), 0.1 * kPull * spacing_px);
    }
}

TEST(FacingDots, StayWhereTheyAreIfNothingDrawsThemTogether) {
    Rng rng(kSeed);
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << i << ", seed " << kSeed);
        const FloatPlane plane = random_float_plane(8, rng.uniform(0, 4e-4), rng);
        FacingFrame frame(plane, 0, rng);
        EXPECT_FALSE(core::correct_neighbour_bias(plane, fit_with(0), frame.dots()));
    }
}

TEST(FacingDots, AreNotNeededAmongFewDots) {
    core::PoseFit fit = fit_with(0.01);
    OwnedDots owned;
    const FloatPlane plane{};
    EXPECT_FALSE(core::correct_neighbour_bias(plane, fit, owned.dots));
    owned.add({0, 0}, Symbol::right, {0, 0});
    EXPECT_FALSE(core::correct_neighbour_bias(plane, fit, owned.dots));
}

}  // namespace
}  // namespace dotpose::core_test::facing_dots_test
