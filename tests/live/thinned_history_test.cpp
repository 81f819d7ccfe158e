#include "thinned_history.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dotpose::cli {
namespace {

using nlohmann::json;
using store::Motion;

constexpr std::int64_t kBegin_us = 1'795'000'000'000'000;

store::State state_at(std::int64_t time_ms, double x_mm, Motion motion = Motion::moving,
                      const std::string& map = "hall") {
    store::State state;
    state.robot = std::make_shared<std::string>("anna");
    state.place = std::make_shared<store::Place>(store::Place{map, ""});
    state.time_us = kBegin_us + 1000 * time_ms;
    state.motion = motion;
    state.x_nm = std::llround(x_mm * 1e6);
    state.vx_um_s = motion == Motion::moving ? 30'000 : 0;
    state.vy_um_s = motion == Motion::moving ? 40'000 : 0;
    return state;
}

TEST(ThinnedHistory, AFewStatesAreAllKept) {
    ThinnedHistory history;
    EXPECT_EQ(history.value()["states"], 0);
    history.add(state_at(0, 1));
    history.add(state_at(500, 2.125, Motion::still));
    history.add(state_at(1000, 0, Motion::lost));
    history.add(state_at(1500, 3, Motion::moving, "cellar"));
    const json value = history.value();
    EXPECT_EQ(value["first_us"], kBegin_us);
    EXPECT_EQ(value["last_us"], kBegin_us + 1'500'000);
    EXPECT_EQ(value["times_ms"], json({0, 500, 1000, 1500}));
    EXPECT_EQ(value["x_mm"], json({1.0, 2.13, nullptr, 3.0}));
    EXPECT_EQ(value["maps"], json({"hall", "cellar"}));
    EXPECT_EQ(value["map_of"], json({0, 0, nullptr, 1}));
    EXPECT_EQ(value["speeds_mm_s"], json({50.0, 0.0, 0.0, 50.0}));
    EXPECT_EQ(value["motions"], json({0, 1, 2, 0}));
    EXPECT_EQ(value["counts"], json({{"moving", 2}, {"still", 1}, {"lost", 1}}));
    EXPECT_EQ(value["max_speed_mm_s"], 50);
}

TEST(ThinnedHistory, ManyStatesAreThinnedByTime) {
    ThinnedHistory history;
    constexpr int kStates = 86'400;  // 2.4 h at 10 Hz
    for (int i = 0; i < kStates; ++i)
        history.add(state_at(100 * i, i, i == 50'001 ? Motion::lost : Motion::still));
    const json value = history.value();
    EXPECT_EQ(value["states"], kStates);
    EXPECT_EQ(value["span_ms"], 6'400);
    const json& times_ms = value["times_ms"];
    ASSERT_EQ(times_ms.size(), 1350U);  // 8,640 s / 6.4 s
    for (std::size_t i = 0; i < times_ms.size(); ++i) {
        ASSERT_EQ(times_ms[i], 6'400 * i);
        ASSERT_EQ(value["x_mm"][i], 64.0 * double(i));
    }
    // The thinned history still contains the only state in which the robot was lost.
    EXPECT_EQ(std::ranges::count(value["motions"], json(2)), 1);
    EXPECT_EQ(value["motions"][50'001 / 64], 2);
    EXPECT_EQ(value["counts"]["lost"], 1);
}

}  // namespace
}  // namespace dotpose::cli
