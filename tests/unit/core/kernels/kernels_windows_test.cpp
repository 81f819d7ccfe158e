// Tests the kernels that measure centroid windows and compute the centres of dots. Compares them
// with simple reference computations.
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/kernels/kernels.hpp"
#include "random_inputs.hpp"

namespace dotpose::core_test::kernels_windows_test {
namespace {

using namespace core;

/// Compares the paper level and the sums of dot `k` with those computed in a loop over the pixels
/// of its window.
void expect_sums(const Picture& picture, int half_px, int cut_q8, const MeasuredDots& dots,
                 std::size_t k) {
    const int u = dots.window_u[k];
    const int v = dots.window_v[k];
    const auto corner = [&](int du, int dv) {
        return picture.at(std::clamp(u + du, 0, picture.view.width_px - 1),
                          std::clamp(v + dv, 0, picture.view.height_px - 1));
    };
    const int paper = (corner(-half_px, -half_px) + corner(half_px, -half_px) +
                       corner(-half_px, half_px) + corner(half_px, half_px) + 2) /
                      4;
    const int cut = paper - (paper * cut_q8 >> 8);
    int mass = 0;
    int sum_u = 0;
    int sum_v = 0;
    for (int dv = -half_px; dv <= half_px; ++dv) {
        for (int du = -half_px; du <= half_px; ++du) {
            const int dark = std::max(cut - picture.at_or_white(u + du, v + dv), 0);
            mass += dark;
            sum_u += du * dark;
            sum_v += dv * dark;
        }
    }
    ASSERT_EQ(dots.paper[k], paper) << u << ' ' << v << " half " << half_px;
    ASSERT_EQ(dots.mass[k], mass) << u << ' ' << v << " half " << half_px;
    ASSERT_EQ(dots.sum_u[k], sum_u) << u << ' ' << v << " half " << half_px;
    ASSERT_EQ(dots.sum_v[k], sum_v) << u << ' ' << v << " half " << half_px;
}

TEST(KernelsWindows, WindowsAreSummedUpToTheBorder) {
    repeat_with_each_form(40, [](const Kernels& kernels, Rng& rng) {
        Picture picture(whole(rng, 64, 200), whole(rng, 64, 200), whole(rng, 0, 3), rng);
        const int half_px = whole(rng, 2, kMaxHalfWindow_px);
        CellsInView view;
        view.centre_x = static_cast<float>(picture.view.width_px - 1) / 2;
        view.centre_y = static_cast<float>(picture.view.height_px - 1) / 2;
        view.width_px = static_cast<float>(picture.view.width_px);
        view.height_px = static_cast<float>(picture.view.height_px);
        view.plane = {0, 0, 0.1F, 0, 0, 0.1F, 0, 0, 0};
        DotTable table(200);
        table.dots.count = 200;
        for (std::size_t k = 0; k < 200; ++k) {
            table.dots.window_u[k] = whole(rng, 0, picture.view.width_px - 1);
            table.dots.window_v[k] = whole(rng, 0, picture.view.height_px - 1);
        }
        // Includes windows around the first and the last pixel of the image.
        table.dots.window_u[0] = table.dots.window_v[0] = 0;
        table.dots.window_u[1] = picture.view.width_px - 1;
        table.dots.window_v[1] = picture.view.height_px - 1;
        table.dots.window_u[2] = picture.view.width_px - 1 - half_px;
        table.dots.window_v[2] = picture.view.height_px - 1 - half_px;
        const int cut_q8 = whole(rng, 10, 220);
        kernels.measure_windows(picture.view, view, {static_cast<float>(half_px), 1, cut_q8},
                                table.dots);
        for (std::size_t k = 0; k < 200; ++k) {
            expect_sums(picture, half_px, cut_q8, table.dots, k);
            if (testing::Test::HasFatalFailure()) return;
        }
    });
}

/// An image of one dot, and a possible output of `measure_windows` for this dot.
struct OneDot {
    static constexpr int kSide_px = 80;
    static constexpr double kPaper = 200;
    std::vector<std::uint8_t> pixels;
    ImageView view{nullptr, kSide_px, kSide_px, kSide_px};
    CellsInView cells;
    DotTable table{8};

