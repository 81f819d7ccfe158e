/// The wrong place that resembles a true one most.
#pragma once

#include "dotpose/code.hpp"

namespace dotpose {

/// Of the places that differ from `place` in x (or in y) by the place in one secondary sequence,
/// and in their section, the one that shows most of the `lines` columns (or rows) from `place` on
/// as they are. All rows (or columns) it shows as they are, so all bits of the other axis.
Place worst_rival(Profile profile, const Place& place, bool is_along_x, int lines);

}  // namespace dotpose
