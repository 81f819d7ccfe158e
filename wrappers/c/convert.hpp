// Conversions between the structs of dotpose.h and those of the core. Those towards the core check
// every value, since a C caller can pass anything.
#pragma once

#include <cstdint>
#include <cstring>

#include "dotpose.h"
#include "dotpose/fix.hpp"
#include "dotpose/locator_options.hpp"
#include "dotpose/prediction.hpp"

namespace dotpose::c {

/// Whether an integer is a value of an enumeration that begins at 0 and ends with `last`.
template <typename Enum>
constexpr bool is_one_of(std::int32_t value, Enum last) {
    return value >= 0 && value <= static_cast<std::int32_t>(last);
}

inline bool is_code(std::int32_t code) {
    return is_one_of(code, CodeVariant::microdots);
}

/// Returns a struct of options: the defaults, and over them as much as the caller's version has.
/// `first_bytes` is the size in the first version.
template <typename Options>
dotpose_status read_sized(const Options* given, std::size_t first_bytes, Options& options) {
    if (given == nullptr) return DOTPOSE_OK;
    const std::size_t bytes = given->size;
    if (bytes < first_bytes || bytes > sizeof options || bytes % 4 != 0) return DOTPOSE_BAD_SIZE;
    std::memcpy(&options, given, bytes);
    return DOTPOSE_OK;
}

/// Sets the defaults of a struct of options as far as the caller's version has members for them.
template <typename Options>
dotpose_status write_sized(Options defaults, std::size_t first_bytes, Options* options,
                           std::size_t bytes) {
    if (options == nullptr) return DOTPOSE_NULL_POINTER;
    if (bytes < first_bytes || bytes > sizeof defaults || bytes % 4 != 0) return DOTPOSE_BAD_SIZE;
    defaults.size = static_cast<std::uint32_t>(bytes);
    std::memcpy(options, &defaults, bytes);
    return DOTPOSE_OK;
}

/// Whether a time or a place of a tracker is so small that no difference of two overflows.
constexpr bool is_within_range(std::int64_t value, int bits) {
    return value >= -(std::int64_t{1} << bits) && value <= std::int64_t{1} << bits;
}

bool is_place(const dotpose_place& place);
Place to_core(const dotpose_place& place);

/// Reads options, or the defaults from null. BAD_ARGUMENT: one is outside of its range.
dotpose_status to_core(const dotpose_options* given, LocatorOptions& options);

/// Reads a prediction. BAD_VALUE: it names no place of the code.
dotpose_status to_core(const dotpose_prediction& given, Prediction& prediction);

/// Whether there is a fix that can be written and read: NULL_POINTER, BAD_SIZE.
dotpose_status check(const dotpose_fix* fix);

/// Reads a fix, whatever its status. Errors: those of `check`; BAD_VALUE if no function of this
/// library has written it.
dotpose_status to_core(const dotpose_fix* given, Fix& fix);
/// Reads a fix that must be ok, otherwise NO_FIX.
dotpose_status to_core_ok(const dotpose_fix* given, Fix& fix);

/// Whether a prediction can be moved without an overflow; those of fixes can.
bool can_move(const Prediction& prediction);

/// Writes a fix, whose size was checked.
void to_c(const Fix& fix, dotpose_fix& result);
void to_c(const Place& place, dotpose_place& result);
void to_c(const Prediction& prediction, dotpose_prediction& result);

/// Sets the result of a call that was misused, and returns its status.
dotpose_status refuse(dotpose_status status, dotpose_fix& result);

}  // namespace dotpose::c
