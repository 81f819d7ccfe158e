/// Measures the stack usage. `paint` fills the stack with a pattern at the start of the program.
/// Words that no longer contain the pattern have been used.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stack {

/// Lowest word of the stack, and the first word above it. Both are defined by the linker script.
extern "C" std::uint32_t stack_bottom[], stack_top[];

inline constexpr std::uint32_t kPaint = 0x5AFEC0DE;

/// Fills the unused stack below the caller's frame with `kPaint`. Must be called before
/// `high_water_bytes` and `has_overflown`.
[[gnu::always_inline]] inline void paint() {
    // Number of words below the frame address that are not filled, because they contain the
    // variables of this function.
    constexpr std::size_t kOwnWords = 16;
    auto* const end = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - kOwnWords;
    for (volatile std::uint32_t* word = stack_bottom; word < end; ++word)
        *word = kPaint;
}

/// Returns the maximum stack usage so far, in bytes.
inline std::size_t high_water_bytes() {
    const volatile std::uint32_t* word = stack_bottom;
    while (word < stack_top && *word == kPaint)
        ++word;
    return static_cast<std::size_t>(stack_top - word) * sizeof *word;
}

/// Returns true if the whole stack has been used, in which case it may have overflowed into the
/// memory below it.
inline bool has_overflown() {
    return *static_cast<volatile std::uint32_t*>(stack_bottom) != kPaint;
}

}  // namespace stack
