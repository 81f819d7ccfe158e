// Stubs for the device attempts. JavaScript cannot select these attempts, so their code would only
// make the download larger. Without src/device/{attempt,tracked}.cpp, the linker also drops all
// code that only these sources call.
#include "device/attempt.hpp"
#include "device/tracked.hpp"

namespace dotpose::core {

const Fix& finish_device_attempt(const DeviceOptions&, DeviceWorkspace& w) {
    w.fix.status = Status::bad_argument;
    return w.fix;
}

Status begin_device_tracked(int, int, const DeviceOptions&, const Prediction&, DeviceWorkspace&) {
    return Status::not_tracked;
}

Status push_tracked_row(const std::uint8_t*, DeviceWorkspace&) {
    return Status::not_tracked;
}

const Fix& finish_device_tracked(const DeviceOptions& options, DeviceWorkspace& w) {
    return finish_device_attempt(options, w);
}

}  // namespace dotpose::core
