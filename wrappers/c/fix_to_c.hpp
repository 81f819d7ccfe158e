// Conversion of a fix to dotpose_fix. The functions are inline, because dotpose_c_space also uses
// them and the shared library of dotpose_c hides its internal functions.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include "dotpose.h"
#include "dotpose/fix.hpp"

namespace dotpose::c {

inline void to_c(const Place& place, dotpose_place& result) {
    result = {place.cell.x, place.cell.y, place.section.u, place.section.v};
}

inline dotpose_plane to_c(const PlaneFromImage& p) {
    return {p.centre_q8.x,       p.centre_q8.y,       p.at_centre_q16.x, p.at_centre_q16.y,
            p.du_q24.x,          p.du_q24.y,          p.dv_q24.x,        p.dv_q24.y,
            p.perspective_q30.x, p.perspective_q30.y, p.lens_q40};
}

/// Writes the covariance, with x and y converted from spacings to another unit. `unit` is the
/// length of a spacing in this unit.
inline void set_covariance(const Fix& fix, double unit, float (&result)[9]) {
    const std::array<double, 3> factors{unit, unit, 1};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            result[3 * i + j] = static_cast<float>(factors[i] * factors[j] *
                                                   static_cast<double>(fix.covariance[i][j]));
        }
    }
}

/// Converts a member of one struct and assigns it to the corresponding member of another struct.
template <typename From, typename To>
void assign(const From& from, To& to) {
    to = static_cast<To>(from);
}
inline void assign(const Place& from, dotpose_place& to) {
    to_c(from, to);
}
inline void assign(const PlaneFromImage& from, dotpose_plane& to) {
    to = to_c(from);
}

/// Writes a fix. The caller must have checked the size of `result`.
inline void to_c(const Fix& fix, dotpose_fix& result) {
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

}  // namespace dotpose::c
