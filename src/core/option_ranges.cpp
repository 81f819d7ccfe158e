// Option ranges: reports the first option that is out of range.
#include "core/option_ranges.hpp"

#include "dotpose/option_fault.hpp"

namespace dotpose {

OptionFault option_fault(const DeviceOptions& options) noexcept {
    OptionFault fault;
    core::all_options(options, [&fault](const char* name, std::int32_t value, std::int32_t low,
                                        std::int32_t high) {
        if (value < low || value > high) fault = {name, value, low, high};
        return fault.name == nullptr;
    });
    return fault;
}

}  // namespace dotpose
