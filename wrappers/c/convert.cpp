#include "convert.hpp"

#include <array>
#include <limits>

namespace dotpose::c {
namespace {

Vec vec(std::int32_t x, std::int32_t y) {
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

/// Sets the covariance in mm and rad from that in spacings and rad.
void set_covariance(const Fix& fix, dotpose_fix& result) {
    const std::array<double, 3> factors{fix.spacing_mm(), fix.spacing_mm(), 1};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result.covariance_grid[3 * i + j] = fix.covariance[i][j];
            result.covariance[3 * i + j] = static_cast<float>(
                factors[i] * factors[j] * static_cast<double>(fix.covariance[i][j]));
        }
    }
}

}  // namespace

bool can_move(const Prediction& prediction) {
    const auto are_below = [](Vec v, int bits) {
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
    return DOTPOSE_OK;
}

dotpose_status to_core(const dotpose_fix& given, Fix& fix) {
    const dotpose_place read{given.cell_x, given.cell_y, given.section_u, given.section_v};
    if (!is_one_of(given.status, kStatusCount - 1) || !is_one_of(given.attempt, Attempt::device) ||
        !is_one_of(given.surface, Surface::uneven) || !is_place(read) || !is_place(given.place) ||
        given.fraction_x_q16 > UINT16_MAX || given.fraction_y_q16 > UINT16_MAX) {
        return DOTPOSE_BAD_VALUE;
    }
    fix.status = static_cast<Status>(given.status);
    fix.attempt = static_cast<Attempt>(given.attempt);
    fix.surface = static_cast<Surface>(given.surface);
    fix.cell = to_core(read).cell;
    fix.section = to_core(read).section;
    fix.fraction_x_q16 = static_cast<std::uint16_t>(given.fraction_x_q16);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(given.fraction_y_q16);
    fix.theta_bam = given.theta_bam;
    fix.spacing_px_q16 = given.spacing_px_q16;
    fix.spacing_nm = given.spacing_nm;
    fix.dots_seen = given.dots_seen;
    fix.dots_used = given.dots_used;
    fix.bit_errors = given.bit_errors;
    fix.p_wrong_log2 = given.p_wrong_log2;
    fix.residual_px = given.residual_px;
    fix.pattern_from_image = to_core(given.pattern_from_image);
    fix.place = to_core(given.place);
    fix.displacement_q16 = given.displacement_q16;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            fix.covariance[i][j] = given.covariance_grid[3 * i + j];
    }
    return DOTPOSE_OK;
}

dotpose_status to_core_ok(const dotpose_fix* given, Fix& fix) {
    if (given == nullptr) return DOTPOSE_NULL_POINTER;
    if (given->status != DOTPOSE_OK) return DOTPOSE_NO_FIX;
    return to_core(*given, fix);
}

void to_c(const Place& place, dotpose_place& result) {
    result = {place.cell.x, place.cell.y, place.section.u, place.section.v};
}

void to_c(const Fix& fix, dotpose_fix& result) {
    const bool is_ok = fix.status == Status::ok;
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    result.status = static_cast<dotpose_status>(fix.status);
    result.attempt = static_cast<std::int32_t>(fix.attempt);
    result.surface = static_cast<std::int32_t>(fix.surface);
    result.p_wrong_log2 = fix.p_wrong_log2;
    result.x_mm = is_ok ? fix.x_mm() : kNone;
    result.y_mm = is_ok ? fix.y_mm() : kNone;
    result.theta_rad = is_ok ? fix.theta_rad() : kNone;
    result.p_wrong = fix.p_wrong();
    set_covariance(fix, result);
    result.residual_px = fix.residual_px;
    result.section_u = fix.section.u;
    result.section_v = fix.section.v;
    result.dots_seen = fix.dots_seen;
    result.dots_used = fix.dots_used;
    result.bit_errors = fix.bit_errors;
    result.spacing_nm = fix.spacing_nm;
    result.cell_x = fix.cell.x;
    result.cell_y = fix.cell.y;
    result.fraction_x_q16 = fix.fraction_x_q16;
    result.fraction_y_q16 = fix.fraction_y_q16;
    result.theta_bam = fix.theta_bam;
    result.spacing_px_q16 = fix.spacing_px_q16;
    to_c(fix.place, result.place);
    result.pattern_from_image = to_c(fix.pattern_from_image);
    result.displacement_q16 = fix.displacement_q16;
    result.reserved = 0;
}

void to_c(const Prediction& prediction, dotpose_prediction& result) {
    result.pattern_from_image = to_c(prediction.pattern_from_image);
    to_c(prediction.place, result.place);
    result.displacement_q16 = prediction.displacement_q16;
    result.sigma_q16 = prediction.sigma_q16;
    result.sigma_theta_bam = prediction.sigma_theta_bam;
}

dotpose_status refuse(dotpose_status status, dotpose_fix& result) {
    to_c(Fix{}, result);
    result.status = status;
    return status;
}

}  // namespace dotpose::c
