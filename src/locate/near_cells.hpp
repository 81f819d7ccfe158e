// Near cells: distance between cells of the code plane, whose axes are cyclic.
#pragma once

#include <algorithm>
#include <cstdint>

#include "dotpose/code.hpp"

namespace dotpose::core {

/// Returns true if two cells differ by less than `limit` along each axis.
inline bool are_near(Cell a, Cell b, std::uint32_t limit) {
    const auto distance = [](std::uint32_t c, std::uint32_t d) {
        const std::uint32_t apart = c > d ? c - d : d - c;
        return std::min(apart, kPositionsPerAxis - apart);
    };
    return distance(a.x, b.x) < limit && distance(a.y, b.y) < limit;
}

}  // namespace dotpose::core
