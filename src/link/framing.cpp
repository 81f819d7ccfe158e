#include "link/framing.hpp"

namespace dotpose::link {
namespace {

using Check = std::array<std::uint8_t, kCheckBytes>;

Check check_of(std::span<const std::uint8_t> coded) {
    const unsigned crc = crc16(coded);
    const auto septet = [crc](int shift) {
        return static_cast<std::uint8_t>(0x80U | (crc >> shift & 0x7FU));
    };
    return {septet(14), septet(7), septet(0)};
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
    constexpr unsigned kPolynomial = 0x5935;
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= static_cast<unsigned>(byte) << 8;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc << 1) ^ ((crc & 0x8000U) != 0 ? kPolynomial : 0U);
        crc &= 0xFFFFU;
    }
    return static_cast<std::uint16_t>(crc);
}

Framed frame(const Plain& plain) {
    Framed framed{};
    // COBS replaces each zero with a code byte, which contains the distance to the next zero.
    std::size_t code_at = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (plain[i] != 0) {
            framed[i + 1] = plain[i];
            continue;
        }
        framed[code_at] = static_cast<std::uint8_t>(i + 1 - code_at);
        code_at = i + 1;
    }
    framed[code_at] = static_cast<std::uint8_t>(kCodedBytes - code_at);
    const Check check = check_of(std::span(framed).first<kCodedBytes>());
    for (std::size_t i = 0; i < check.size(); ++i)
        framed[kCodedBytes + i] = check[i];
    return framed;
}

bool unframe(const Framed& framed, Plain& plain) {
    const Check check = check_of(std::span(framed).first<kCodedBytes>());
    for (std::size_t i = 0; i < check.size(); ++i) {
        if (framed[kCodedBytes + i] != check[i]) return false;
    }
    std::size_t zero_at = framed[0];
    for (std::size_t i = 1; i < kCodedBytes; ++i) {
        const bool is_zero = i == zero_at;
        plain[i - 1] = is_zero ? std::uint8_t{0} : framed[i];
        if (is_zero) zero_at += framed[i];
    }
    return zero_at == kCodedBytes;
}

}  // namespace dotpose::link
