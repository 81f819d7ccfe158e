/// The deepest reach of the stack: it is painted at the start, and what lost its paint was used.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stack {

/// Lowest word of the stack and the word after the highest: from the linker script.
extern "C" std::uint32_t stack_bottom[], stack_top[];

inline constexpr std::uint32_t kPaint = 0x5AFEC0DE;

/// Paints what lies below the caller's frame. Call it first.
[[gnu::always_inline]] inline void paint() {
    // Some words are left for the function that paints.
    constexpr std::size_t kOwnWords = 16;
    auto* const end = static_cast<std::uint32_t*>(__builtin_frame_address(0)) - kOwnWords;
    for (volatile std::uint32_t* word = stack_bottom; word < end; ++word)
        *word = kPaint;
}

/// Most bytes that were in use at any time.
inline std::size_t high_water_bytes() {
    const volatile std::uint32_t* word = stack_bottom;
    while (word < stack_top && *word == kPaint)
        ++word;
    return static_cast<std::size_t>(stack_top - word) * sizeof *word;
}

/// Whether it may have reached below its end, into the variables.
inline bool has_overflown() {
    return *static_cast<volatile std::uint32_t*>(stack_bottom) != kPaint;
}

}  // namespace stack
