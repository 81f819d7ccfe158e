// Locators of microcontrollers, apart from the others: a program that makes only these contains
// nothing else.
#include "locator.hpp"

using Device = dotpose::c::LocatorOf<dotpose::DeviceMemory, dotpose::DeviceLocator>;
static_assert(dotpose::c::bytes_of<Device>() <= DOTPOSE_DEVICE_BYTES,
              "dotpose.h promises enough memory for a device");
static_assert(DOTPOSE_DEVICE_BYTES % 8 == 0);

extern "C" dotpose_status dotpose_device_init(void* memory, std::size_t bytes,
                                              const dotpose_options* options,
                                              dotpose_locator** locator) {
    return dotpose::c::init<Device>(memory, bytes, options, locator);
}
