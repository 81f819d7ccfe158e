#include "dotpose/frame_pacer.hpp"

namespace dotpose {
namespace {

std::int64_t place_q16(std::uint32_t cell, std::uint16_t fraction_q16) {
    return std::int64_t{cell} * 65536 + fraction_q16;
}

bool is_beyond(std::int64_t difference, std::int64_t limit) {
    return difference > limit || difference < -limit;
}

/// Returns the signed angle from a to b, in the shorter direction.
std::int32_t turn_bam(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(b) - static_cast<std::uint32_t>(a));
}

}  // namespace

bool FramePacer::has_moved(const Fix& fix) const {
    const bool was_seen = rest_.status == Status::ok;
    if (fix.status != Status::ok) {
        // While the device moves, a frame without a fix is not evidence of further movement. A
        // stationary device, however, is assumed to lose its fix only if it is moved.
        return options_.lost_is_moved && was_seen && motion_ == Motion::stationary;
    }
    if (!was_seen) return true;
    return fix.section != rest_.section ||
           is_beyond(place_q16(fix.cell.x, fix.fraction_x_q16) -
                         place_q16(rest_.cell.x, rest_.fraction_x_q16),
                     options_.moved_q16) ||
           is_beyond(place_q16(fix.cell.y, fix.fraction_y_q16) -
                         place_q16(rest_.cell.y, rest_.fraction_y_q16),
                     options_.moved_q16) ||
           is_beyond(turn_bam(rest_.theta_bam, fix.theta_bam), options_.turned_bam);
}

std::int64_t FramePacer::next_frame_us(const Fix& fix, std::int64_t time_us) {
    if (!has_begun_ || has_moved(fix) || time_us < rest_since_us_) {
        has_begun_ = true;
        rest_ = fix;
        rest_since_us_ = time_us;
        motion_ = Motion::moving;
    } else if (time_us - rest_since_us_ >= options_.stationary_after_us) {
        motion_ = Motion::stationary;
    }
    return time_us +
           (motion_ == Motion::moving ? options_.moving_period_us : options_.stationary_period_us);
}

}  // namespace dotpose
