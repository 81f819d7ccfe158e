// Initialisation of microcontroller locators. This code is in a separate file, so programs that use
// only microcontroller locators do not link the other kinds.
#include "locator.hpp"

namespace {

using namespace dotpose;

template <int Width, int Height, std::size_t Promised>
dotpose_status init(void* memory, std::size_t bytes, const dotpose_options* options,
                    dotpose_locator** locator) {
    using Device = c::LocatorOf<DeviceMemoryFor<Width, Height>, DeviceLocator>;
    static_assert(c::bytes_of<Device>() <= Promised,
                  "dotpose.h promises enough memory for a device");
    static_assert(Promised % 8 == 0);
    return c::init<Device>(memory, bytes, options, locator);
}

}  // namespace

extern "C" {

dotpose_status dotpose_device_init(void* memory, std::size_t bytes, const dotpose_options* options,
                                   dotpose_locator** locator) {
    return init<188, 120, DOTPOSE_DEVICE_BYTES>(memory, bytes, options, locator);
}

dotpose_status dotpose_device_36x36_init(void* memory, std::size_t bytes,
                                         const dotpose_options* options,
                                         dotpose_locator** locator) {
    return init<36, 36, DOTPOSE_DEVICE_36X36_BYTES>(memory, bytes, options, locator);
}

dotpose_status dotpose_device_160x120_init(void* memory, std::size_t bytes,
                                           const dotpose_options* options,
                                           dotpose_locator** locator) {
    return init<160, 120, DOTPOSE_DEVICE_160X120_BYTES>(memory, bytes, options, locator);
}

dotpose_status dotpose_device_320x240_init(void* memory, std::size_t bytes,
                                           const dotpose_options* options,
                                           dotpose_locator** locator) {
    return init<320, 240, DOTPOSE_DEVICE_320X240_BYTES>(memory, bytes, options, locator);
}
}
