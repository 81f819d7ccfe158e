/// A simulated robot that carries a camera and drives over the sheets in a sheet file.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/simulate.hpp"

namespace dotpose::cli {

struct DriveOptions {
    double speed_mm_s = 100;
    double fps = 50;
};

struct PoseOnSheet {
    const SheetEntry* entry = nullptr;
    CameraPose pose;          ///< pose in the pattern frame of the sheet
    bool is_on_page = false;  ///< false if the image centre shows the table
};

/// A robot that repeatedly drives a figure of eight at a constant speed. The x axis of its camera
/// points in the direction of travel. The path fills the bounding rectangle of all sheets that have
/// a world pose. If no sheet has a world pose, the path fills the first sheet. The sheets lie on a
/// dark table. Frames are independent of each other and may be rendered in parallel.
class SimulatedDrive {
  public:
    /// `imperfections` apply to all frames, except that the motion blur is computed from the speed.
    /// Throws BadArgument if there are no sheets.
    SimulatedDrive(const std::vector<SheetEntry>& sheets, const DriveOptions& options,
                   const CameraModel& camera, const Imperfections& imperfections,
                   std::uint64_t seed);

    int frames_per_lap() const;

    PoseOnSheet pose(int frame) const;
    GreyImage image(int frame) const;

  private:
    /// A point on the path in mm, with y up, and the direction of travel in rad.
    struct Waypoint {
        double x_mm = 0;
        double y_mm = 0;
        double heading_rad = 0;
    };

    void lay_path();
    Waypoint at_phase(double phase_rad) const;
    Waypoint waypoint(int frame) const;
    GreyImage view(const SheetEntry& entry, const CameraPose& pose, int frame) const;

    std::vector<SheetEntry> sheets_;  ///< sheets on which the robot drives
    DriveOptions options_;
    CameraModel camera_;
    Imperfections imperfections_;
    std::uint64_t seed_;
    Vec2 centre_mm_;
    Vec2 amplitude_mm_;
    bool is_upright_ = false;         ///< true if the path is taller than it is wide
    std::vector<double> lengths_mm_;  ///< length of the path from its start to each step
};

}  // namespace dotpose::cli
