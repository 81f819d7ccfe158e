#include "history_path.hpp"

#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "state_message.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

void HistoryPath::add(const store::State& state) {
    constexpr std::int64_t kMaxGap_us = 2'000'000;  // a longer gap starts a new stroke
    if (robot_.empty()) {
        robot_ = *state.robot;
        first_us_ = state.time_us;
    }
    begins_stroke_ = begins_stroke_ || state.time_us - last_us_ > kMaxGap_us ||
                     state.motion == store::Motion::lost;
    last_us_ = state.time_us;
    if (state.motion == store::Motion::lost) return;
    if (map_id_.empty()) map_id_ = map_.id.empty() ? state.place->map : map_.id;
    if (state.place->map != map_id_) {
        if (elsewhere_.size() < 20 || elsewhere_.contains(state.place->map)) {
            ++elsewhere_[state.place->map];
        }
        begins_stroke_ = true;
        return;
    }
    newest_ = state;
    const draw::Point place{static_cast<double>(state.x_nm) * 1e-6,
                            static_cast<double>(state.y_nm) * 1e-6};
    if (std::exchange(begins_stroke_, false)) {
        strokes_mm_.emplace_back();
    } else if (draw::length(place - strokes_mm_.back().back()) < step_mm_) {
        return;
    }
    strokes_mm_.back().push_back(place);
    if (++points_ > kMaxPoints) thin_out();
}

/// Removes every second point of each stroke but keeps the end points. Doubles the minimum distance
/// between points that are added later.
void HistoryPath::thin_out() {
    points_ = 0;
    for (auto& stroke : strokes_mm_) {
        std::vector<draw::Point> kept;
        for (std::size_t i = 0; i < stroke.size(); ++i) {
            if (i % 2 == 0 || i + 1 == stroke.size()) kept.push_back(stroke[i]);
        }
        stroke = std::move(kept);
        points_ += stroke.size();
    }
    step_mm_ *= 2;
}

draw::Map HistoryPath::drawing() const {
    draw::Map drawing;
    drawing.title = fmt::format("{} on {}", printable(robot_), printable(map_id_));
    drawing.y_up = !map_id_.starts_with("pattern");
    drawing.sheets = map_.outlines;
    if (!strokes_mm_.empty()) {
        draw::MapRobot drawn;
        drawn.name = printable(robot_);
        drawn.strokes_mm = strokes_mm_;
        drawn.place_mm = {static_cast<double>(newest_.x_nm) * 1e-6,
                          static_cast<double>(newest_.y_nm) * 1e-6};
        drawn.heading_rad = newest_.theta_urad * 1e-6;
        drawing.robots.push_back(std::move(drawn));
    }
    drawing.notes.push_back(
        fmt::format("from {} to {}", timestamp(first_us_), timestamp(last_us_)));
    for (const auto& [map, states] : elsewhere_)
        drawing.notes.push_back(fmt::format("{} states on {}", states, printable(map)));
    draw::keep_visited_sheets(drawing);
    return drawing;
}

}  // namespace dotpose::cli
