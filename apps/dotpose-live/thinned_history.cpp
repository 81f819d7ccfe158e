#include "thinned_history.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace dotpose::cli {
namespace {

using nlohmann::json;
using store::Motion;

double rounded_to(double value, double steps) {
    return std::round(value * steps) / steps;
}

/// Returns the motion to display for a time span that contains two different motions. `lost` takes
/// precedence over `moving`, and `moving` over `still`.
Motion more_urgent(Motion a, Motion b) {
    const auto rank = [](Motion motion) {
        return motion == Motion::lost ? 2 : motion == Motion::moving ? 1 : 0;
    };
    return rank(a) >= rank(b) ? a : b;
}

}  // namespace

ThinnedHistory::Point ThinnedHistory::point_of(const store::State& state) {
    Point point{(state.time_us - first_us_) / span_us_, state.time_us, {}, 0, state.motion};
    if (state.motion == Motion::lost) return point;
    point.speed_mm_s = std::hypot(state.vx_um_s, state.vy_um_s) * 1e-3;
    auto map = std::ranges::find(maps_, state.place->map);
    if (map == maps_.end() && maps_.size() == kMaxMaps) return point;
    if (map == maps_.end()) map = maps_.insert(maps_.end(), state.place->map);
    point.place = {static_cast<double>(state.x_nm) * 1e-6, static_cast<double>(state.y_nm) * 1e-6,
                   static_cast<std::size_t>(map - maps_.begin())};
    return point;
}

void ThinnedHistory::merge(Point& into, const Point& next) {
    if (!into.place) into.place = next.place;
    into.speed_mm_s = std::max(into.speed_mm_s, next.speed_mm_s);
    into.motion = more_urgent(into.motion, next.motion);
}

void ThinnedHistory::add(const store::State& state) {
    if (states_++ == 0) first_us_ = state.time_us;
    last_us_ = state.time_us;
    ++counts_[static_cast<std::size_t>(state.motion)];
    const Point point = point_of(state);
    max_speed_mm_s_ = std::max(max_speed_mm_s_, point.speed_mm_s);
    if (!points_.empty() && points_.back().span == point.span) {
        merge(points_.back(), point);
        return;
    }
    points_.push_back(point);
    while (points_.size() > kMaxPoints)
        thin_out();
}

/// Doubles the length of all time spans, and merges the points that then belong to the same span.
void ThinnedHistory::thin_out() {
    span_us_ *= 2;
    std::vector<Point> thinned;
    for (Point& point : points_) {
        point.span /= 2;
        if (!thinned.empty() && thinned.back().span == point.span) {
            merge(thinned.back(), point);
        } else {
            thinned.push_back(point);
        }
    }
    points_ = std::move(thinned);
}

json ThinnedHistory::value() const {
    json times_ms = json::array();
    json x_mm = json::array();
    json y_mm = json::array();
    json maps = json::array();
    json speeds = json::array();
    json motions = json::array();
    for (const Point& point : points_) {
        const auto& place = point.place;
        times_ms.push_back((point.time_us - first_us_) / 1000);
        x_mm.push_back(place ? json(rounded_to(place->x_mm, 100)) : json(nullptr));
        y_mm.push_back(place ? json(rounded_to(place->y_mm, 100)) : json(nullptr));
        maps.push_back(place ? json(place->map) : json(nullptr));
        speeds.push_back(rounded_to(point.speed_mm_s, 10));
        motions.push_back(static_cast<int>(point.motion));
    }
    json counts = json::object();
    for (const Motion motion : {Motion::moving, Motion::still, Motion::lost})
        counts[std::string(store::name(motion))] = counts_[static_cast<std::size_t>(motion)];
    return {{"states", states_},
            {"counts", std::move(counts)},
            {"first_us", first_us_},
            {"last_us", last_us_},
            {"span_ms", span_us_ / 1000},
            {"max_speed_mm_s", max_speed_mm_s_},
            {"maps", maps_},
            {"times_ms", std::move(times_ms)},
            {"x_mm", std::move(x_mm)},
            {"y_mm", std::move(y_mm)},
            {"map_of", std::move(maps)},
            {"speeds_mm_s", std::move(speeds)},
            {"motions", std::move(motions)}};
}

}  // namespace dotpose::cli