    /// Draws a Gaussian dot at (u, v). Its predicted position is `off_px` too far to the right and
    /// `off_px` too far down.
    OneDot(double u, double v, double sigma_px, double off_px) {
        for (int y = 0; y < kSide_px; ++y) {
            for (int x = 0; x < kSide_px; ++x) {
                const double squared = (x - u) * (x - u) + (y - v) * (y - v);
                const double dark = 160 * std::exp(-squared / (2 * sigma_px * sigma_px));
                pixels.push_back(static_cast<std::uint8_t>(std::lround(kPaper - dark)));
            }
        }
        view.pixels = pixels.data();
        MeasuredDots& dots = table.dots;
        dots.count = 1;
        dots.window_u[0] = static_cast<int>(u);
        dots.window_v[0] = static_cast<int>(v);
        dots.mass[0] = 10000;
        dots.sum_u[0] = static_cast<int>(std::lround(10000 * (u + off_px - dots.window_u[0])));
        dots.sum_v[0] = static_cast<int>(std::lround(10000 * (v + off_px - dots.window_v[0])));
        dots.paper[0] = static_cast<int>(kPaper);
        dots.x[0] = static_cast<float>(u + off_px);
        dots.y[0] = static_cast<float>(v + off_px);
    }
};

TEST(KernelsWindows, CentresAreFoundWhereDotsAre) {
    repeat_with_each_form(200, [](const Kernels& kernels, Rng& rng) {
        constexpr double kMargin_px = 2;
        const double sigma_px = rng.uniform(0.7, 4);
        // A smaller window would contain little more than the top of the dot, which is flat because
        // grey levels are integers.
        const auto reach_px = static_cast<float>(rng.uniform(std::max(3.3, 2.5 * sigma_px), 12));
        const auto anywhere = [&] { return rng.uniform(20, OneDot::kSide_px - 21); };
        const auto at_border = [&] { return rng.uniform(kMargin_px, kMargin_px + 1); };
        // Only small dots are drawn at the border because a large dot would be only partly in view.
        const bool is_inside = sigma_px > 0.8 || rng.below(2) == 0;
        const double u = is_inside ? anywhere() : at_border();
        const double v = anywhere();
        OneDot dot(u, v, sigma_px, rng.uniform(-0.15, 0.15));
        kernels.refine_centres(dot.view, dot.cells, reach_px, dot.table.dots);
        // Rounding to grey levels causes an error of a few thousandths of a pixel. The error is
        // larger if the border of the image cuts off the rim of the dot.
        const double max_px = is_inside ? 0.01 : 0.04;
        EXPECT_NEAR(dot.table.dots.x[0], u, max_px) << sigma_px << ' ' << reach_px;
        EXPECT_NEAR(dot.table.dots.y[0], v, max_px) << sigma_px << ' ' << reach_px;
    });
}

TEST(KernelsWindows, CentresFarFromTheirDotsStay) {
    for (const Kernels* kernels : forms()) {
        OneDot dot(40.3, 41.2, 1, 0.9);
        const float x = dot.table.dots.x[0];
        kernels->refine_centres(dot.view, dot.cells, 3.3F, dot.table.dots);
        EXPECT_EQ(dot.table.dots.x[0], x);
        OneDot none(40.3, 41.2, 1, 0.1);
        none.table.dots.x[0] = kNoDot_px;
        kernels->refine_centres(none.view, none.cells, 3.3F, none.table.dots);
        EXPECT_EQ(none.table.dots.x[0], kNoDot_px);
    }
}

TEST(KernelsWindows, PredictedCentresAreFoundHoweverFarDotsAreOff) {
    repeat_with_each_form(100, [](const Kernels& kernels, Rng& rng) {
        // One dot is listed eight times, with different predicted centres. Four predictions are
        // close to the dot because the kernel uses them to estimate how the moment depends on the
        // offset.
        const double u = rng.uniform(20, OneDot::kSide_px - 21);
        const double v = rng.uniform(20, OneDot::kSide_px - 21);
        OneDot dot(u, v, rng.uniform(0.9, 1.5), 0);
        MeasuredDots& dots = dot.table.dots;
        dots.count = 8;
        std::vector<double> off;
        for (std::size_t k = 0; k < 8; ++k) {
            off.push_back(k < 4 ? rng.uniform(-0.1, 0.1) : rng.uniform(-0.6, 0.6));
            dots.paper[k] = static_cast<int>(OneDot::kPaper);
            dots.x[k] = static_cast<float>(u + off[k]);
            dots.y[k] = static_cast<float>(v - off[k]);
        }
        dots.x[5] = kNoDot_px;
        const DotOffsets found = kernels.find_centres(dot.view, dot.cells, 1, 0, dots);
        double sum_u = 0;
        double squared = 0;
        double along = 0;
        double across = 0;
        for (std::size_t k = 0; k < 8; ++k) {
            if (k == 5) continue;
            // The tolerance increases with the offset because a large dot with a large offset
            // extends beyond the window.
            const double max_px = 0.02 + 0.2 * std::pow(std::abs(off[k]), 3);
            EXPECT_NEAR(dots.x[k], u, max_px) << off[k];
            EXPECT_NEAR(dots.y[k], v, max_px) << off[k];
            const double moved_u = static_cast<double>(dots.x[k]) - (u + off[k]);
            const double moved_v = static_cast<double>(dots.y[k]) - (v - off[k]);
            sum_u += moved_u;
            squared += moved_u * moved_u + moved_v * moved_v;
            along += moved_u * (u + off[k]) + moved_v * (v - off[k]);
            across += moved_v * (u + off[k]) - moved_u * (v - off[k]);
        }
        EXPECT_EQ(dots.x[5], kNoDot_px);
        EXPECT_EQ(found.points, 7);
        EXPECT_NEAR(found.off_u, sum_u, 1e-3);
        EXPECT_NEAR(found.squared, squared, 1e-3);
        EXPECT_NEAR(found.along, along, 1e-2);
        EXPECT_NEAR(found.across, across, 1e-2);
    });
}

/// Sixteen Gaussian dots in a square grid, on paper with the grey level level(x, y). Each
/// prediction has an error of up to a tenth of a pixel per axis.
struct LitDots {
    static constexpr int kSide_px = 80;
    static constexpr std::size_t kDots = 16;
    std::vector<std::uint8_t> pixels;
    std::vector<double> us, vs;
    ImageView view{nullptr, kSide_px, kSide_px, kSide_px};
    CellsInView cells;
    DotTable table{kDots};

