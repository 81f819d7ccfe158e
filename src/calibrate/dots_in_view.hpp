// Measures all dots in a frame, given an approximate pose of the camera in space.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/space_fit.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::calibrate {

/// A view of the pattern: the camera, and the length of a spacing on the paper along each axis.
struct PatternView {
    const Camera& camera;
    Pinhole pinhole;
    AxisScale spacing_mm;
    /// Map of the page, or null. With a map, only dots that were measured for the map are used.
    const MapPage* map = nullptr;
};

/// A dot of the code.
struct CodeDot {
    FixedVec step;  ///< intersection, in spacings from `trace.decoding.place`
    Symbol symbol;
    Eigen::Vector2d offset = Eigen::Vector2d::Zero();  ///< offset in the print map, in spacings
};

/// Returns the dot of the code at the offset `step` from `trace.decoding.place`. If `view` has a
/// map, returns nullopt for dots that were not measured for this map.
std::optional<CodeDot> code_dot(const PatternView& view, const Trace& trace, FixedVec step);

/// Returns the position of a dot on the paper, together with the undistorted pixel at which it was
/// seen.
SpaceDot space_dot(const PatternView& view, const CodeDot& dot, PixelPoint undistorted);

/// Measures the dots that `state` predicts in the image. Measures at most `trace.options.max_dots`
/// dots, evenly spread over the image.
std::vector<SpaceDot> dots_in_view(const ImageView& image, const PatternView& view,
                                   const Trace& trace, const SpaceState& state);

/// Fits the pose to the dots in the trace, measures all dots that this pose predicts, and fits the
/// pose again. Positions on the paper are in mm from `trace.decoding.place`. Returns nullopt if the
/// trace has fewer than 12 dots.
std::optional<SpaceFit> fit_to_image(const ImageView& image, const PatternView& view,
                                     const Trace& trace);

}  // namespace dotpose::calibrate
