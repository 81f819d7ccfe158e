// Predicted: computes the cells of the grid in the image from a prediction.
#pragma once

#include "core/math/fixed.hpp"
#include "device/tracking.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Number of new rows that are collected before their dots are read.
inline constexpr int kRowsAtOnce = 12;

/// Sets the corner, the cells, and the members of `tracking` that depend on the spacing. The memory
/// and the size of the image, at most 4096 px per side, must already be set in `tracking`. The
/// prediction may have any values. Returns not_tracked if
/// - a value of the prediction is out of range,
/// - the spacing is not 7 to 13 px,
/// - the cells are not nearly square, or
/// - the memory, or the part of the image whose cells fit in the memory, is too small.
Status lay_predicted_cells(const Prediction& prediction, CodeVariant code, Tracking& tracking);

/// Index of the cell near the middle of the image, along both axes.
inline constexpr int kMiddleCell = kMaxComparedLines / 2;

/// Returns the place of the intersection of a cell, in units of 2^-16 px.
inline FixedVec place_q16(const CellMap& cells, int i, int j) {
    return {cells.origin_q16.x + i * cells.along_x_q16.x + j * cells.along_y_q16.x,
            cells.origin_q16.y + i * cells.along_x_q16.y + j * cells.along_y_q16.y};
}

/// Returns the cell nearest to the middle of the first `Tracking::first_rows` rows.
FixedVec middle_cell(const Tracking& tracking);

/// Sets the displacement of dots, in units of 2^-12 spacings, and `Tracking::displaced_q16`, which
/// depends on the displacement.
void set_displacement(std::int32_t displacement_q12, Tracking& tracking);

}  // namespace dotpose::core
