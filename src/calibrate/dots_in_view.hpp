// Dots in view: measures all dots of a frame, given an approximate pose of the camera in space.
#pragma once

#include <optional>
#include <vector>

#include "calibrate/space_fit.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/image.hpp"
#include "dotpose/trace.hpp"

namespace dotpose::calibrate {

/// A view of the pattern: the camera, and the length of a spacing on the paper along each axis.
struct PatternView {
    const Camera& camera;
    Pinhole pinhole;
    AxisScale spacing_mm;
};

/// Returns the dot of the code at a step from `trace.decoding.place`, seen at an undistorted pixel.
SpaceDot space_dot(const PatternView& view, FixedVec step, Symbol symbol, PixelPoint undistorted);

/// Measures the dots that `state` predicts in the image. Measures at most `trace.options.max_dots`
/// dots, evenly spread over the image.
std::vector<SpaceDot> dots_in_view(const ImageView& image, const PatternView& view,
                                   const Trace& trace, const SpaceState& state);

/// Fits the pose to the dots in the trace, measures all dots that this pose predicts, and fits the
/// pose again. Places are in mm from `trace.decoding.place`. Returns nullopt if the trace has fewer
/// than 12 dots.
std::optional<SpaceFit> fit_to_image(const ImageView& image, const PatternView& view,
                                     const Trace& trace);

}  // namespace dotpose::calibrate
