// Tests the correction of the pixel bias in frames whose dots all have the same sub-pixel phase.
// The dots are drawn with the shape of the dot model, and with other shapes.
#include "core/pose/pixel_bias.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "core/kernels/select.hpp"
#include "drawn_dot.hpp"
#include "owned_dots.hpp"

namespace dotpose::core_test::pixel_bias_test {
namespace {

constexpr std::uint64_t kSeed = 91;
constexpr int kSpacing_px = 12;
constexpr int kPaper = 200;
constexpr double kContrast = 0.85;
constexpr double kNoise = 3;
constexpr double kBlur_px = 0.3;

/// Mean error of the measured centres before and after the correction, in px.
struct MeanError {
    Vec2 before;
    Vec2 after;
    core::FloatVec variance_px2;
};

/// A frame whose dots have equal sub-pixel phases, because the spacing and the displacement are
/// integer multiples of the pixel size.
class AlikeFrame {
  public:
    AlikeFrame(const DrawnDot& dot, Vec2 phase, Rng& rng)
        : image_(blank(188, 120, kPaper)), light_(image_.pixels.size(), kPaper) {
        for (int row = -4; row <= 4; ++row) {
            for (int column = -7; column <= 7; ++column) {
                const auto symbol = static_cast<Symbol>(rng.below(4));
                const int u = kMiddle_u + kSpacing_px * column + 2 * dx(symbol);
                const int v = kMiddle_v + kSpacing_px * row + 2 * dy(symbol);
                add(dot, u, v);
                // Simulates a centroid error of 0.1 px along each axis.
                const Vec2 found{u - kMiddle_u + phase.x + 0.1, v - kMiddle_v + phase.y - 0.1};
                owned_.add({column, row}, symbol, found);
                truth_.push_back({u - kMiddle_u + phase.x, v - kMiddle_v + phase.y});
                const auto k = static_cast<std::size_t>(owned_.dots.count - 1);
                owned_.dots.paper[k] = kPaper;
                owned_.dots.mass[k] = 1000;
                owned_.dots.window_u[k] = u - 4;
                owned_.dots.window_v[k] = v - 4;
            }
        }
        for (std::size_t i = 0; i < light_.size(); ++i) {
            image_.pixels[i] = static_cast<std::uint8_t>(
                std::clamp<long>(std::lround(light_[i] + kNoise * rng.normal()), 0, 255));
        }
    }

    MeanError measure(float dot_radius_px) {
        const core::CentroidWindow window{
            std::max(2.4F * dot_radius_px, 3.3F), dot_radius_px, {kMiddle_u, kMiddle_v}};
        core::CellsInView view;
        view.centre_x = kMiddle_u;
        view.centre_y = kMiddle_v;
        core::MeasuredDots& dots = owned_.dots;
        // The second measurement starts from the centroids of the first.
        for (int look = 0; look < 2; ++look) {
            core::recentre_windows(image_.view(), window, dots);
            core::kernels().refine_centres(image_.view(), view, window.radius_px, dots);
        }
        MeanError error;
        error.before = mean_error();
        // The error of a plane fitted to the measured centres is the mean error of the centres.
        const Vec2 origin = truth_.front() + error.before - place_of_first();
        core::FloatPlane plane;
        plane.du_x = plane.dv_y = 1.0F / kSpacing_px;
        plane.at_x = static_cast<float>(-origin.x / kSpacing_px);
        plane.at_y = static_cast<float>(-origin.y / kSpacing_px);
        core::PoseFit fit;
        fit.displacement = 2.0F / kSpacing_px;
        fit.variance = 0.004F * 0.004F;
        error.variance_px2 = core::correct_pixel_bias(image_.view(), window, plane, fit, dots);
        error.after = mean_error();
        return error;
    }

  private:
    static constexpr int kMiddle_u = 94;
    static constexpr int kMiddle_v = 60;

