// Sets up locators of all kinds, in memory provided by the caller or in allocated memory.
#include <array>
#include <cstdlib>

#include "locator.hpp"

namespace {

using namespace dotpose;

struct Kind {
    std::size_t bytes;
    dotpose_status (*init)(void*, std::size_t, const dotpose_options*, dotpose_locator**);
};

template <typename Memory, typename LocatorType>
constexpr Kind kind_of() {
    using Made = c::LocatorOf<Memory, LocatorType>;
    return {c::bytes_of<Made>(), c::init<Made>};
}

/// Properties of the locator kinds, indexed by DOTPOSE_KIND_.
constexpr std::array<Kind, DOTPOSE_KIND_DEVICE_36X36 + 1> kKinds{
    kind_of<DeviceMemory, DeviceLocator>(),
    kind_of<SmallMemory, Locator>(),
    kind_of<LargeMemory, Locator>(),
    kind_of<DeviceMemoryFor<160, 120>, DeviceLocator>(),
    kind_of<DeviceMemoryFor<320, 240>, DeviceLocator>(),
    kind_of<DeviceMemoryFor<36, 36>, DeviceLocator>(),
};

const Kind* find_kind(std::int32_t kind) {
    return c::is_one_of(kind, DOTPOSE_KIND_DEVICE_36X36) ? &kKinds[static_cast<std::size_t>(kind)]
                                                         : nullptr;
}

}  // namespace

extern "C" {

size_t dotpose_locator_bytes(int32_t kind) {
    const Kind* found = find_kind(kind);
    return found == nullptr ? 0 : found->bytes;
}

dotpose_status dotpose_locator_init(void* memory, size_t bytes, int32_t kind,
                                    const dotpose_options* options, dotpose_locator** locator) {
    if (locator == nullptr) return DOTPOSE_NULL_POINTER;
    *locator = nullptr;
    const Kind* found = find_kind(kind);
    if (found == nullptr) return DOTPOSE_BAD_VALUE;
    return found->init(memory, bytes, options, locator);
}

dotpose_status dotpose_locator_create(int32_t kind, const dotpose_options* options,
                                      dotpose_locator** locator) {
    if (locator == nullptr) return DOTPOSE_NULL_POINTER;
    *locator = nullptr;
    const std::size_t bytes = dotpose_locator_bytes(kind);
    if (bytes == 0) return DOTPOSE_BAD_VALUE;
    void* memory = std::malloc(bytes);
    if (memory == nullptr) return DOTPOSE_OUT_OF_MEMORY;
    const dotpose_status status = dotpose_locator_init(memory, bytes, kind, options, locator);
    if (status == DOTPOSE_OK) {
        (*locator)->allocation = memory;
    } else {
        std::free(memory);
    }
    return status;
}

void dotpose_locator_destroy(dotpose_locator* locator) {
    if (locator == nullptr || locator->mark != c::kLocatorMark) return;
    locator->mark = 0;
    std::free(locator->allocation);
}
}
