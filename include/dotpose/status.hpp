/// Status: why a call gave a result or why it did not. A frame without a fix is a normal result.
#pragma once

#include <cstdint>

#include "dotpose/language.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// The result of a call; `message` gives a sentence for each value. Values keep their numbers.
enum class [[nodiscard]] Status : std::uint8_t{
    ok,
    // Faults of the arguments.
    bad_argument,
    image_too_small,
    image_too_large,
    // Found in src/core/detect.
    no_contrast,
    too_few_dots,
    // Found in src/core/lattice.
    no_grid,
    no_displacement,
    // Found in src/core/decode.
    grid_too_small,
    // State before a frame is located. It stands here because pose packets carry the numbers.
    not_run,
    // Found in src/core/decode.
    mirrored,
    // Found in src/code.
    bad_window,
    not_in_code,
    ambiguous,
    // Found in src/core/integrity.
    not_certain,
    // Found in src/device and src/locate.
    not_tracked,
    ambiguous_code,
};

/// Number of values of Status.
inline constexpr int kStatusCount = 17;

/// Returns the identifier of a status as written in output lines, for example "too_few_dots".
const char* name(Status status) noexcept;

/// Returns one plain sentence for the user, without a full stop, that holds for every frame of this
/// status.
const char* message(Status status) noexcept;

}  // namespace dotpose

#pragma GCC visibility pop
