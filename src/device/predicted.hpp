// Predicted cells: computes the image points of grid cells from a prediction.
#pragma once

#include "core/math/fixed.hpp"
#include "device/tracking.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Number of rows that are collected before their dots are read.
inline constexpr int kRowsAtOnce = 12;

/// Prepares to track a frame, using its prediction. Sets `plane` to the predicted map from the
/// image to the cells, relative to cell (0, 0). In `tracking`, sets the corner, the cells, and the
/// members that depend on the spacing. The memory and the image size must already be set. The image
/// must have at most 4096 px per side. The prediction may contain arbitrary values. Returns
/// not_tracked if:
/// - a value in the prediction is out of range,
/// - the spacing is not from 7 to 14 px (from 5 to 14 px if sheets are known),
/// - the angle between the grid axes is less than 45 degrees, or the spacing along one axis is more
///   than about 1.6 times the spacing along the other,
/// - the memory is too small, or
/// - the part of the image whose cells fit in the memory is too small.
Status lay_predicted_cells(const Prediction& prediction, CodeVariant code, PlaneFromImage& plane,
                           Tracking& tracking);

/// Column and row of the cell near the middle of the image.
inline constexpr int kMiddleCell = kMaxComparedLines / 2;

/// Returns the image point of an intersection, in 2^-16 px.
inline FixedVec place_q16(const CellMap& cells, int i, int j) {
    return {cells.origin_q16.x + i * cells.along_x_q16.x + j * cells.along_y_q16.x,
            cells.origin_q16.y + i * cells.along_x_q16.y + j * cells.along_y_q16.y};
}

/// Returns the cell nearest to the middle of the first `Tracking::first_rows` rows.
FixedVec middle_cell(const Tracking& tracking);

/// Sets the displacement of dots, in 2^-12 spacings, and updates `Tracking::displaced_q16`.
void set_displacement(std::int32_t displacement_q12, Tracking& tracking);

}  // namespace dotpose::core
