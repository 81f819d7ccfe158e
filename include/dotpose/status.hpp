/// Status: the result of a call, or the reason why the call failed. A frame without a fix is a
/// normal result.
#pragma once

#include <cstdint>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Result of a call. The comment on each value is its `message`. The numeric values never change,
/// because pose packets contain them. scripts/generate-fields copies names and messages to C, the
/// other languages and the documents.
enum class [[nodiscard]] Status : std::uint8_t{
    ok,  ///< located
    // Invalid arguments.
    bad_argument,     ///< an option is out of its range, or the image view has no pixels
    image_too_small,  ///< the image is too small to show 8 x 8 dots
    image_too_large,  ///< the image is larger than the memory supports
    // Set by src/core/detect.
    no_contrast,   ///< the image has no dark marks on a lighter background
    too_few_dots,  ///< too few dots
    // Set by src/core/lattice.
    no_grid,          ///< the dots do not form a regular grid
    no_displacement,  ///< the dots are on the grid intersections and carry no symbols
    // Set by src/core/decode.
    grid_too_small,  ///< fewer than 8 x 8 dots of one grid are in view
    // State before a frame is located.
    not_run,  ///< no frame has been located yet
    // Set by src/core/decode.
    mirrored,  ///< the pattern is mirrored
    // Set by src/code.
    bad_window,   ///< a window must have 6 to 32 columns and rows
    not_in_code,  ///< the position code does not contain the symbols
    ambiguous,    ///< the position code contains the symbols at several places
    // Set by src/core/integrity.
    not_certain,  ///< a position was found, but it may be wrong with more than the allowed
                  ///< probability
    // Set by src/device and src/locate.
    not_tracked,     ///< the pattern is not where it was predicted
    ambiguous_code,  ///< places of two codes explain the dots about equally well; name the code, or
                     ///< show more dots
    // Occurs only in packets that a newer version of dotpose has sent.
    other = 255,  ///< an unknown status, which a newer version of dotpose has added
};

/// Number of status values, excluding `other`.
inline constexpr int kStatusCount = static_cast<int>(Status::ambiguous_code) + 1;

/// Returns the identifier used in output lines, for example "too_few_dots". Returns "other" for
/// numbers that this version does not define.
const char* name(Status status) noexcept;

/// Returns a sentence that explains the status to the user, without a full stop. The sentence is
/// true for every frame with this status.
const char* message(Status status) noexcept;

}  // namespace dotpose

DOTPOSE_END_EXPORT
