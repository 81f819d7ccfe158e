#include "fleet_page.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include <fmt/core.h>

namespace dotpose::cli {

void FleetPage::take(Key key) {
    switch (key) {
        case Key::up:
            first_ -= 1;
            break;
        case Key::down:
            first_ += 1;
            break;
        case Key::page_up:
            first_ -= rows_;
            break;
        case Key::page_down:
            first_ += rows_;
            break;
        case Key::home:
            first_ = 0;
            break;
        case Key::end:
            first_ = std::numeric_limits<std::ptrdiff_t>::max();
            break;
        case Key::order:
            is_by_attention_ = !is_by_attention_;
            first_ = 0;
            break;
        case Key::quit:
            break;
    }
    first_ = std::max<std::ptrdiff_t>(first_, 0);
}

std::vector<std::string> FleetPage::lines(const FleetState& fleet, FleetRobots robots,
                                          const FleetMap& map, Delivery delivery, ScreenSize size) {
    constexpr int kWideColumns = 120;
    constexpr std::ptrdiff_t kOtherLines = 4;  // header, two summary lines and scroll position
    const Layout layout = size.columns >= kWideColumns ? Layout::wide : Layout::narrow;
    if (is_by_attention_) sort_by_attention(robots, map);
    const auto count = static_cast<std::ptrdiff_t>(robots.size());
    rows_ = std::max<std::ptrdiff_t>(size.rows - kOtherLines, 1);
    first_ = std::clamp<std::ptrdiff_t>(first_, 0, std::max<std::ptrdiff_t>(count - rows_, 0));
    const std::ptrdiff_t end = std::min(first_ + rows_, count);

    std::vector<std::string> lines{table_header(layout)};
    for (std::ptrdiff_t i = first_; i < end; ++i) {
        const auto& [name, robot] = robots[static_cast<std::size_t>(i)];
        lines.push_back(table_row(name, robot, map, layout, delivery));
    }
    lines.resize(static_cast<std::size_t>(rows_) + 1);
    std::istringstream summary(summary_of(fleet, robots, map, delivery));
    for (std::string line; std::getline(summary, line);)
        lines.push_back(std::move(line));
    lines.push_back(fmt::format("{}-{} of {}, {} | arrows PgUp PgDn Home End, n: {}, q: end",
                                count > 0 ? first_ + 1 : 0, end, count,
                                is_by_attention_ ? "attention first" : "by name",
                                is_by_attention_ ? "by name" : "attention first"));
    lines.resize(static_cast<std::size_t>(size.rows));
    return lines;
}

}  // namespace dotpose::cli
