/// Stored states of a robot, thinned by time for a page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "store/database.hpp"

namespace dotpose::cli {

class ThinnedHistory {
  public:
    /// Adds a state. The states must be in the order of their times.
    void add(const store::State& state);

    std::int64_t states() const { return states_; }

    /// Returns the points as columns, and counts of all states. docs/fleet.md describes the value.
    nlohmann::json value() const;

  private:
    /// Maximum number of points. If there are more, each two adjacent spans of time are merged into
    /// one.
    static constexpr std::size_t kMaxPoints = 2000;
    static constexpr std::size_t kMaxMaps = 100;

    struct Place {
        double x_mm = 0;
        double y_mm = 0;
        std::size_t map = 0;  ///< index in `maps_`
    };
    /// The states of a span of time.
    struct Point {
        std::int64_t span = 0;       ///< index of the span of time
        std::int64_t time_us = 0;    ///< time of the first state
        std::optional<Place> place;  ///< first place; none if the robot was lost
        double speed_mm_s = 0;       ///< maximum
        /// `lost` if any state is lost, otherwise `moving` if any state is moving.
        store::Motion motion = store::Motion::still;
    };

    Point point_of(const store::State& state);
    static void merge(Point& into, const Point& next);
    void thin_out();

    std::int64_t states_ = 0;
    std::array<std::int64_t, 3> counts_{};  ///< states by motion
    std::int64_t first_us_ = 0;
    std::int64_t last_us_ = 0;
    std::int64_t span_us_ = 100'000;  ///< length of the spans of time
    double max_speed_mm_s_ = 0;
    std::vector<std::string> maps_;
    std::vector<Point> points_;
};

}  // namespace dotpose::cli
