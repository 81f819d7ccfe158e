/// Stores the path of a robot in a limited amount of memory. Whenever the memory is full, every
/// second point is removed, and later points are added at half the previous rate.
#pragma once

#include <cstdint>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/track.hpp"
#include "draw/track_map.hpp"
#include "reading.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

class PathMemory {
  public:
    /// Adds the robot's position at the time of a frame. Ignores frames in which the robot is lost.
    void add(const Track& track);

    const std::vector<video::PathMark>& marks() const { return marks_; }

    /// Returns the path in mm. A new stroke starts wherever the robot was lost or was moved by
    /// hand.
    std::vector<std::vector<draw::Point>> strokes() const;

  private:
    static constexpr std::size_t kMax = 16384;

    std::vector<video::PathMark> marks_;
    std::int64_t stride_ = 1;  ///< every `stride_`-th tracked frame is stored
    std::int64_t frames_ = 0;
    bool is_jump_ = true;
};

/// Returns the outlines of the sheets in the coordinates of `plane`. For the world plane, omits
/// sheets without a world pose.
std::vector<draw::MapSheet> map_sheets(const std::vector<SheetEntry>& sheets, Plane plane);

}  // namespace dotpose::cli
