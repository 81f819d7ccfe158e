// Words: loads adjacent pixels into one register, to process them in parallel. The first pixel is
// in the lowest byte.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace dotpose::core {

using Word = std::size_t;

constexpr Word in_all_bytes(std::uint8_t byte) {
    return static_cast<Word>(0x0101010101010101) * byte;
}

/// Mask of the top bit in every byte. Comparisons use only the upper seven bits of each grey level,
/// so the top bit is free for the result.
inline constexpr Word kTops = in_all_bytes(0x80);

/// Loads a word. `pixels` must be word-aligned.
inline Word word_at(const std::uint8_t* pixels) {
    Word word = 0;
    std::memcpy(&word, __builtin_assume_aligned(pixels, sizeof(Word)), sizeof word);
    if constexpr (std::endian::native == std::endian::big)
        word = sizeof word == 8 ? __builtin_bswap64(word) : __builtin_bswap32(word);
    return word;
}

}  // namespace dotpose::core
