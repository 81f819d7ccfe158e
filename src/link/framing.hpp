// Encodes a fixed number of arbitrary bytes as bytes without zeros, and appends a CRC. The CRC is
// computed from the encoded bytes, because an error in a code byte of COBS shifts all following
// bytes, and a CRC of the plain bytes would not always detect such an error.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dotpose::link {

inline constexpr std::size_t kPlainBytes = 27;
/// Number of bytes after COBS encoding (Cheshire and Baker, 1999). COBS adds one byte to up to 254
/// bytes.
inline constexpr std::size_t kCodedBytes = kPlainBytes + 1;
/// Number of bytes of the CRC. Each byte contains at most 7 bits of the CRC, and its top bit is
/// set, so it is never zero.
inline constexpr std::size_t kCheckBytes = 3;
inline constexpr std::size_t kFramedBytes = kCodedBytes + kCheckBytes;

using Plain = std::array<std::uint8_t, kPlainBytes>;
using Framed = std::array<std::uint8_t, kFramedBytes>;

/// Returns the CRC-16 with the polynomial 0x5935 and the initial value 0xFFFF, most significant bit
/// first. At this length, this polynomial detects the most errors of all 16-bit polynomials: all
/// errors of up to 4 bits in up to 241 bits of data (Koopman and Chakravarty, DSN 2004). Their
/// notation for it is 0xAC9A.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

Framed frame(const Plain& plain);

/// Decodes framed bytes. Returns false if the bytes are not a result of `frame`.
bool unframe(const Framed& framed, Plain& plain);

}  // namespace dotpose::link
