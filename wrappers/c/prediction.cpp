#include "dotpose/prediction.hpp"

#include "convert.hpp"

using namespace dotpose;

extern "C" {

dotpose_status dotpose_prediction_like(const dotpose_fix* fix, dotpose_prediction* prediction) {
    if (prediction == nullptr) return DOTPOSE_NULL_POINTER;
    Fix read;
    const dotpose_status status = c::to_core_ok(fix, read);
    if (status == DOTPOSE_OK) c::to_c(Prediction::like(read), *prediction);
    return status;
}

dotpose_status dotpose_prediction_move(dotpose_prediction* prediction, int32_t code,
                                       int32_t by_x_q16, int32_t by_y_q16, int32_t turn_bam,
                                       int32_t pivot_u_q8, int32_t pivot_v_q8) {
    if (prediction == nullptr) return DOTPOSE_NULL_POINTER;
    Prediction read;
    const dotpose_status status = c::to_core(*prediction, read);
    if (status != DOTPOSE_OK) return status;
    constexpr int kFarthest_q16 = 28;
    constexpr int kFarthest_q8 = 21;
    if (!c::is_code(code) || !c::can_move(read) || !c::is_within_range(by_x_q16, kFarthest_q16) ||
        !c::is_within_range(by_y_q16, kFarthest_q16) ||
        !c::is_within_range(pivot_u_q8, kFarthest_q8) ||
        !c::is_within_range(pivot_v_q8, kFarthest_q8)) {
        return DOTPOSE_BAD_VALUE;
    }
    c::to_c(moved(read, static_cast<CodeVariant>(code), {by_x_q16, by_y_q16}, turn_bam,
                  {pivot_u_q8, pivot_v_q8}),
            *prediction);
    return DOTPOSE_OK;
}
}
