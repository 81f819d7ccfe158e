// Tests kernels against simple reference computations. `kernels_test.cpp` tests that all forms of a
// kernel agree.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/detect/patch.hpp"
#include "core/kernels/kernels.hpp"
#include "random_inputs.hpp"

namespace dotpose::core_test::kernels_plain_test {
namespace {

using namespace core;

/// Maps an image point to the pattern in double precision. The plane has no perspective.
std::array<double, 2> exactly(const FloatPlane& plane, double x, double y) {
    const auto along = [&](float at, float du, float dv) {
        return static_cast<double>(at) + static_cast<double>(du) * x + static_cast<double>(dv) * y;
    };
    return {along(plane.at_x, plane.du_x, plane.dv_x), along(plane.at_y, plane.du_y, plane.dv_y)};
}

template <std::size_t kCount>
void add(const std::array<double, kCount>& numbers, std::array<double, kCount>& sums) {
    for (std::size_t k = 0; k < kCount; ++k)
        sums[k] += numbers[k];
}

int mean(int a, int b) {
    return (a + b + 1) / 2;
}

TEST(KernelsPlain, PatchIsSmoothedByMeansOfMeans) {
    repeat_with_each_form(10, [](const Kernels& kernels, Rng& rng) {
        const Picture picture(whole(rng, 48, 250), whole(rng, 48, 190), 3, rng);
        auto patch = std::make_unique<Patch>();
        ASSERT_TRUE(place_patch(picture.view, picture.view.width_px / 2, picture.view.height_px / 2,
                                224, 160, 1, *patch));
        kernels.fill_patch(picture.view, *patch);
        kernels.smooth_patch(*patch);
        const auto along = [&](int u, int v) {
            const auto level = [&](int at) {
                return picture.at(patch->left_px + at, patch->top_px + v);
            };
            return mean(mean(level(u - 1), level(u + 1)), level(u));
        };
        int brightest = 0;
        int darkest = 255;
        for (int v = 1; v < patch->height_px - 1; ++v) {
            for (int u = 1; u < patch->width_px - 1; ++u) {
                const int expected = mean(mean(along(u, v - 1), along(u, v + 1)), along(u, v));
                ASSERT_EQ(patch->row(patch->smoothed, v)[u], expected) << u << ' ' << v;
                if (u / 16 == 1 && v / 8 == 1) {
                    brightest = std::max(brightest, expected);
                    darkest = std::min(darkest, expected);
                }
            }
        }
        EXPECT_EQ(patch->brightest[Patch::kTilesPerRow + 1], brightest);
        EXPECT_EQ(patch->darkness[Patch::kTilesPerRow + 1], 255 - darkest);
    });
}

TEST(KernelsPlain, MinimaAreDarkerThanTheirNeighbours) {
    repeat_with_each_form(10, [](const Kernels& kernels, Rng& rng) {
        Picture picture(whole(rng, 100, 250), whole(rng, 80, 190), 0, rng);
        picture.draw_dots(rng.uniform(8, 14), rng);
        auto patch = std::make_unique<Patch>();
        ASSERT_TRUE(place_patch(picture.view, picture.view.width_px / 2, picture.view.height_px / 2,
                                224, 160, 1, *patch));
        kernels.fill_patch(picture.view, *patch);
        kernels.smooth_patch(*patch);
        patch->thresholds.fill(160);
        kernels.find_minima(*patch);
        const auto level = [&](int u, int v) { return int{patch->row(patch->smoothed, v)[u]}; };
        std::vector<std::pair<double, double>> found;
        for (std::size_t k = 0; k < static_cast<std::size_t>(patch->dots.count); ++k)
            found.emplace_back(double{patch->dots.x[k]}, double{patch->dots.y[k]});
        std::size_t count = 0;
        for (int v = 2; v < patch->height_px - 2; ++v) {
            for (int u = 2; u < patch->width_px - 2; ++u) {
                const int here = level(u, v);
                const int before = std::min(
                    {level(u - 1, v - 1), level(u, v - 1), level(u + 1, v - 1), level(u - 1, v)});
                const int after = std::min(
                    {level(u + 1, v), level(u - 1, v + 1), level(u, v + 1), level(u + 1, v + 1)});
                if (here > 160 || here >= before || here > after) continue;
                const auto off = [&](int less, int more) {
                    return static_cast<double>(less - more) / (2 * (less + more - 2 * here));
                };
                ++count;
                const double x =
                    u + off(level(u - 1, v), level(u + 1, v)) - (patch->width_px - 1) / 2.0;
                const double y =
                    v + off(level(u, v - 1), level(u, v + 1)) - (patch->height_px - 1) / 2.0;
                EXPECT_EQ(std::count_if(found.begin(), found.end(),
                                        [&](const auto& dot) {
                                            return std::abs(dot.first - x) < 1e-4 &&
                                                   std::abs(dot.second - y) < 1e-4;
                                        }),
                          1)
                    << u << ", " << v;
            }
        }
        EXPECT_EQ(found.size(), count);
        EXPECT_GT(count, 20U);
    });
}

TEST(KernelsPlain, LinesAreScoredAgainstTheMainSequence) {
    repeat_with_each_form(100, [](const Kernels& kernels, Rng& rng) {
        const std::uint64_t bits = rng.bits();
        const std::uint64_t valid = rng.bits() | (rng.below(2) == 0 ? rng.bits() : 0);
        ScoredLine line;
        kernels.score_line(bits, valid, line);
        std::vector<int> scores;
        for (std::size_t offset = 0; offset < 63; ++offset) {
            int score = 0;
            for (std::size_t cell = 0; cell < 64; ++cell) {
                if ((valid >> cell & 1) == 0) continue;
                score += code::kMainRepeated[offset + cell] == (bits >> cell & 1) ? 127 : -127;
            }
            ASSERT_EQ(line.scores[offset], score) << offset;
            scores.push_back(score);
        }
        std::sort(scores.rbegin(), scores.rend());
        EXPECT_EQ(line.best.score, scores[0]);
        EXPECT_EQ(line.best.margin, scores[0] - scores[1]);
    });
}

TEST(KernelsPlain, BitsStandInTheirLines) {
    repeat_with_each_form(40, [](const Kernels& kernels, Rng& rng) {
        const FloatPlane plane = random_plane(rng, 11, 0, 0);
        const DotTable table = random_measures(plane, whole(rng, 0, 6000), 0.167F, rng);
        BitLines columns;
        BitLines rows;
        const BitsRead read = kernels.read_bits(table.dots, plane, 0.167F, &columns, &rows);
        int seen = 0;
        int in_block = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(table.dots.count); ++k) {
            if (table.dots.x[k] >= kNoDot_px) continue;
            ++seen;
            const int column = static_cast<int>(table.dots.column[k]) + 32;
            const int row = static_cast<int>(table.dots.row[k]) + 32;
            if (column < 0 || row < 0 || column > 63 || row > 63) continue;
            const auto i = static_cast<std::size_t>(column);
            const auto j = static_cast<std::size_t>(row);
            const bool is_read = (columns.valid[i] >> row & 1) != 0;
            ASSERT_EQ((rows.valid[j] >> column & 1) != 0, is_read);
            if (!is_read) continue;
            ++in_block;
            const auto x = static_cast<double>(table.dots.x[k]);
            const auto y = static_cast<double>(table.dots.y[k]);
            const auto [at_x, at_y] = exactly(plane, x, y);
            const double off_x = at_x - static_cast<double>(table.dots.column[k]);
            const double off_y = at_y - static_cast<double>(table.dots.row[k]);
            ASSERT_EQ(columns.bits[i] >> row & 1, off_y > off_x ? 1U : 0U);
            ASSERT_EQ(rows.bits[j] >> column & 1, off_y > -off_x ? 1U : 0U);
        }
        int marked = 0;
        for (const std::uint64_t valid : columns.valid)
            marked += std::popcount(valid);
        EXPECT_EQ(marked, in_block);
        EXPECT_EQ(read.seen, seen);
        EXPECT_GE(read.read, in_block);
    });
}

TEST(KernelsPlain, FitIsSummedOverDotsNearTheirPlaces) {
    repeat_with_each_form(30, [](const Kernels& kernels, Rng& rng) {
        const FloatPlane plane = random_plane(rng, 11, 0, 0);
        const DotTable table = random_measures(plane, whole(rng, 20, 300), 0.167F, rng);
        const double limit = 0.012;
        constexpr double kScale = 9;
        double points = 0;
        double squares = 0;
        double projected = 0;
        double farthest = 0;
        std::array<double, 16> places{};
        std::array<double, 9> residuals{};
        int seen = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(table.dots.count); ++k) {
            const auto x = static_cast<double>(table.dots.x[k]);
            const auto y = static_cast<double>(table.dots.y[k]);
            if (table.dots.x[k] >= kNoDot_px) continue;
            ++seen;
            const int x_bit = table.dots.bits[k] & 1;
            const int y_bit = table.dots.bits[k] >> 1;
            const auto [at_x, at_y] = exactly(plane, x, y);
            const double left_x =
                static_cast<double>(table.dots.column[k]) + 0.167 * (y_bit - x_bit) - at_x;
            const double left_y =
                static_cast<double>(table.dots.row[k]) + 0.167 * (x_bit + y_bit - 1) - at_y;
            if (left_x * left_x + left_y * left_y > limit) continue;
            ++points;
            squares += left_x * left_x + left_y * left_y;
            farthest = std::max(farthest, left_x * left_x + left_y * left_y);
            projected += (0.167 * (y_bit - x_bit) - left_x) * (y_bit - x_bit) +
                         (0.167 * (x_bit + y_bit - 1) - left_y) * (x_bit + y_bit - 1);
            const double u = (at_x - static_cast<double>(plane.at_x)) / kScale;
            const double v = (at_y - static_cast<double>(plane.at_y)) / kScale;
            const double q = u * u + v * v;
            add({1, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v,
                 q * u * u, q * u * v, q * v * v, q * q * u, q * q * v, q * q * q},
                places);
            const double a = left_x * u + left_y * v;
            add({left_x, left_y, left_x * u, left_y * v, left_y * u, left_x * v, a * u, a * v,
                 a * q},
                residuals);
        }
        const FitSums sums =
            kernels.sum_fit(table.dots, plane, 0.167F, kScale, static_cast<float>(limit));
        EXPECT_EQ(sums.points, points);
        EXPECT_EQ(sums.outliers, seen - points);
        EXPECT_NEAR(sums.squares, squares, 1e-4);
        EXPECT_NEAR(sums.farthest, farthest, 1e-6);
        EXPECT_NEAR(sums.projected, projected, 1e-3);
        for (std::size_t k = 0; k < places.size(); ++k)
            EXPECT_NEAR(sums.places[k], places[k], 1e-3) << k;
        for (std::size_t k = 0; k < residuals.size(); ++k)
            EXPECT_NEAR(sums.residuals[k], residuals[k], 1e-3) << k;
    });
}

}  // namespace
}  // namespace dotpose::core_test::kernels_plain_test
