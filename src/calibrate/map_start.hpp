// Collects the dots on a page and their observations in frames, and computes approximate poses of
// the frames.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/map_solver.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::calibrate {

/// Returns the dots of a page at their nominal positions, scaled by the print scales of the sheet.
MapGrid grid_of(const SheetEntry& entry);

/// A frame that shows the page, with the view computed from its fix.
struct MapSighting {
    std::size_t first = 0;  ///< index of the first observation
    std::size_t count = 0;
    PlaneFromImage plane;
};

/// Adds the dots of `fix` that are on `page` to `observations`, and adds the frame to `frames`. The
/// coordinates of the observations are undistorted and in px until `start_map` converts them to mm.
/// If fewer than `min_dots` dots are on the page, adds nothing and returns false.
bool add_sighting(const Fix& fix, const Trace& trace, const MapPage& page, std::size_t min_dots,
                  std::vector<MapSighting>& frames, std::vector<MapObservation>& observations);

/// Converts the observations to positions on the paper in the camera frame, and adds the frames
/// with their approximate poses to `solution`. The view used for the conversion is
/// - the view in the camera file, if the file has one,
/// - otherwise, if the camera was mounted, the median of the views of all frames,
/// - otherwise, if the camera was hand-held, the view of each frame.
/// Scales all positions so that the median scale between the frames and the page is 1. The
/// positions of the dots on the page include their offsets in the earlier map. Returns the maximum
/// distance between a dot and the origin of the camera frame, in mm.
double start_map(const MapGrid& grid, const EarlierOffsets& earlier,
                 const std::optional<Camera>& camera, const std::vector<MapSighting>& frames,
                 std::vector<MapObservation>& observations, MapSolution& solution);

/// Returns a ratio that shows how well the earlier map explains the residuals. The numerator is the
/// sum over all frames of the median squared residual with the offsets of the map. The denominator
/// is the same sum without these offsets. The ratio is below 1 if the offsets reduce the residuals.
/// `solution` must contain the poses computed by `start_map`.
double misfit(const MapGrid& grid, const EarlierOffsets& earlier, double reach_mm,
              const std::vector<MapObservation>& observations, const MapSolution& solution);

}  // namespace dotpose::calibrate
