/// OptionFault: the option that causes Status::bad_argument, and its valid range.
#pragma once

#include <cstdint>

#include "dotpose/device_options.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// An option whose value is out of range.
struct OptionFault {
    /// Name of the option, such as "lattice.min_dots". Null if all options are in range.
    const char* name = nullptr;
    std::int32_t value = 0;
    std::int32_t low = 0;
    std::int32_t high = 0;
};

/// Returns the first option that is out of range and therefore causes Status::bad_argument.
OptionFault option_fault(const DeviceOptions& options) noexcept;

}  // namespace dotpose

DOTPOSE_END_EXPORT
