#include "fleet_view.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/write_file.hpp"
#include "path_memory.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
FleetMap read_fleet_map(const std::string& sheets) {
    if (sheets.empty()) return {};
    const std::vector<SheetEntry> entries = read_sheets(sheets);
    FleetMap map;
    map.id = std::filesystem::path(sheets).stem().string();
    for (const SheetEntry& entry : entries)
        map.names.insert(entry.name);
    map.outlines = map_sheets(entries, Plane::sheet_world);
    return map;
}

FleetView::FleetView(FleetMap map, std::string drawing, Delivery delivery)
    : map_(std::move(map)), drawing_(std::move(drawing)), delivery_(delivery) {
    if (!drawing_.empty()) require_writable(drawing_);
    if (TerminalScreen::is_available()) screen_.emplace();
}

bool FleetView::take_keys(const FleetState& fleet, const Now& now) {
    if (!screen_) return true;
    bool was_pressed = false;
    while (const auto key = screen_->next_key()) {
        if (*key == Key::quit) return false;
        page_.take(*key);
        was_pressed = true;
    }
    if (was_pressed) show_page(fleet, now);
    return true;
}

void FleetView::refresh(const FleetState& fleet, const Now& now) {
    if (screen_) show_page(fleet, now);
    const auto begun = Clock::now();
    if (drawing_.empty() || begun < next_map_) return;
    // Reports a failure but continues, because the next attempt to draw the map may succeed.
    try {
        draw(fleet, now);
        is_failing_ = false;
    } catch (const Error& error) {
        if (!is_failing_) notify(error.what());
        is_failing_ = true;
    }
    const auto end = Clock::now();
    next_map_ = end + 9 * (end - begun);
}

void FleetView::finish(const FleetState& fleet, const Now& now) {
    if (screen_) {
        leave_screen(fleet, now);
    } else {
        fmt::print("{}", table_of(fleet, map_, delivery_, now));
        std::fflush(stdout);
    }
    if (!drawing_.empty()) draw(fleet, now);
}

/// Closes the screen, then prints the first page of the table and the messages on the normal
/// terminal.
void FleetView::leave_screen(const FleetState& fleet, const Now& now) {
    page_.take(Key::home);
    std::vector<std::string> lines =
        page_.lines(fleet, fleet.robots(now), map_, delivery_, screen_->size());
    lines.pop_back();  // removes the line with the scroll position and the keys
    const std::lock_guard lock(mutex_);
    screen_.reset();
    for (const std::string& line : lines) {
        if (!line.empty()) fmt::print("{}\n", line);
    }
    std::fflush(stdout);
    for (const std::string& message : std::exchange(messages_, {}))
        cli::notify(message);
}

void FleetView::notify(const std::string& message) {
    constexpr std::size_t kMaxMessages = 100;
    const std::lock_guard lock(mutex_);
    if (!screen_) return cli::notify(message);
    messages_.push_back(message);
    if (messages_.size() > kMaxMessages) messages_.pop_front();
}

void FleetView::show_page(const FleetState& fleet, const Now& now) {
    std::vector<std::string> lines =
        page_.lines(fleet, fleet.robots(now), map_, delivery_, screen_->size());
    {
        const std::lock_guard lock(mutex_);
        if (!messages_.empty()) lines.back() += " | " + printable(messages_.back());
    }
    screen_->show(lines);
}

void FleetView::draw(const FleetState& fleet, const Now& now) {
    const std::string map_id = shown_map(map_, fleet.robots(now));
    write_file(drawing_, draw::draw_map(drawing_of(fleet, map_id, map_, now)));
}

}  // namespace dotpose::cli
