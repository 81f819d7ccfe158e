// Small objects stored in structs of dotpose.h: trackers, packet readers and pacers.
#pragma once

#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>

#include "dotpose.h"

namespace dotpose::c {

/// A T stored in a struct of dotpose.h. `mark` precedes the T and equals kMark if the struct was
/// set up.
template <typename T, std::uint32_t kMark>
struct Object {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>,
                  "dotpose.h allows to copy and to give up these structs");

    std::uint32_t mark = kMark;
    T value;

    /// Creates the object in the memory of a struct. `place` must not be null.
    template <typename Struct, typename... Arguments>
    static void make(Struct* place, const Arguments&... arguments) {
        static_assert(sizeof(Object) <= sizeof(Struct), "the struct in dotpose.h is too small");
        static_assert(alignof(Object) <= alignof(Struct));
        ::new (static_cast<void*>(place)) Object{kMark, T(arguments...)};
    }

    /// Returns the object in a struct. Returns NOT_INITIALIZED if the struct was not set up.
    template <typename Struct>
    static dotpose_status find(const Struct* place, const T*& found) {
        if (place == nullptr) return DOTPOSE_NULL_POINTER;
        std::uint32_t mark_found = 0;
        std::memcpy(&mark_found, place, sizeof mark_found);
        if (mark_found != kMark) return DOTPOSE_NOT_INITIALIZED;
        found = &std::launder(reinterpret_cast<const Object*>(place))->value;
        return DOTPOSE_OK;
    }
    template <typename Struct>
    static dotpose_status find(Struct* place, T*& found) {
        const T* constant = nullptr;
        const dotpose_status status = find(place, constant);
        found = const_cast<T*>(constant);
        return status;
    }
};

}  // namespace dotpose::c
