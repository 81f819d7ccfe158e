// Collects the dots of a page and of its frames, and computes approximate poses of the frames.
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

/// Returns the dots of a page at their nominal places, scaled by the print scales of the sheet.
MapGrid grid_of(const SheetEntry& entry);

/// A frame of a page, and its view computed from the fix.
struct MapSighting {
    std::size_t first = 0;  ///< index of its first observation
    std::size_t count = 0;
    PlaneFromImage plane;
};

/// Adds the dots of a fix that are on the page. Their coordinates are undistorted pixels, until
/// `start_map` converts them to mm. Returns false, without adding dots, if there are fewer than
/// `min_dots` such dots.
bool add_sighting(const Fix& fix, const Trace& trace, const MapPage& page, std::size_t min_dots,
                  std::vector<MapSighting>& frames, std::vector<MapObservation>& observations);

/// Converts the observations to places on the paper in the frame of the camera, and sets the
/// approximate poses of the frames of `solution`. All frames use the view of the camera file. If
/// the camera file has no view, all frames use their median view. If their views differ because the
/// camera was hand-held, each frame uses its own view instead. All places are scaled such that the
/// median scale between the frames and the page, including the offsets of the earlier map, is 1.
/// Returns the maximum distance between a dot and the origin of the camera frame, in mm.
double start_map(const MapGrid& grid, const EarlierOffsets& earlier,
                 const std::optional<Camera>& camera, const std::vector<MapSighting>& frames,
                 std::vector<MapObservation>& observations, MapSolution& solution);

/// Returns a ratio that shows how well the earlier map explains the residuals. The numerator is the
/// sum over all frames of the median squared residual with the offsets of the map. The denominator
/// is the same sum without these offsets. The ratio is below 1 if the offsets reduce the residuals.
/// `solution` must contain the poses of `start_map`.
double misfit(const MapGrid& grid, const EarlierOffsets& earlier, double reach_mm,
              const std::vector<MapObservation>& observations, const MapSolution& solution);

}  // namespace dotpose::calibrate
