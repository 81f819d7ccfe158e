#include "convert.hpp"

namespace dotpose::c {
namespace {

FixedVec vec(std::int32_t x, std::int32_t y) {
    return {x, y};
}

PlaneFromImage to_core(const dotpose_plane& p) {
    return {.centre_q8 = vec(p.centre_u_q8, p.centre_v_q8),
            .at_centre_q16 = vec(p.at_centre_x_q16, p.at_centre_y_q16),
            .du_q24 = vec(p.du_x_q24, p.du_y_q24),
            .dv_q24 = vec(p.dv_x_q24, p.dv_y_q24),
            .perspective_q30 = vec(p.perspective_u_q30, p.perspective_v_q30),
            .lens_q40 = p.lens_q40};
}

void assign(const dotpose_place& from, Place& to) {
    to = c::to_core(from);
}
void assign(const dotpose_plane& from, PlaneFromImage& to) {
    to = to_core(from);
}

constexpr std::size_t kFirstFixBytes = 256;  ///< size of a fix in version 1 of the struct

bool is_size_of_fix(std::size_t bytes) {
    return bytes >= kFirstFixBytes && bytes <= sizeof(dotpose_fix) && bytes % 8 == 0;
}

}  // namespace

bool can_move(const Prediction& prediction) {
    const auto are_below = [](FixedVec v, int bits) {
        return is_within_range(v.x, bits) && is_within_range(v.y, bits);
    };
    const PlaneFromImage& plane = prediction.pattern_from_image;
    return are_below(plane.centre_q8, 21) && are_below(plane.at_centre_q16, 28) &&
           are_below(plane.du_q24, 22) && are_below(plane.dv_q24, 22) &&
           are_below(plane.perspective_q30, 24);
}

bool is_place(const dotpose_place& place) {
    return place.x < kPositionsPerAxis && place.y < kPositionsPerAxis &&
           place.u < std::uint32_t{kSections} && place.v < std::uint32_t{kSections};
}

dotpose_status to_core(const dotpose_measured_motion& given, MeasuredMotion& motion) {
    motion = {.right_mm = given.right_mm,
              .down_mm = given.down_mm,
              .turn_rad = given.turn_rad,
              .sigma_mm = given.sigma_mm,
              .sigma_rad = given.sigma_rad};
    return motion.is_usable() ? DOTPOSE_OK : DOTPOSE_BAD_VALUE;
}

Place to_core(const dotpose_place& place) {
    return {{place.x, place.y},
            {static_cast<std::uint8_t>(place.u), static_cast<std::uint8_t>(place.v)}};
}

dotpose_status to_core(const dotpose_prediction& given, Prediction& prediction) {
    if (!is_place(given.place)) return DOTPOSE_BAD_VALUE;
    prediction.pattern_from_image = to_core(given.pattern_from_image);
    prediction.place = to_core(given.place);
    prediction.displacement_q16 = given.displacement_q16;
    prediction.sigma_q16 = given.sigma_q16;
    prediction.sigma_theta_bam = given.sigma_theta_bam;
    prediction.readout_turn_rad = given.readout_turn_rad;
    return DOTPOSE_OK;
}

dotpose_status check(const dotpose_fix* fix) {
    if (fix == nullptr) return DOTPOSE_NULL_POINTER;
    return is_size_of_fix(fix->size) ? DOTPOSE_OK : DOTPOSE_BAD_SIZE;
}

dotpose_status to_core(const dotpose_fix* read, Fix& fix) {
    const dotpose_status status = check(read);
    if (status != DOTPOSE_OK) return status;
    dotpose_fix given{};
    std::memcpy(&given, read, read->size);
    const dotpose_place place{given.cell_x, given.cell_y, given.section_u, given.section_v};
    if (!is_one_of(given.status, kStatusCount - 1) || !is_one_of(given.attempt, Attempt::device) ||
        !is_one_of(given.surface, Surface::uneven) || !is_one_of(given.prior, Prior::only_sheets) ||
        !is_place(place) || !is_place(given.place) || given.fraction_x_q16 > UINT16_MAX ||
        given.fraction_y_q16 > UINT16_MAX) {
        return DOTPOSE_BAD_VALUE;
    }
#define FIX_STATUS(type, name, member, doc) assign(given.name, fix.member);
#define FIX_NUMBER(type, name, member, doc) assign(given.name, fix.member);
#define FIX_EVIDENCE(type, name, is_known, doc) assign(given.name, fix.name);
#include "dotpose/fix_fields.def"
    for (std::size_t i = 0; i < 9; ++i)
        fix.covariance[i / 3][i % 3] = given.covariance_grid[i];
    return DOTPOSE_OK;
}

dotpose_status to_core_ok(const dotpose_fix* given, Fix& fix) {
    const dotpose_status status = check(given);
    if (status != DOTPOSE_OK) return status;
    if (given->status != DOTPOSE_OK) return DOTPOSE_NO_FIX;
    return to_core(given, fix);
}

void to_c(const Prediction& prediction, dotpose_prediction& result) {
    result.pattern_from_image = to_c(prediction.pattern_from_image);
    to_c(prediction.place, result.place);
    result.displacement_q16 = prediction.displacement_q16;
    result.sigma_q16 = prediction.sigma_q16;
    result.sigma_theta_bam = prediction.sigma_theta_bam;
    result.readout_turn_rad = prediction.readout_turn_rad;
}

dotpose_status refuse(dotpose_status status, dotpose_fix& result) {
    to_c(Fix{}, result);
    result.status = status;
    return status;
}

}  // namespace dotpose::c

extern "C" dotpose_status dotpose_fix_init(dotpose_fix* fix, std::size_t bytes) {
    using namespace dotpose;
    if (fix == nullptr) return DOTPOSE_NULL_POINTER;
    if (!c::is_size_of_fix(bytes)) return DOTPOSE_BAD_SIZE;
    fix->size = static_cast<std::uint32_t>(bytes);
    c::to_c(Fix{}, *fix);
    return DOTPOSE_OK;
}
