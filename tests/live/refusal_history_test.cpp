#include "refusal_history.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dotpose::cli {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(RefusalHistory, CountsFramesByStatusInEachSecond) {
    RefusalHistory history;
    history.add(100'000, Status::ok);
    history.add(200'000, Status::no_grid);
    history.add(999'999, Status::ok);
    history.add(1'000'000, Status::no_grid);
    history.add(5'500'000, Status::no_contrast);
    ASSERT_EQ(history.seconds().size(), 3U);
    EXPECT_THAT(history.seconds()[0].frames,
                testing::UnorderedElementsAre(Pair(Status::ok, 2), Pair(Status::no_grid, 1)));
    EXPECT_THAT(history.seconds()[1].frames, ElementsAre(Pair(Status::no_grid, 1)));
    EXPECT_EQ(history.seconds()[2].second, 5);
}

TEST(RefusalHistory, ForgetsOldSeconds) {
    RefusalHistory history;
    for (std::int64_t second = 0; second < 10'000; ++second)
        history.add(second * 1'000'000, Status::ok);
    EXPECT_EQ(history.seconds().size(), RefusalHistory::kSeconds);
    EXPECT_EQ(history.seconds().front().second, 10'000 - RefusalHistory::kSeconds);
}

TEST(RefusalHistory, CountsFramesAfterTheClockWasSetBack) {
    RefusalHistory history;
    history.add(9'000'000, Status::ok);
    history.add(2'000'000, Status::no_grid);
    ASSERT_EQ(history.seconds().size(), 1U);
    EXPECT_EQ(history.seconds()[0].frames.at(Status::no_grid), 1);
}

}  // namespace
}  // namespace dotpose::cli
