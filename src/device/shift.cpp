#include "device/shift.hpp"

#include <algorithm>
#include <utility>

#include "core/math/fixed.hpp"
#include "device/coded_cells.hpp"
#include "device/near_dot.hpp"
#include "device/newest_rows.hpp"
#include "device/predicted.hpp"

namespace dotpose::core {

Shifts::Shifts(const Tracking& tracking) {
    // Maximum distance from the middle column, in px, of the dots whose darkness is summed: two
    // spacings. A rotation relative to the prediction moves these dots only slightly, so it has
    // little effect on the sums.
    const int half = 4 * tracking.spacing_q8 >> 9;
    rows_ = tracking.first_rows;
    // If the frame is rotated by 4 degrees (18/256 rad) about its centre, its first rows move
    // sideways by this distance. The search range includes this movement.
    const int sideways_px = 18 * ((tracking.height_px - rows_) / 2) >> 8;
    const auto steps = [&](int reach_px) {
        return std::min((reach_px + kStep_px - 1) / kStep_px, kMaxSteps);
    };
    steps_ = {steps(tracking.reach_px + sideways_px), steps(tracking.reach_px)};
    // Minimum distance of dots from the left and the right edge of the image: the largest shift,
    // plus half a spacing for the displacement of dots.
    const int margin = kStep_px * steps_.x + (tracking.spacing_q8 >> 9) + 1;
    left_ = std::max(tracking.width_px / 2 - half, margin);
    right_ = std::min(tracking.width_px / 2 + half, tracking.width_px - margin);
    measure_paper(tracking);
    // Level below which pixels are dark. It is close to the paper level, because dots in blurred
    // frames are pale.
    cut_ = paper_ - paper_ / 16;
    add_dots(tracking);
    divide_by_dots();
}

/// Sets the paper level to the mean of the sampled pixels that are not darker than the mean of all
/// sampled pixels.
void Shifts::measure_paper(const Tracking& tracking) {
    int threshold = 0;
    for (int round = 0; round < 2; ++round) {
        int sum = 0;
        int count = 0;
        for (int v = 0; v < rows_; v += 4) {
            const std::uint8_t* row = kept_row(tracking, v);
            for (int u = left_; u < right_; u += 4) {
                if (row[u] < threshold) continue;
                sum += row[u];
                ++count;
            }
        }
        threshold = sum / std::max(count, 1);
    }
    paper_ = threshold;
}

void Shifts::add_dots(const Tracking& tracking) {
    const int reach = kStep_px * steps_.y;
    // Maximum distance of a visited cell from the middle cell, in cells along each axis. At any
    // rotation of the grid, the visited cells include all dots near the middle column that are in
    // the first rows or that a shift can move into the first rows.
    constexpr int kAround = 5;
    const FixedVec middle = middle_cell(tracking);
    const auto around = [&](int cell) {
        return std::pair{std::max(cell - kAround, tracking.first_cell),
                         std::min(cell + kAround, tracking.last_cell)};
    };
    const auto [first_i, last_i] = around(middle.x);
    const auto [first_j, last_j] = around(middle.y);
    for (int j = first_j; j <= last_j; ++j) {
        FixedVec at_q16 = place_q16(tracking.cells, first_i, j);
        for (int i = first_i; i <= last_i; ++i, at_q16 = at_q16 + tracking.cells.along_x_q16) {
            const int u = at_q16.x >> 16;
            const int v = at_q16.y >> 16;
            if (u < left_ || u >= right_ || v < -reach || v >= rows_ + reach) continue;
            const auto symbol = static_cast<std::size_t>(coded_symbol(tracking, i, j));
            const FixedVec dot_q16 = at_q16 + tracking.displaced_q16[symbol];
            add_dot(tracking, (dot_q16.x + 32768) >> 16, (dot_q16.y + 32768) >> 16);
        }
    }
}

void Shifts::add_dot(const Tracking& tracking, int u, int v) {
    const int left = u - kStep_px * steps_.x;
    int row = v - kStep_px * steps_.y;
    for (int y = 0; y <= 2 * steps_.y; ++y, row += kStep_px) {
        if (static_cast<unsigned>(row) >= static_cast<unsigned>(rows_)) continue;
        ++dots_[static_cast<std::size_t>(y)];
        const std::uint8_t* pixel = kept_row(tracking, row) + left;
        std::uint16_t* sum = row_of(y);
        for (const std::uint16_t* end = sum + 2 * steps_.x + 1; sum != end;
             ++sum, pixel += kStep_px) {
            const int darkness = cut_ - *pixel;
            if (darkness >= 0) *sum = static_cast<std::uint16_t>(*sum + darkness);
        }
    }
}

void Shifts::divide_by_dots() {
    // Minimum divisor. The mean over a few dots may be large by chance. To reduce such means, sums
    // over fewer than kMinDivisor dots are divided by kMinDivisor.
    constexpr int kMinDivisor = 6;
    for (int y = 0; y <= 2 * steps_.y; ++y) {
        const int dots = std::max<int>(dots_[static_cast<std::size_t>(y)], kMinDivisor);
        const int inverse_q12 = 4096 / dots;
        std::uint16_t* mean = row_of(y);
        for (const std::uint16_t* end = mean + 2 * steps_.x + 1; mean != end; ++mean)
            *mean = static_cast<std::uint16_t>(*mean * inverse_q12 >> 12);
    }
}

/// Clears the means around a shift that `next` returned, so that later calls do not return adjacent
/// shifts.
void Shifts::forget_around(FixedVec at) {
    constexpr int kFar = 2;
    for (int y = std::max<std::int32_t>(at.y - kFar, 0);
         y <= std::min<std::int32_t>(at.y + kFar, 2 * steps_.y); ++y) {
        std::uint16_t* const row = row_of(y);
        std::fill(row + std::max<std::int32_t>(at.x - kFar, 0),
                  row + std::min<std::int32_t>(at.x + kFar, 2 * steps_.x) + 1, std::uint16_t{0});
    }
}

bool Shifts::next(FixedVec& shift_q8) {
    int best = 0;
    FixedVec at;
    for (int y = 0; y <= 2 * steps_.y; ++y) {
        const std::uint16_t* here = row_of(y);
        for (int x = 0; x <= 2 * steps_.x; ++x, ++here) {
            // Smooths the mean with its four neighbours to reduce noise.
            const int around = 4 * here[0] + here[-1] + here[1] + here[-kPerRow] + here[kPerRow];
            if (around <= best) continue;
            best = around;
            at = {x, y};
        }
    }
    if (best == 0) return false;
    constexpr int kStep_q8 = kStep_px * 256;
    // Returns the offset of the maximum from the best step along one axis, in 2^-8 px: the centroid
    // of the means at the best step and at the two adjacent steps.
    const auto between = [](int before, int here, int after) {
        return (after - before) * kStep_q8 / std::max(before + here + after, 1);
    };
    const std::uint16_t* const here = row_of(at.y) + at.x;
    shift_q8 = {(at.x - steps_.x) * kStep_q8 + between(here[-1], here[0], here[1]),
                (at.y - steps_.y) * kStep_q8 + between(here[-kPerRow], here[0], here[kPerRow])};
    depth_ = paper_ - cut_ + here[0];
    forget_around(at);
    return true;
}

}  // namespace dotpose::core
