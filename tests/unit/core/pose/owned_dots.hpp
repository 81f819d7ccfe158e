// Measured dots and the memory that contains them.
#pragma once

#include <array>

#include "../geometry.hpp"
#include "core/patch_memory.hpp"

namespace dotpose::core_test {

struct OwnedDots {
    MeasuredDots dots;
    std::array<std::array<float, 1040>, 4> floats{};
    std::array<std::array<std::int32_t, 1040>, 7> ints{};

    OwnedDots() {
        dots.column = floats[0];
        dots.row = floats[1];
        dots.x = floats[2];
        dots.y = floats[3];
        dots.bits = ints[0];
        dots.window_u = ints[1];
        dots.window_v = ints[2];
        dots.mass = ints[3];
        dots.sum_u = ints[4];
        dots.sum_v = ints[5];
        dots.paper = ints[6];
        floats[2].fill(kNoDot_px);
    }

    void add(FixedVec cell, Symbol symbol, Vec2 px) {
        const auto k = static_cast<std::size_t>(dots.count++);
        dots.column[k] = static_cast<float>(cell.x);
        dots.row[k] = static_cast<float>(cell.y);
        dots.bits[k] = static_cast<std::int32_t>(symbol);
        dots.x[k] = static_cast<float>(px.x);
        dots.y[k] = static_cast<float>(px.y);
    }
};

}  // namespace dotpose::core_test
