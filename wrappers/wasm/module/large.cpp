// Locators of large images, apart from the other kinds, which dotpose_locator_init would bring
// along.
#include "locator.hpp"

using Large = dotpose::c::LocatorOf<dotpose::LargeMemory, dotpose::Locator>;

extern "C" {

/// Returns how much memory a locator takes.
std::size_t dotpose_large_bytes() {
    return dotpose::c::bytes_of<Large>();
}

/// Makes a locator, as dotpose_locator_init does.
dotpose_status dotpose_large_init(void* memory, std::size_t bytes, const dotpose_options* options,
                                  dotpose_locator** locator) {
    return dotpose::c::init<Large>(memory, bytes, options, locator);
}

}  // extern "C"
