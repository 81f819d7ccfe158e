/// Reads numbers from the bytes of files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace dotpose::capture {

using Bytes = std::span<const std::uint8_t>;

/// Reads an unsigned integer of `size` bytes; `bytes` must be long enough.
inline std::uint64_t integer(Bytes bytes, std::size_t offset, std::size_t size, bool big_endian) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) {
        value = value << 8 | bytes[offset + (big_endian ? i : size - 1 - i)];
    }
    return value;
}

}  // namespace dotpose::capture
