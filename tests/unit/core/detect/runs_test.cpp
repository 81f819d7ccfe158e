// Tests runs in random rows against a simple pixel-by-pixel search.
#include "core/detect/runs.hpp"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "../canvas.hpp"
#include "dotpose/locate.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core_test::runs_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 61;

/// A row of an image, with random thresholds that vary from tile to tile.
struct Row {
    LargeWorkspace workspace;
    AdaptiveThreshold& threshold = workspace.threshold;

    void draw(Rng& rng, int width_px) {
        std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width_px));
        // Fraction of dark pixels.
        const double dark_fraction = rng.uniform(0, 1);
        begin_threshold(width_px, kMinFrameSide_px, threshold);
        for (int u = 0; u < whole_width(threshold); u += kTileWidth_px) {
            const std::uint32_t half_low = rng.below(6) == 0 ? 0 : rng.below(128);
            const std::uint32_t high = rng.below(2 * half_low + 1);
            for (int k = u; k < u + kTileWidth_px; ++k) {
                threshold.half_low_levels[static_cast<std::size_t>(k)] =
                    static_cast<std::uint8_t>(half_low);
                threshold.high_levels[static_cast<std::size_t>(k)] =
                    static_cast<std::uint8_t>(high);
            }
            // If true, every grey level equals one of the two thresholds or is one below it.
            const bool is_close = rng.below(2) == 0;
            for (int k = u; k < std::min(u + kTileWidth_px, width_px); ++k) {
                const bool is_dark = rng.uniform(0, 1) < dark_fraction;
                int level = static_cast<int>(is_dark ? rng.below(2 * half_low + 1)
                                                     : 255 - rng.below(256 - 2 * half_low));
                if (is_close) {
                    level = static_cast<int>(rng.below(2) == 0 ? 2 * half_low : high) - is_dark;
                }
                pixels[static_cast<std::size_t>(k)] =
                    static_cast<std::uint8_t>(std::clamp(level, 0, 255));
            }
        }
        take_row(pixels.data(), threshold);
    }
};

std::vector<dotpose::core::Run> expected_runs(const AdaptiveThreshold& threshold) {
    const std::uint8_t* row = kept_row(threshold, 0);
    std::vector<dotpose::core::Run> runs;
    bool is_dark = false;
    for (int u = 0; u < whole_width(threshold); ++u) {
        const Levels level = levels_at(threshold, u);
        const int weight = level.low - row[u];
        const bool was_dark = std::exchange(is_dark, weight > 0);
        if (!is_dark) continue;
        if (!was_dark) runs.push_back({.begin = static_cast<std::uint16_t>(u)});
        dotpose::core::Run& run = runs.back();
        run.end = static_cast<std::uint16_t>(u + 1);
        run.mass += static_cast<std::uint32_t>(weight);
        run.sum_x += static_cast<std::uint32_t>(weight * u);
        run.passes_high |= row[u] < level.high;
    }
    return runs;
}

void expect_runs(std::span<const dotpose::core::Run> found,
                 std::span<const dotpose::core::Run> expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "run " << i << " from " << expected[i].begin);
        ASSERT_EQ(found[i].begin, expected[i].begin);
        ASSERT_EQ(found[i].end, expected[i].end);
        ASSERT_EQ(found[i].mass, expected[i].mass);
        ASSERT_EQ(found[i].sum_x, expected[i].sum_x);
        ASSERT_EQ(found[i].passes_high, expected[i].passes_high);
    }
}

TEST(Runs, AreTheStretchesOfDarkPixels) {
    Rng rng(kSeed);
    Row row;
    std::array<dotpose::core::Run, 4096> storage;
    std::size_t most = 0;
    for (int i = 0; i < 3000; ++i) {
        const int width = 64 + static_cast<int>(rng.below(i % 10 == 0 ? 4033 : 200));
        SCOPED_TRACE(testing::Message() << "row " << i << ", seed " << kSeed << ", " << width);
        row.draw(rng, width);
        const auto expected = expected_runs(row.threshold);
        most = std::max(most, expected.size());
        const auto count = static_cast<std::size_t>(find_runs(0, row.threshold, storage));
        expect_runs(std::span(storage).first(count), expected);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(most, 500u);
}

TEST(Runs, AreTheFirstOnesWhereThereIsNoRoomForAll) {
    Rng rng(kSeed + 1);
    Row row;
    std::array<dotpose::core::Run, 256> storage;
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(testing::Message() << "row " << i << ", seed " << kSeed + 1);
        row.draw(rng, 64 + static_cast<int>(rng.below(200)));
        const auto expected = expected_runs(row.threshold);
        for (const std::size_t room : {std::size_t{0}, std::size_t{1}, expected.size() / 2}) {
            const auto runs = std::span(storage).first(std::min(room, expected.size()));
            const auto count = static_cast<std::size_t>(find_runs(0, row.threshold, runs));
            expect_runs(runs.first(count), std::span(expected).first(runs.size()));
            if (testing::Test::HasFatalFailure()) return;
        }
    }
}

}  // namespace
}  // namespace dotpose::core_test::runs_test