    void add(const DrawnDot& dot, int u0, int v0) {
        for (int v = -DrawnDot::kHalf_px; v <= DrawnDot::kHalf_px; ++v) {
            for (int u = -DrawnDot::kHalf_px; u <= DrawnDot::kHalf_px; ++u) {
                light_[static_cast<std::size_t>((v0 + v) * image_.width_px + u0 + u)] -=
                    kPaper * kContrast * dot.at(u, v);
            }
        }
    }
    Vec2 place_of_first() const {
        const auto symbol = static_cast<Symbol>(owned_.dots.bits[0]);
        return {kSpacing_px * static_cast<double>(owned_.dots.column[0]) + 2 * dx(symbol),
                kSpacing_px * static_cast<double>(owned_.dots.row[0]) + 2 * dy(symbol)};
    }
    Vec2 mean_error() const {
        Vec2 sum;
        for (std::size_t k = 0; k < truth_.size(); ++k)
            sum = sum + Vec2{double{owned_.dots.x[k]} - truth_[k].x,
                             double{owned_.dots.y[k]} - truth_[k].y};
        return (1.0 / static_cast<double>(truth_.size())) * sum;
    }

    GreyImage image_;
    std::vector<double> light_;  ///< brightness without noise
    OwnedDots owned_;
    std::vector<Vec2> truth_;
};

/// A function that draws a dot with the given sub-pixel phase.
using DotAt = std::function<DrawnDot(Vec2)>;

/// Returns the rms errors per axis over frames with random phases.
MeanError typical_error(const DotAt& dot_at, float dot_radius_px) {
    constexpr int kFrames = 40;
    Rng rng(kSeed);
    Vec2 before;
    Vec2 after;
    float variance = 0;
    for (int i = 0; i < kFrames; ++i) {
        const Vec2 phase{rng.uniform(-0.5, 0.5), rng.uniform(-0.5, 0.5)};
        const MeanError error = AlikeFrame(dot_at(phase), phase, rng).measure(dot_radius_px);
        before = before + Vec2{error.before.x * error.before.x, error.before.y * error.before.y};
        after = after + Vec2{error.after.x * error.after.x, error.after.y * error.after.y};
        variance += (error.variance_px2.x + error.variance_px2.y) / 2;
    }
    const auto root = [](double sum) { return std::sqrt(sum / kFrames); };
    return {{root(before.x), root(before.y)},
            {root(after.x), root(after.y)},
            {variance / kFrames, variance / kFrames}};
}

MeanError typical_error(const InkAt& ink, float dot_radius_px) {
    return typical_error([&](Vec2 phase) { return drawn_dot(ink, phase, kBlur_px); },
                         dot_radius_px);
}

TEST(PixelBias, IsTakenFromDiscs) {
    const MeanError error = typical_error(disc(1), 1.05F);
    EXPECT_GT(error.before.x, 0.006);
    EXPECT_GT(error.before.y, 0.006);
    // Noise alone causes an error of 0.0016 px.
    EXPECT_LT(error.after.x, 0.0024);
    EXPECT_LT(error.after.y, 0.0024);
}

TEST(PixelBias, IsTakenFromSmallAndLargeDiscs) {
    for (const double radius : {0.6, 1.5, 2.1}) {
        SCOPED_TRACE(radius);
        const MeanError error = typical_error(disc(radius), static_cast<float>(radius) + 0.1F);
        EXPECT_LT(error.after.x, 0.75 * error.before.x);
        EXPECT_LT(error.after.y, 0.75 * error.before.y);
    }
}

/// An oblique motion blur tilts the image of a dot. If the dot is not centred in its window along
/// one axis, its centroid is then also shifted along the other axis.
TEST(PixelBias, IsTakenFromObliquelyMovingDots) {
    const DotAt moving = [](Vec2 phase) { return moving_dot(disc(1), phase, kBlur_px, {1, -0.7}); };
    const MeanError error = typical_error(moving, 1.15F);
    EXPECT_LT(error.after.x, 0.0024);
    EXPECT_LT(error.after.y, 0.0024);
}

/// Real dots consist of square printer pixels, and are elongated if the paper is fed unevenly.
TEST(PixelBias, IsNotMadeWorseByOtherShapes) {
    for (const InkAt& ink : {square(1.77), ellipse(1.15, 0.87), ellipse(0.8, 1.25)}) {
        const MeanError error = typical_error(ink, 1.05F);
        const double left = std::sqrt(error.variance_px2.x);
        EXPECT_LT(error.after.x, error.before.x + left);
        EXPECT_LT(error.after.y, error.before.y + left);
    }
}

}  // namespace
}  // namespace dotpose::core_test::pixel_bias_test
