#include "device/dark_pixels.hpp"

namespace dotpose::core {

int sampled_mean(const std::uint8_t* row, int stride) {
    int sum = 0;
    for (int v = 0; v < kPartHeight_px; v += 2, row += 2 * stride)
        sum += row[0] + row[4] + row[8] + row[12];
    return sum >> 4;
}

const std::uint8_t* next_dark(const std::uint8_t* at, const std::uint8_t* end, int level) {
    for (; end - at >= 4; at += 4) {
        if (at[0] < level) return at;
        if (at[1] < level) return at + 1;
        if (at[2] < level) return at + 2;
        if (at[3] < level) return at + 3;
    }
    while (at != end && *at >= level)
        ++at;
    return at;
}

}  // namespace dotpose::core
