/// A simulated robot that drives over the sheets of a sheet file, and what its camera sees.
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

/// Pose of the camera on a sheet.
struct PoseOnSheet {
    const SheetEntry* entry = nullptr;
    CameraPose pose;          ///< in the pattern of the sheet
    bool is_on_page = false;  ///< false: the image centre shows the table
};

/// The robot drives a figure of eight at constant speed, again and again, and its camera faces
/// ahead. The eight fills the rectangle of all sheets whose place in the world is known, or the
/// first sheet if there is none. Between the sheets there is a dark table. The frames do not depend
/// on each other; threads may make them at the same time.
class SimulatedDrive {
  public:
    /// The imperfections are those of all frames; the motion blur is that of the speed. Throws
    /// BadArgument if there are no sheets.
    SimulatedDrive(const std::vector<SheetEntry>& sheets, const DriveOptions& options,
                   const CameraModel& camera, const Imperfections& imperfections,
                   std::uint64_t seed);

    int frames_per_lap() const;

    PoseOnSheet pose(int frame) const;
    GreyImage image(int frame) const;

  private:
    /// A point of the path, in mm, y up, and the direction of travel.
    struct Waypoint {
        double x_mm = 0;
        double y_mm = 0;
        double heading_rad = 0;
    };

    void lay_path();
    Waypoint at_phase(double phase_rad) const;
    Waypoint waypoint(int frame) const;
    GreyImage view(const SheetEntry& entry, const CameraPose& pose, int frame) const;

    std::vector<SheetEntry> sheets_;  ///< all with a place in the world
    DriveOptions options_;
    CameraModel camera_;
    Imperfections imperfections_;
    std::uint64_t seed_;
    Vec2 centre_mm_;
    Vec2 amplitude_mm_;
    bool is_upright_ = false;         ///< whether the eight is higher than wide
    std::vector<double> lengths_mm_;  ///< length of the path up to each of equal steps of its phase
};

}  // namespace dotpose::cli
