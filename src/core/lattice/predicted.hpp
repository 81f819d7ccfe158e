// Predicted: where a prediction has the cells of the grid in the image.
#pragma once

#include "core/math/fixed.hpp"
#include "core/stages.hpp"
#include "dotpose/options.hpp"
#include "dotpose/prediction.hpp"
#include "dotpose/status.hpp"

namespace dotpose::core {

/// Dots are looked for every few rows.
inline constexpr int kRowsAtOnce = 12;

/// Sets corner, cells, and what depends on the spacing. The size of the image, at most 4096 px per
/// side, and the memory stand in `tracking`. Errors: not_tracked, if no such view of the pattern
/// can be tracked; any bits are safe.
Status lay_predicted_cells(const Prediction& prediction, Profile profile, Tracking& tracking);

/// The middle of the image is about here, along both axes.
inline constexpr int kMiddleCell = kMostTracked / 2;

/// Where a cell's intersection lies.
inline Vec place_q16(const CellMap& cells, int i, int j) {
    return {cells.origin_q16.x + i * cells.along_x_q16.x + j * cells.along_y_q16.x,
            cells.origin_q16.y + i * cells.along_x_q16.y + j * cells.along_y_q16.y};
}

/// The cell in the middle of the first rows.
Vec middle_cell(const Tracking& tracking);

/// Dots are displaced by so much from now on.
void set_displacement(std::int32_t displacement_q12, Tracking& tracking);

}  // namespace dotpose::core
