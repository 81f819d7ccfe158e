#include "dotpose/files/option_names.hpp"

#include <fmt/core.h>

#include "dotpose/option_fault.hpp"

namespace dotpose {

const char* name(Decoder decoder) {
    return decoder == Decoder::window ? "window" : "all";
}

const char* name(Effort effort) {
    switch (effort) {
        case Effort::device:
            return "device";
        case Effort::once:
            return "once";
        case Effort::twice:
            break;
    }
    return "twice";
}

std::string fault_text(const DeviceOptions& options) {
    const OptionFault fault = option_fault(options);
    if (fault.name == nullptr) return {};
    return fmt::format("the option {} is {}; it must be {} to {}", fault.name, fault.value,
                       fault.low, fault.high);
}

}  // namespace dotpose
