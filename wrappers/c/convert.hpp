// Conversions between the structs of dotpose.h and the types of the core. Conversions to the core
// check every value, because a C caller can pass any value.
#pragma once

#include <cstdint>
#include <cstring>

#include "dotpose.h"
#include "dotpose/fix.hpp"
#include "dotpose/locator_options.hpp"
#include "dotpose/measured_motion.hpp"
#include "dotpose/prediction.hpp"
#include "fix_to_c.hpp"

namespace dotpose::c {

/// Returns true if an integer is a valid value of an enumeration with values from 0 to `last`.
template <typename Enum>
constexpr bool is_one_of(std::int32_t value, Enum last) {
    return value >= 0 && value <= static_cast<std::int32_t>(last);
}

inline bool is_code(std::int32_t code) {
    return is_one_of(code, CodeVariant::microdots);
}

/// Copies the members of `given` to `options`, which must contain the defaults. Copies only the
/// members that exist in the caller's version of the struct. If `given` is null, keeps all
/// defaults. `first_bytes` is the size of the first version of the struct. Returns BAD_SIZE if the
/// size of `given` matches no version.
template <typename DeviceOptions>
dotpose_status read_sized(const DeviceOptions* given, std::size_t first_bytes,
                          DeviceOptions& options) {
    if (given == nullptr) return DOTPOSE_OK;
    const std::size_t bytes = given->size;
    if (bytes < first_bytes || bytes > sizeof options || bytes % 4 != 0) return DOTPOSE_BAD_SIZE;
    std::memcpy(&options, given, bytes);
    return DOTPOSE_OK;
}

/// Writes the default options, but only the members that exist in the caller's version of the
/// struct.
template <typename DeviceOptions>
dotpose_status write_sized(DeviceOptions defaults, std::size_t first_bytes, DeviceOptions* options,
                           std::size_t bytes) {
    if (options == nullptr) return DOTPOSE_NULL_POINTER;
    if (bytes < first_bytes || bytes > sizeof defaults || bytes % 4 != 0) return DOTPOSE_BAD_SIZE;
    defaults.size = static_cast<std::uint32_t>(bytes);
    std::memcpy(options, &defaults, bytes);
    return DOTPOSE_OK;
}

/// Returns true if the absolute value is at most 2^bits. Callers choose `bits` such that
/// differences of two times or two coordinates do not overflow.
constexpr bool is_within_range(std::int64_t value, int bits) {
    return value >= -(std::int64_t{1} << bits) && value <= std::int64_t{1} << bits;
}

bool is_place(const dotpose_place& place);
Place to_core(const dotpose_place& place);

/// Reads options. If `given` is null, uses the defaults. Returns BAD_ARGUMENT if an option is out
/// of range.
dotpose_status to_core(const dotpose_options* given, LocatorOptions& options);

/// Reads a motion. Returns BAD_VALUE if `MeasuredMotion::is_usable` is false.
dotpose_status to_core(const dotpose_measured_motion& given, MeasuredMotion& motion);

/// Reads a prediction. Returns BAD_VALUE if the code does not contain the predicted place.
dotpose_status to_core(const dotpose_prediction& given, Prediction& prediction);

/// Returns OK if `fix` can be read and written, and otherwise NULL_POINTER or BAD_SIZE.
dotpose_status check(const dotpose_fix* fix);

/// Reads a fix with any status. Returns the errors of `check`, or BAD_VALUE if the fix was not
/// written by this library.
dotpose_status to_core(const dotpose_fix* given, Fix& fix);
/// Reads a fix. Returns NO_FIX if the status of the fix is not ok.
dotpose_status to_core_ok(const dotpose_fix* given, Fix& fix);

/// Returns true if the prediction can be moved without overflow. This is true for all predictions
/// made from fixes.
bool can_move(const Prediction& prediction);

void to_c(const Prediction& prediction, dotpose_prediction& result);

/// Sets `result` to a fix without a pose. `status` describes the misuse. Returns `status`.
dotpose_status refuse(dotpose_status status, dotpose_fix& result);

}  // namespace dotpose::c
