#include "convert.hpp"
#include "dotpose/frame_pacer.hpp"
#include "object.hpp"

namespace {

using namespace dotpose;

using Pacer = c::Object<FramePacer, 0xD07C0002>;

constexpr std::size_t kFirstBytes = 40;
/// Times and periods are at most 2^kLatest_us µs in magnitude, so the sum of two values does not
/// overflow.
constexpr int kLatest_us = 61;

dotpose_pacer_options options_of(const PacerOptions& o) {
    return {sizeof(dotpose_pacer_options),
            o.moved_q16,
            o.turned_bam,
            o.lost_is_moved ? 1 : 0,
            o.stationary_after_us,
            o.stationary_period_us,
            o.moving_period_us};
}

bool is_period(std::int64_t us) {
    return us >= 0 && c::is_within_range(us, kLatest_us);
}

bool are_good(const dotpose_pacer_options& o) {
    return o.moved_q16 >= 0 && o.turned_bam >= 0 && c::is_one_of(o.lost_is_moved, 1) &&
           is_period(o.stationary_after_us) && is_period(o.stationary_period_us) &&
           is_period(o.moving_period_us);
}

}  // namespace

extern "C" {

dotpose_status dotpose_pacer_options_init(dotpose_pacer_options* options, size_t bytes) {
    return c::write_sized(options_of(PacerOptions{}), kFirstBytes, options, bytes);
}

dotpose_status dotpose_pacer_init(dotpose_pacer* pacer, const dotpose_pacer_options* given) {
    if (pacer == nullptr) return DOTPOSE_NULL_POINTER;
    *pacer = {};
    dotpose_pacer_options read = options_of(PacerOptions{});
    const dotpose_status status = c::read_sized(given, kFirstBytes, read);
    if (status != DOTPOSE_OK) return status;
    if (!are_good(read)) return DOTPOSE_BAD_ARGUMENT;
    Pacer::make(pacer, PacerOptions{.stationary_after_us = read.stationary_after_us,
                                    .stationary_period_us = read.stationary_period_us,
                                    .moving_period_us = read.moving_period_us,
                                    .moved_q16 = read.moved_q16,
                                    .turned_bam = read.turned_bam,
                                    .lost_is_moved = read.lost_is_moved != 0});
    return DOTPOSE_OK;
}

dotpose_status dotpose_pacer_next_frame(dotpose_pacer* pacer, const dotpose_fix* fix,
                                        int64_t time_us, int64_t* next_us, int32_t* is_moving) {
    if (next_us == nullptr) return DOTPOSE_NULL_POINTER;
    FramePacer* found = nullptr;
    dotpose_status status = Pacer::find(pacer, found);
    if (status != DOTPOSE_OK) return status;
    Fix read;
    status = c::to_core(fix, read);
    if (status != DOTPOSE_OK) return status;
    if (!c::is_within_range(time_us, kLatest_us)) return DOTPOSE_BAD_VALUE;
    *next_us = found->next_frame_us(read, time_us);
    if (is_moving != nullptr) *is_moving = found->motion() == Motion::moving ? 1 : 0;
    return DOTPOSE_OK;
}
}
