// Framing: encodes a fixed number of arbitrary bytes as bytes without zeros (COBS), and appends a
// CRC. The CRC covers the encoded bytes. A CRC over the plain bytes would not always detect an
// error in a COBS code byte, because such an error shifts all following plain bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dotpose::link {

inline constexpr std::size_t kPlainBytes = 27;
/// Number of bytes after COBS encoding (Cheshire and Baker, 1999). COBS adds a single byte if there
/// are at most 254 plain bytes.
inline constexpr std::size_t kCodedBytes = kPlainBytes + 1;
/// Number of bytes that encode the CRC. Each of these bytes contains up to 7 bits of the CRC. The
/// top bit is set to make the byte nonzero.
inline constexpr std::size_t kCheckBytes = 3;
inline constexpr std::size_t kFramedBytes = kCodedBytes + kCheckBytes;

using Plain = std::array<std::uint8_t, kPlainBytes>;
using Framed = std::array<std::uint8_t, kFramedBytes>;

/// Returns the CRC-16 with the polynomial 0x5935 and the initial value 0xFFFF, most significant bit
/// first. The CRC detects all errors of up to 4 bits in up to 241 bits of data, and no 16-bit
/// polynomial detects more errors at this length (Koopman and Chakravarty, DSN 2004, where the
/// polynomial is written as 0xAC9A).
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

Framed frame(const Plain& plain);

/// Decodes framed bytes. Returns false if the CRC is wrong or the COBS encoding is invalid.
bool unframe(const Framed& framed, Plain& plain);

}  // namespace dotpose::link
