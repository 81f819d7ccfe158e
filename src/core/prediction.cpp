#include "dotpose/prediction.hpp"

#include "core/math/fixed.hpp"
#include "core/math/plane.hpp"

namespace dotpose {
namespace {

using namespace core;

FixedVec turned(FixedVec v, FixedVec unit_q30) {
    const auto part = [](std::int64_t a_q30) {
        return static_cast<std::int32_t>((a_q30 + (1 << 29)) >> 30);
    };
    return {part(std::int64_t{unit_q30.x} * v.x - std::int64_t{unit_q30.y} * v.y),
            part(std::int64_t{unit_q30.y} * v.x + std::int64_t{unit_q30.x} * v.y)};
}

}  // namespace

Prediction Prediction::like(const Fix& fix) {
    Prediction prediction;
    prediction.pattern_from_image = fix.pattern_from_image;
    prediction.place = fix.place;
    prediction.displacement_q16 = fix.displacement_q16;
    prediction.readout_turn_rad = fix.readout_turn_rad;
    return prediction;
}

Prediction moved(const Prediction& prediction, CodeVariant code, FixedVec by_q16,
                 std::int32_t turn_bam, FixedVec pivot_q8) {
    Prediction next = prediction;
    PlaneFromImage& plane = next.pattern_from_image;
    const FixedVec unit = unit_q30(turn_bam);
    plane.du_q24 = turned(plane.du_q24, unit);
    plane.dv_q24 = turned(plane.dv_q24, unit);
    const FixedVec pivot_q16 = plane_point_q16(prediction.pattern_from_image, pivot_q8);
    const FixedVec centre_q16 = pivot_q16 + turned(plane.at_centre_q16 - pivot_q16, unit) + by_q16;
    // Moves the origin to an intersection near the plane's centre. Otherwise, the coordinates would
    // grow with the distance that the camera has moved.
    next.place = moved(code, prediction.place, centre_q16.x >> 16, centre_q16.y >> 16);
    plane.at_centre_q16 = {centre_q16.x & 0xFFFF, centre_q16.y & 0xFFFF};
    return next;
}

const char* name(Prior prior) noexcept {
    switch (prior) {
        case Prior::sheets:
            return "sheets";
        case Prior::only_sheets:
            return "only_sheets";
        case Prior::plane:
            break;
    }
    return "plane";
}

const char* name(Surface surface) noexcept {
    switch (surface) {
        case Surface::even:
            return "even";
        case Surface::divided:
            return "divided";
        case Surface::uneven:
            return "uneven";
    }
    return "?";
}

const char* name(Attempt attempt) noexcept {
    switch (attempt) {
        case Attempt::tracked:
            return "tracked";
        case Attempt::first:
            return "first";
        case Attempt::second:
            return "second";
        case Attempt::device:
            return "device";
    }
    return "unknown";
}

}  // namespace dotpose
