#include "convert.hpp"

#include <array>
#include <limits>

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

dotpose_plane to_c(const PlaneFromImage& p) {
    return {p.centre_q8.x,       p.centre_q8.y,       p.at_centre_q16.x, p.at_centre_q16.y,
            p.du_q24.x,          p.du_q24.y,          p.dv_q24.x,        p.dv_q24.y,
            p.perspective_q30.x, p.perspective_q30.y, p.lens_q40};
}

/// Writes the covariance with x and y in a given unit. `unit` is the length of a spacing in this
/// unit.
void set_covariance(const Fix& fix, double unit, float (&result)[9]) {
    const std::array<double, 3> factors{unit, unit, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result[3 * i + j] = static_cast<float>(factors[i] * factors[j] *
                                                   static_cast<double>(fix.covariance[i][j]));
        }
    }
}

/// Converts and assigns a member of one struct to the corresponding member of another struct.
template <typename From, typename To>
void assign(const From& from, To& to) {
    to = static_cast<To>(from);
}
void assign(const Place& from, dotpose_place& to) {
    c::to_c(from, to);
}
void assign(const dotpose_place& from, Place& to) {
    to = c::to_core(from);
}
void assign(const PlaneFromImage& from, dotpose_plane& to) {
    to = to_c(from);
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

void to_c(const Place& place, dotpose_place& result) {
    result = {place.cell.x, place.cell.y, place.section.u, place.section.v};
}

void to_c(const Fix& fix, dotpose_fix& result) {
    const bool is_ok = fix.status == Status::ok;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double mm = fix.spacing_mm();
    constexpr double spacings = 1;
    dotpose_fix all{};
    all.size = result.size;
#define FIX_STATUS(type, name, member, doc) assign(fix.member, all.name);
#define FIX_NUMBER(type, name, member, doc) assign(fix.member, all.name);
#define FIX_EVIDENCE(type, name, is_known, doc) assign(fix.name, all.name);
#define FIX_VALUE(type, name, value, none, doc) all.name = is_ok ? fix.value : none;
#define FIX_MATRIX(unit, name, doc) set_covariance(fix, unit, all.name);
#include "dotpose/fix_fields.def"
    std::memcpy(&result, &all, all.size);
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
