// Surroundings: the grey levels around a pixel, and the correction of defective pixels.
#pragma once

#include <algorithm>

#include "dotpose/image.hpp"

namespace dotpose::core {

struct LevelRange {
    int low = 255;
    int high = 0;
};

/// Returns the grey level range of a pixel's eight neighbours. The pixel must not be on the border.
inline LevelRange range_around(const ImageView& image, int u, int v) {
    LevelRange range;
    for (int dv = -1; dv <= 1; ++dv) {
        const std::uint8_t* row = image.row(v + dv) + u;
        for (int du = -1; du <= 1; ++du) {
            if (du == 0 && dv == 0) continue;
            range.low = std::min(range.low, int{row[du]});
            range.high = std::max(range.high, int{row[du]});
        }
    }
    return range;
}

/// Returns a pixel's level, or the mean of its neighbours if the pixel is defective. A pixel is
/// defective if its level is outside the range of its eight neighbours by more than a quarter of
/// their maximum. The pixel must not be on the border.
inline int without_defect(const ImageView& image, int u, int v) {
    const auto [low, high] = range_around(image, u, v);
    const int level = image.row(v)[u];
    const int far = high / 4;
    if (level >= low - far && level <= high + far) return level;
    int sum = 4 - level;
    for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du)
            sum += image.row(v + dv)[u + du];
    }
    return sum / 8;
}

}  // namespace dotpose::core
