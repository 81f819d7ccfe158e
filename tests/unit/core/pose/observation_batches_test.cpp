// Tests that observation batches contain the same dots, in the same order, as `Observations`.
#include "core/pose/observation_batches.hpp"

#include <gtest/gtest.h>

#include "poses.hpp"

namespace dotpose::core_test::observation_batches_test {
namespace {

using namespace core;

constexpr std::uint64_t kSeed = 65;

struct Counted {
    int dots = 0;
    std::int64_t sum = 0;  ///< checksum that depends on the order of the dots

    void add(std::int64_t x, std::int64_t y, std::int64_t step_x, std::int64_t step_y,
             std::int64_t side) {
        sum += ++dots * (3 * x + 5 * y + 7 * step_x + 11 * step_y + 13 * side);
    }
    bool operator==(const Counted&) const = default;
};

TEST(ObservationBatches, ShowsAllDotsInOrder) {
    Rng rng(kSeed);
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE(testing::Message() << "view " << i << ", seed " << kSeed);
        // Half of the views have fewer dots than a batch can hold, and half have more.
        View view = random_view(rng);
        view.spacing_px = i % 2 == 0 ? 12 : 6;
        const Reading reading(view, QuarterTurn{i % 4});
        const Nominal nominal(reading.grid(), reading.view.code, reading.truth());
        const Observations observations(reading.dots, reading.grid(), nominal);
        const FixedVec centre_q8 = fixed(view.centre_px(), 8);
        Counted expected;
        int reach_q8 = 0;
        observations.visit([&](const Observation& o) {
            const FixedVec p{o.image_point_q8.x - centre_q8.x, o.image_point_q8.y - centre_q8.y};
            reach_q8 = std::max(reach_q8, larger_component(p));
            expected.add(p.x, p.y, o.pattern_step.x, o.pattern_step.y,
                         2 * dx(o.symbol) + dy(o.symbol));
        });
        const ObservationBatches batches(observations, centre_q8);
        Counted shown;
        batches.visit([&](const ObservationBatch& batch) {
            for (std::size_t k = 0; k < batch.count; ++k) {
                shown.add(batch.x_q8[k], batch.y_q8[k], batch.step_x_q16[k] / 65536,
                          batch.step_y_q16[k] / 65536, 2 * batch.dx[k] + batch.dy[k]);
                EXPECT_EQ(batch.noise[k], 0);
            }
        });
        EXPECT_EQ(shown, expected);
        EXPECT_EQ(batches.reach_px(), reach_q8 / 256 + 1);
        EXPECT_EQ(expected.dots > 256, i % 2 == 1);
        EXPECT_GE(batches.sample().count, std::min<std::size_t>(reading.dots.size(), 128U));
    }
}

TEST(ObservationBatches, FillsBatchesUpWithDotsFarAway) {
    ObservationBatch batch;
    for (int n = 0; n < 5; ++n)
        batch.add({n, n}, {n, -n}, Symbol::up, 1);
    batch.fill_up();
    EXPECT_EQ(batch.count, 5U);
    for (std::size_t k = 5; k < 8; ++k) {
        EXPECT_GT(batch.step_x_q16[k], 1000 * 65536);
        EXPECT_EQ(batch.x_q8[k], 0);
    }
}

}  // namespace
}  // namespace dotpose::core_test::observation_batches_test
