// Framing: a fixed number of any bytes -> bytes without zeros, protected by a CRC. The coded bytes
// are what the CRC protects, not the plain ones: an error in a code byte of COBS would shift all
// that follows, and no CRC of the plain bytes is sure to notice that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dotpose::link {

inline constexpr std::size_t kPlainBytes = 27;
/// COBS (Cheshire and Baker, 1999) adds one byte to up to 254.
inline constexpr std::size_t kCodedBytes = kPlainBytes + 1;
/// The CRC, 7 bits in a byte, so that none is zero.
inline constexpr std::size_t kCheckBytes = 3;
inline constexpr std::size_t kFramedBytes = kCodedBytes + kCheckBytes;

using Plain = std::array<std::uint8_t, kPlainBytes>;
using Framed = std::array<std::uint8_t, kFramedBytes>;

/// CRC-16 with the polynomial 0x5935, initial value 0xFFFF, most significant bit first. Among
/// 16-bit polynomials it notices the most errors at our length: all of up to 4 bits in up to 241
/// bits of data (Koopman and Chakravarty, DSN 2004, as 0xAC9A).
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

Framed frame(const Plain& plain);

/// False if the bytes are not what `frame` makes of any plain bytes.
bool unframe(const Framed& framed, Plain& plain);

}  // namespace dotpose::link
