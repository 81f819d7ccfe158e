// Tests the orientation and position decoded from simulated dots, for all orientations of the grid.
#include "core/decode/position.hpp"

#include <gtest/gtest.h>

#include "../reading.hpp"
#include "core/decode/correlation.hpp"
#include "core/decode/orientation.hpp"

namespace dotpose::core_test::position_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 29;
using Decode = Status (*)(const Grid&, CodeVariant, std::span<ScoredLine>, Decoding&);

/// Decodes a view, and expects the true position and orientation.
void expect_truth(Decode decode, const Reading& reading) {
    std::array<ScoredLine, 2 * kMaxLines> storage;
    Decoding found = reading.decoding;
    ASSERT_EQ(decode(reading.grid(), reading.view.code, storage, found), Status::ok);
    const Decoding truth = reading.truth();
    EXPECT_EQ(found.pattern_from_grid.quarters, truth.pattern_from_grid.quarters);
    EXPECT_EQ(found.place.cell, truth.place.cell);
    EXPECT_EQ(found.place.section, truth.place.section);
}

/// Runs a check on views at random positions, for all code variants and quarter turns.
template <typename Check>
void for_many_views(int count, Check check) {
    Rng rng(kSeed);
    for (int i = 0; i < count; ++i) {
        View view = random_view(rng);
        view.code = kCodeVariants[static_cast<std::size_t>(i % 3)];
        for (int quarters = 0; quarters < 4; ++quarters) {
            SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed << ", cell "
                                            << view.place.cell.x << ", " << view.place.cell.y
                                            << ", turn " << quarters << ", code " << i % 3);
            check(view, QuarterTurn{quarters});
            if (testing::Test::HasFailure()) return;
        }
    }
}

TEST(Position, IsReadAtAllFourTurns) {
    for_many_views(150, [](const View& view, QuarterTurn turn) {
        const Reading reading(view, turn);
        ASSERT_EQ(reading.status, Status::ok);
        expect_truth(decode_window, reading);
        expect_truth(decode_all, reading);
        const Orientation of_window = rank_turns(reading.grid(), reading.decoding.window);
        EXPECT_EQ(of_window.turns[0].quarters, turn.quarters);
        const Orientation of_all = rank_turns(reading.grid(), reading.decoding.region);
        EXPECT_EQ(of_all.turns[0].quarters, turn.quarters);
        EXPECT_FALSE(is_mirrored(reading.grid(), reading.decoding.region, of_all.agreement));
    });
}

TEST(Position, IsReadAcrossBothEndsOfTheCode) {
    constexpr std::uint32_t kLast = kPositionsPerAxis - 1;
    for (const Cell cell : {Cell{0, 0}, Cell{kLast, 0}, Cell{0, kLast}, Cell{kLast, kLast},
                            Cell{3, kLast - 5}, Cell{kLast - 2, 77}, Cell{100000, 4}}) {
        Rng rng(kSeed);
        for (int i = 0; i < 12; ++i) {
            View view = random_view(rng);
            view.place.cell = cell;
            view.code = kCodeVariants[static_cast<std::size_t>(i % 3)];
            SCOPED_TRACE(testing::Message() << "cell " << cell.x << ", " << cell.y << ", view " << i
                                            << ", seed " << kSeed);
            const Reading reading(view, QuarterTurn{i % 4});
            expect_truth(decode_window, reading);
            expect_truth(decode_all, reading);
        }
    }
}

TEST(Position, IsReadFromManyDotsThoughSomeAreWrong) {
    // 8 % of the dots have a random symbol, which is wrong in three out of four cases. Another 6 %
    // of the dots are missing.
    Rng rng(kSeed);
    for_many_views(60, [&](const View& view, QuarterTurn turn) {
        std::vector<DetectedDot> dots;
        const Mesh mesh = view.mesh();
        for (const PlacedDot& d : pattern_dots(view)) {
            const double fate = rng.uniform();
            if (fate < 0.06) continue;
            const Vec2 elsewhere = random_displacement(rng);
            const Vec2 wrong = mesh.at(d.cell.x + elsewhere.x, d.cell.y + elsewhere.y);
            dots.push_back(dot_at(fate < 0.14 ? wrong : d.centre_px));
        }
        expect_truth(decode_all, Reading(view, turn, dots));
    });
}

TEST(Position, TheMirrorImageIsKnown) {
    for_many_views(60, [](const View& view, QuarterTurn turn) {
        std::vector<DetectedDot> dots;
        for (const PlacedDot& d : pattern_dots(view)) {
            dots.push_back(dot_at({view.image_px.x - 1 - d.centre_px.x, d.centre_px.y}));
        }
        // The mirrored grid has the same spacing and the negated angle.
        View behind = view;
        behind.theta_rad = -view.theta_rad;
        Mesh mesh = view.mesh();
        mesh.origin.x = view.image_px.x - 1 - mesh.origin.x;
        behind.at_centre = {};
        behind.at_centre = {-behind.mesh().inverse(mesh.origin).x,
                            -behind.mesh().inverse(mesh.origin).y};
        const Reading reading(behind, turn, dots);
        ASSERT_EQ(reading.status, Status::ok);
        const Orientation orientation = rank_turns(reading.grid(), reading.decoding.region);
        EXPECT_TRUE(is_mirrored(reading.grid(), reading.decoding.region, orientation.agreement));
    });
}

TEST(Position, TooFewLinesAreRefused) {
    Rng rng(kSeed);
    const Reading reading(random_view(rng), {});
    std::array<ScoredLine, 2 * kMaxLines> storage;
    Decoding narrow = reading.decoding;
    narrow.region.columns = narrow.window.columns = 5;
    EXPECT_EQ(decode_all(reading.grid(), CodeVariant::anoto, storage, narrow),
              Status::grid_too_small);
    EXPECT_EQ(decode_window(reading.grid(), CodeVariant::anoto, storage, narrow),
              Status::grid_too_small);
    Decoding flat = reading.decoding;
    flat.region.rows = flat.window.rows = 5;
    EXPECT_EQ(decode_all(reading.grid(), CodeVariant::anoto, storage, flat),
              Status::grid_too_small);
    EXPECT_EQ(decode_window(reading.grid(), CodeVariant::anoto, storage, flat),
              Status::grid_too_small);
}

TEST(Position, TheWindowNeedsItsDots) {
    Rng rng(kSeed);
    const View view = random_view(rng);
    std::vector<DetectedDot> dots;
    for (const PlacedDot& d : pattern_dots(view)) {
        if (rng.below(5) == 0) dots.push_back(dot_at(d.centre_px));
    }
    const Reading sparse(view, {}, dots);
    std::array<ScoredLine, 2 * kMaxLines> storage;
    Decoding decoding = sparse.decoding;
    EXPECT_EQ(decode_window(sparse.grid(), CodeVariant::anoto, storage, decoding),
              Status::grid_too_small);
}

}  // namespace
}  // namespace dotpose::core_test::position_test
