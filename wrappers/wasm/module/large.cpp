// Locators for large images. Replaces dotpose_locator_init, which would also link the other kinds
// of locators.
#include "locator.hpp"

using Large = dotpose::c::LocatorOf<dotpose::LargeMemory, dotpose::Locator>;

extern "C" {

/// Returns the number of bytes that a locator needs.
std::size_t dotpose_large_bytes() {
    return dotpose::c::bytes_of<Large>();
}

/// Sets up a locator, as dotpose_locator_init does.
dotpose_status dotpose_large_init(void* memory, std::size_t bytes, const dotpose_options* options,
                                  dotpose_locator** locator) {
    return dotpose::c::init<Large>(memory, bytes, options, locator);
}

}  // extern "C"
