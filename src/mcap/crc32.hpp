// CRC-32 according to ISO 3309, the checksum used by MCAP, zlib and PNG.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dotpose::mcap {

namespace crc_detail {

constexpr std::array<std::uint32_t, 256> table() {
    constexpr std::uint32_t kPolynomial = 0xEDB88320;  // bit-reversed
    std::array<std::uint32_t, 256> result{};
    for (std::uint32_t i = 0; i < result.size(); ++i) {
        std::uint32_t remainder = i;
        for (int bit = 0; bit < 8; ++bit)
            remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? kPolynomial : 0);
        result[i] = remainder;
    }
    return result;
}

inline constexpr std::array<std::uint32_t, 256> kTable = table();

}  // namespace crc_detail

/// Computes a checksum incrementally.
class Crc32 {
  public:
    void add(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes)
            state_ = (state_ >> 8) ^ crc_detail::kTable[(state_ ^ byte) & 0xFF];
    }
    std::uint32_t value() const { return ~state_; }

  private:
    std::uint32_t state_ = 0xFFFFFFFF;
};

inline std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    Crc32 crc;
    crc.add(bytes);
    return crc.value();
}

}  // namespace dotpose::mcap
