// Predicted: lays the cells of the grid where a prediction expects them in the image.
#pragma once

#include "core/math/fixed.hpp"
#include "core/stages.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Dots are read each time this number of rows has come in.
inline constexpr int kRowsAtOnce = 12;

/// Sets corner, cells, and what depends on the spacing. The size of the image, at most 4096 px per
/// side, and the memory must be set in `tracking`. Errors: not_tracked, if such a view of the
/// pattern cannot be tracked; predictions with any content are safe.
Status lay_predicted_cells(const Prediction& prediction, Profile profile, Tracking& tracking);

/// The cell, along both axes, that lies near the middle of the image.
inline constexpr int kMiddleCell = kMostTracked / 2;

/// Returns where a cell's intersection lies, in 2^-16 px.
inline Vec place_q16(const CellMap& cells, int i, int j) {
    return {cells.origin_q16.x + i * cells.along_x_q16.x + j * cells.along_y_q16.x,
            cells.origin_q16.y + i * cells.along_x_q16.y + j * cells.along_y_q16.y};
}

/// Returns the cell in the middle of the first rows.
Vec middle_cell(const Tracking& tracking);

/// Sets the displacement of dots, in 2^-12 spacing, and their places that follow from it.
void set_displacement(std::int32_t displacement_q12, Tracking& tracking);

}  // namespace dotpose::core
