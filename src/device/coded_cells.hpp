// Coded cells: the bits of the code around the predicted place, and the bits that were read in a
// tracked frame. Each column and each row of cells is stored in one word.
#pragma once

#include "device/tracking.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// Sets the coded bits of each column and row from `Tracking::corner`, which must contain the place
/// of cell (0, 0). Does not change the bits that were read.
void lay_tracked_lines(CodeVariant code, Tracking& tracking);

inline ComparedLine& column_of(const Tracking& tracking, int i) {
    return tracking.lines[static_cast<std::size_t>(i)];
}
inline ComparedLine& row_of(const Tracking& tracking, int j) {
    return tracking.lines[static_cast<std::size_t>(kMaxComparedLines + j)];
}

int dots_seen(const Tracking& tracking);

inline Symbol coded_symbol(const Tracking& tracking, int i, int j) {
    return make_symbol(static_cast<int>(column_of(tracking, i).code >> j & 1),
                       static_cast<int>(row_of(tracking, j).code >> i & 1));
}

/// Projections of a dot's displacement onto the diagonals that determine its x bit and its y bit
/// (paper, equations 7 and 8), in 2^-12 spacings. A bit is 1 if its projection is positive.
struct Projections {
    std::int32_t x_q12;
    std::int32_t y_q12;
};
Projections projections(const Tracking& tracking, FixedVec from_intersection_q8);

inline Symbol symbol_of(const Projections& p) {
    return make_symbol(p.x_q12 > 0 ? 1 : 0, p.y_q12 > 0 ? 1 : 0);
}

}  // namespace dotpose::core
