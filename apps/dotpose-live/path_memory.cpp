#include "path_memory.hpp"

#include <array>
#include <cmath>

namespace dotpose::cli {
namespace {

/// Converts a point on a sheet, in mm, to the coordinates of `plane`. For the world plane, the
/// sheet must have a world pose.
draw::Point in_plane(const SheetEntry& entry, Plane plane, double x_mm, double y_mm) {
    const Sheet& sheet = entry.sheet;
    if (plane == Plane::pattern) {
        const double spacing_mm = sheet.pattern.spacing_mm;
        return {sheet.origin.x * spacing_mm + x_mm - sheet.origin_x_mm,
                sheet.origin.y * spacing_mm + y_mm - sheet.origin_y_mm};
    }
    SheetPlace place;
    place.entry = &entry;
    place.x_mm = x_mm;
    place.y_mm = y_mm;
    const auto world = world_place(place);
    return {world->x_m * 1000, world->y_m * 1000};
}

}  // namespace

void PathMemory::add(const Track& track) {
    is_jump_ = is_jump_ || track.is_lost || track.events.fix || track.events.kidnapped;
    if (track.is_lost || frames_++ % stride_ != 0) return;
    marks_.push_back({track.pose.x_mm(), track.pose.y_mm(), is_jump_});
    is_jump_ = false;
    if (marks_.size() < kMax) return;
    for (std::size_t i = 0; 2 * i < marks_.size(); ++i) {
        const bool is_jump = marks_[2 * i].is_jump || (2 * i > 0 && marks_[2 * i - 1].is_jump);
        marks_[i] = marks_[2 * i];
        marks_[i].is_jump = is_jump;
    }
    marks_.resize(marks_.size() / 2);
    stride_ *= 2;
}

std::vector<std::vector<draw::Point>> PathMemory::strokes() const {
    std::vector<std::vector<draw::Point>> strokes;
    for (const video::PathMark& mark : marks_) {
        if (mark.is_jump || strokes.empty()) strokes.emplace_back();
        strokes.back().push_back({mark.x, mark.y});
    }
    return strokes;
}

std::vector<draw::MapSheet> map_sheets(const std::vector<SheetEntry>& sheets, Plane plane) {
    std::vector<draw::MapSheet> drawn;
    for (const SheetEntry& entry : sheets) {
        if (plane == Plane::sheet_world && !entry.world) continue;
        const double w = entry.sheet.width_mm;
        const double h = entry.sheet.height_mm;
        drawn.push_back({entry.name,
                         {in_plane(entry, plane, 0, 0), in_plane(entry, plane, w, 0),
                          in_plane(entry, plane, w, h), in_plane(entry, plane, 0, h)}});
    }
    return drawn;
}

}  // namespace dotpose::cli
