#include "fleet_view.hpp"

#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/core.h>
#include <unistd.h>

#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/write_file.hpp"
#include "path_memory.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

FleetView::FleetView(const std::string& sheets, std::string map, Delivery delivery)
    : map_path_(std::move(map)), delivery_(delivery), on_terminal_(isatty(STDOUT_FILENO) == 1) {
    if (!map_path_.empty()) require_writable(map_path_);
    if (sheets.empty()) return;
    map_id_ = std::filesystem::path(sheets).stem().string();
    sheets_ = map_sheets(read_sheets(sheets), Plane::sheet_world);
}

void FleetView::refresh(const FleetState& fleet) {
    if (on_terminal_) show_table(fleet);
    const auto begun = Clock::now();
    if (map_path_.empty() || begun < next_map_) return;
    // Reports a failure and continues, because the next attempt to draw the map may succeed.
    try {
        draw(fleet);
        is_failing_ = false;
    } catch (const Error& error) {
        if (!is_failing_) tell(error.what());
        is_failing_ = true;
    }
    const auto end = Clock::now();
    next_map_ = end + 9 * (end - begun);
}

void FleetView::finish(const FleetState& fleet) {
    show_table(fleet);
    if (!map_path_.empty()) draw(fleet);
}

void FleetView::show_table(const FleetState& fleet) const {
    constexpr const char* kClear = "\033[H\033[J";
    fmt::print("{}{}", on_terminal_ ? kClear : "", table_of(fleet, delivery_, system_us()));
    std::fflush(stdout);
}

void FleetView::draw(const FleetState& fleet) {
    write_file(map_path_, draw::draw_map(map_of(fleet, map_shown(fleet), sheets_)));
}

/// Returns the name of the map to draw: the world frame of the sheet file or, without a sheet file,
/// the map of the first robot that has a map.
std::string FleetView::map_shown(const FleetState& fleet) const {
    if (!map_id_.empty()) return map_id_;
    for (const auto& [name, robot] : fleet.robots()) {
        if (!robot.newest.map_id.empty()) return robot.newest.map_id;
    }
    return {};
}

}  // namespace dotpose::cli
