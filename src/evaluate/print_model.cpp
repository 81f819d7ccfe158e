#include "dotpose/tools/print_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "evaluate/protocol.hpp"

namespace dotpose {

PrintModel::PrintModel(double worst_x_mm, double worst_y_mm) {
    using namespace evaluate_detail;
    constexpr double kPitch_mm = kSide_mm / (kPositionsPerSide - 1);
    // Maximum shift along each axis over all positions of the protocol, with both amplitudes set to
    // 1.
    Vec2 max_shift;
    for (const Step step : spiral(kPositionsPerSide)) {
        const Vec2 shift = shift_mm({step.x * kPitch_mm, step.y * kPitch_mm});
        max_shift = {std::max(max_shift.x, std::abs(shift.x)),
                     std::max(max_shift.y, std::abs(shift.y))};
    }
    amplitude_mm_ = {worst_x_mm / max_shift.x, worst_y_mm / max_shift.y};
}

Vec2 PrintModel::shift_mm(Vec2 from_middle_mm) const {
    // Along the feed (y), the shift models rollers that turn unevenly, and paper that slips more on
    // one side. Across the feed, it models a scan line that is bowed and slightly stretched.
    constexpr double kTurn = 2 * std::numbers::pi;
    const double x = from_middle_mm.x / kSide_mm;
    const double y = from_middle_mm.y / kSide_mm;
    const double across = 0.75 * std::sin(kTurn * (0.62 * x + 0.10)) +
                          0.45 * std::cos(kTurn * (0.48 * y - 0.17)) * std::sin(kTurn * 0.35 * x) +
                          0.22 * std::sin(kTurn * (1.30 * y + 0.33)) - 0.28;
    const double along = 0.85 * std::sin(kTurn * (0.58 * y - 0.06)) +
                         0.42 * std::sin(kTurn * (1.65 * y + 0.21)) +
                         0.38 * std::cos(kTurn * (0.42 * x + 0.30 * y + 0.12)) - 0.12;
    return {amplitude_mm_.x * across, amplitude_mm_.y * along};
}

}  // namespace dotpose