    template <typename Level>
    LitDots(Rng& rng, Level level) {
        MeasuredDots& dots = table.dots;
        dots.count = static_cast<int>(kDots);
        for (std::size_t k = 0; k < kDots; ++k) {
            us.push_back(16 * static_cast<double>(k % 4) + rng.uniform(14, 18));
            vs.push_back(16 * static_cast<double>(k / 4) + rng.uniform(14, 18));
            const double off_u = us[k] + rng.uniform(-0.1, 0.1);
            const double off_v = vs[k] + rng.uniform(-0.1, 0.1);
            dots.window_u[k] = static_cast<int>(us[k]);
            dots.window_v[k] = static_cast<int>(vs[k]);
            dots.mass[k] = 10000;
            dots.sum_u[k] = static_cast<int>(std::lround(10000 * (off_u - dots.window_u[k])));
            dots.sum_v[k] = static_cast<int>(std::lround(10000 * (off_v - dots.window_v[k])));
            dots.paper[k] = static_cast<int>(std::lround(level(us[k], vs[k])));
            dots.x[k] = static_cast<float>(off_u);
            dots.y[k] = static_cast<float>(off_v);
        }
        for (int y = 0; y < kSide_px; ++y) {
            for (int x = 0; x < kSide_px; ++x) {
                double dark = 0;
                for (std::size_t k = 0; k < kDots; ++k)
                    dark +=
                        0.6 * level(us[k], vs[k]) * std::exp(-(sq(x - us[k]) + sq(y - vs[k])) / 2);
                pixels.push_back(static_cast<std::uint8_t>(std::lround(level(x, y) - dark)));
            }
        }
        view.pixels = pixels.data();
    }
    static double sq(double value) { return value * value; }
    std::pair<double, double> mean_error() const {
        double x = 0;
        double y = 0;
        for (std::size_t k = 0; k < kDots; ++k) {
            x += (static_cast<double>(table.dots.x[k]) - us[k]) / kDots;
            y += (static_cast<double>(table.dots.y[k]) - vs[k]) / kDots;
        }
        return {x, y};
    }
};

template <typename Level>
void expect_no_common_error(const Kernels& kernels, Rng& rng, float reach_px, Level level) {
    LitDots again(rng, level);
    kernels.refine_centres(again.view, again.cells, reach_px, again.table.dots);
    LitDots predicted(rng, level);
    kernels.find_centres(predicted.view, predicted.cells, 1, 0, predicted.table.dots);
    for (const auto& [x, y] : {again.mean_error(), predicted.mean_error()}) {
        EXPECT_NEAR(x, 0, 0.006) << reach_px;
        EXPECT_NEAR(y, 0, 0.006) << reach_px;
    }
}

TEST(KernelsWindows, LightThatFallsOffMovesNoCentres) {
    repeat_with_each_form(60, [](const Kernels& kernels, Rng& rng) {
        const double per_u = rng.uniform(-1.2, 1.2);
        const double per_v = rng.uniform(-1.2, 1.2);
        expect_no_common_error(kernels, rng, static_cast<float>(rng.uniform(3.3, 6)),
                               [&](double u, double v) {
                                   return 150 + per_u * (u - LitDots::kSide_px / 2) +
                                          per_v * (v - LitDots::kSide_px / 2);
                               });
    });
}

TEST(KernelsWindows, AShadowThatEndsMovesNoCentresBesideItsEdge) {
    repeat_with_each_form(20, [](const Kernels& kernels, Rng& rng) {
        // The edge between dark and light paper is between the second and the third column of dots,
        // outside all centroid windows.
        expect_no_common_error(kernels, rng, 3.3F,
                               [&](double u, double /*v*/) { return u < 40 ? 90 : 200; });
    });
}

TEST(KernelsWindows, PredictedDotsAreReadByTheDarkestPlace) {
    repeat_with_each_form(40, [](const Kernels& kernels, Rng& rng) {
        // The grid is upright, and the dot is below the intersection at (40, 40). This displacement
        // is symbol 3.
        const OneDot dot(40, 41.8, 1, 0);
        CellsInView view = dot.cells;
        view.plane = {0, 0, 1 / 11.0F, 0, 0, 1 / 11.0F, 0, 0, 0};
        view.displacement = 1.8F / 11;
        const float by[4][2] = {{0, -1.8F}, {-1.8F, 0}, {1.8F, 0}, {0, 1.8F}};
        const int expected = whole(rng, 0, 3);
        DotTable table(8);
        MeasuredDots& dots = table.dots;
        dots.count = 1;
        dots.column[0] = static_cast<float>(whole(rng, -32, 31));
        dots.row[0] = static_cast<float>(whole(rng, -32, 31));
        dots.bits[0] = expected;
        dots.x[0] = 40 + by[expected][0];
        dots.y[0] = 40 + by[expected][1];
        BitLines columns;
        BitLines rows;
        const BitsRead read = kernels.read_levels(dot.view, view, 100, dots, &columns, &rows);
        EXPECT_EQ(read.seen, 1);
        EXPECT_EQ(read.read, 1);
        EXPECT_EQ(read.wrong_x, (expected & 1) == 0 ? 1 : 0);
        EXPECT_EQ(read.wrong_y, expected < 2 ? 1 : 0);
        EXPECT_EQ(read.right, expected == 3 ? 1 : 0);
        EXPECT_EQ(dots.x[0] < kNoDot_px, expected == 3);
        const auto i = static_cast<std::size_t>(dots.column[0] + 32);
        const auto j = static_cast<std::size_t>(dots.row[0] + 32);
        EXPECT_EQ(columns.valid[i], std::uint64_t{1} << j);
        EXPECT_EQ(columns.bits[i], columns.valid[i]);
        EXPECT_EQ(rows.valid[j], std::uint64_t{1} << i);
        EXPECT_EQ(rows.bits[j], rows.valid[j]);
        // No dot is found if there is no ink near the prediction.
        dots.x[0] = 20;
        EXPECT_EQ(kernels.read_levels(dot.view, view, 100, dots, nullptr, nullptr).seen, 0);
    });
}

}  // namespace
}  // namespace dotpose::core_test::kernels_windows_test
