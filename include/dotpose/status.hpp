/// Status: why a call gave a result or why it did not. "No fix in this frame" is a normal value.
#pragma once

#include <cstdint>

#include "dotpose/language.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

enum class [[nodiscard]] Status : std::uint8_t{
    ok,
    // What the caller handed over.
    bad_argument,
    image_too_small,
    image_too_large,
    // src/core/detect
    no_contrast,
    too_few_dots,
    // src/core/lattice
    no_grid,
    no_displacement,
    // src/core/decode
    grid_too_small,
    // Before a frame is located. It stands here because pose packets carry the values.
    not_run,
    // src/core/decode
    mirrored,
    // src/code
    bad_window,
    not_in_code,
    ambiguous,
    // src/core/pose
    not_certain,
    // src/core/attempts
    not_tracked,
    ambiguous_code,
};

/// Number of values of Status, for tables.
inline constexpr int kStatusCount = 17;

/// The identifier of a status as written in output lines, for example "too_few_dots".
const char* name(Status status) noexcept;

/// One plain sentence for the user, without a full stop; it holds for every frame of this status.
const char* message(Status status) noexcept;

}  // namespace dotpose

#pragma GCC visibility pop
