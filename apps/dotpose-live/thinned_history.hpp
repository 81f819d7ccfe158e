/// Stored states of a robot, reduced to a limited number of time spans for display on a web page.
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
    /// Adds a state. States must be added in chronological order.
    void add(const store::State& state);

    std::int64_t states() const { return states_; }

    /// Returns the history as a JSON object. The object contains an array for each member of Point,
    /// and the number of states for each kind of motion (see docs/fleet.md).
    nlohmann::json value() const;

  private:
    /// Maximum number of points. When it is exceeded, the length of the time spans is doubled.
    static constexpr std::size_t kMaxPoints = 2000;
    static constexpr std::size_t kMaxMaps = 100;

    struct Place {
        double x_mm = 0;
        double y_mm = 0;
        std::size_t map = 0;  ///< index into `maps_`
    };
    /// Summary of the states in one time span.
    struct Point {
        std::int64_t span = 0;       ///< index of the time span, 0 for the first span
        std::int64_t time_us = 0;    ///< time of the first state
        std::optional<Place> place;  ///< first known position, or nullopt
        double speed_mm_s = 0;       ///< maximum speed
        /// `lost` if any state is lost, else `moving` if any state is moving, else `still`.
        store::Motion motion = store::Motion::still;
    };

    Point point_of(const store::State& state);
    static void merge(Point& into, const Point& next);
    void thin_out();

    std::int64_t states_ = 0;
    std::array<std::int64_t, 3> counts_{};  ///< numbers of states, indexed by motion
    std::int64_t first_us_ = 0;
    std::int64_t last_us_ = 0;
    std::int64_t span_us_ = 100'000;  ///< length of a time span
    double max_speed_mm_s_ = 0;
    std::vector<std::string> maps_;
    std::vector<Point> points_;
};

}  // namespace dotpose::cli
