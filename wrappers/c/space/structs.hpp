// Helpers shared by the functions of dotpose_c_space: argument checks, and conversion of
// exceptions.
#pragma once

#include <cstddef>
#include <new>

#include "../locator.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/print_map.hpp"
#include "dotpose/image.hpp"
#include "dotpose_space.h"

namespace dotpose::c {

/// Returns OK if the `size` member equals the size of the struct. Each struct has only one version,
/// so no other size is valid.
template <typename Struct>
dotpose_status check_size(const Struct* given) {
    if (given == nullptr) return DOTPOSE_NULL_POINTER;
    return given->size == sizeof(Struct) ? DOTPOSE_OK : DOTPOSE_BAD_SIZE;
}

/// Zeroes a struct and sets its size.
template <typename Struct>
dotpose_status init(Struct* given, std::size_t bytes) {
    if (given == nullptr) return DOTPOSE_NULL_POINTER;
    if (bytes != sizeof(Struct)) return DOTPOSE_BAD_SIZE;
    *given = Struct{};
    given->size = sizeof(Struct);
    return DOTPOSE_OK;
}

/// Returns OK if the locator stores the dots of its last image. Reads the members of the locator
/// directly, because the shared library of dotpose_c hides its internal functions.
inline dotpose_status check_locator(const dotpose_locator* locator) {
    if (locator == nullptr) return DOTPOSE_NULL_POINTER;
    if (locator->mark != c::kLocatorMark) return DOTPOSE_NOT_INITIALIZED;
    const bool has_dots = locator->actions->locate_in_code != nullptr &&
                          locator->locator->trace().options.show_stages;
    return has_dots ? DOTPOSE_OK : DOTPOSE_WRONG_KIND;
}

/// Calls a function that returns a status, and converts exceptions to statuses.
template <typename Function>
dotpose_status without_exceptions(Function function) {
    try {
        return function();
    } catch (const std::bad_alloc&) {
        return DOTPOSE_OUT_OF_MEMORY;
    } catch (const Error&) {
        return DOTPOSE_BAD_VALUE;
    }
}

/// Implements dotpose_space_fit. `map` is the map of the page in view, or null.
dotpose_status fit_space(const dotpose_locator* locator, const dotpose_space_camera* camera,
                         const ImageView& image, const MapPage* map, dotpose_space_pose* pose);

}  // namespace dotpose::c
