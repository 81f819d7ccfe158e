// Sequences: the main sequence and the secondary sequences (paper, section II-A; US patent
// 6,667,695). Static assertions check the properties that decoding relies on. docs/position-code.md
// describes the variants of a4.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace dotpose::code {

template <std::size_t Length>
using Digits = std::array<std::uint8_t, Length>;

template <std::size_t Size>
consteval Digits<Size - 1> digits(const char (&text)[Size]) {
    Digits<Size - 1> result{};
    for (std::size_t i = 0; i + 1 < Size; ++i) {
        result[i] = static_cast<std::uint8_t>(text[i] - '0');
    }
    return result;
}

inline constexpr auto kMain =
    digits("000000100111110100100001110111001010100010110110011010111100011");
inline constexpr auto kA1 = digits(
    "00000100002010010100200011000120010200202011010110201201012021001110111102101021"
    "10012101120002102021110021201112020011210002201022001220202210121210212110221212"
    "0220222011221101222212002211212210222220212221112112012212201211112220021122");
inline constexpr auto kA2 = digits(
    "00000100002010010101100011110011010020001201012100021110111021001212101020110200"
    "10212000220011202002020120022110021011210202210022210122002122111112001221201112"
    "1120121112202201122221212201222020211221022021021102222010221222112120222");
inline constexpr auto kA3 = digits("0000010011000111100101011011101");
inline constexpr auto kA4Restored = digits(
    "00000102000020020100011200012002100021120101001210010022000221020110011101011012"
    "01111002020120220102101211011122001012220022201212020012201121021102021200110212"
    "10102202102211120211102222020221211112121222100212210112211211222212012212202221"
    "1");
inline constexpr auto kA4Published = digits(
    "00000102000020020100011200012002100021120101001210010022000221020110011101011012"
    "01111002020120220102101211011122001012220022201212020012201121021102021200110212"
    "10102202102211120211102222020221211112121222100212210112211212222120122122022211"
    "1");
inline constexpr auto kA4Microdots = digits(
    "00002222022210222002212022110221002200021220212102120021120211102110021000202202"
    "02102020020100200001222012210122001212012110121001200011220112101120011120111122"
    "22122211221112122121211211111011100110001022010210102001012020120101102011010100"
    "1");

// ---- Proofs, by enumeration at compile time -----------------------------------------------------

/// Returns the `length` digits that begin at `start`, as a number in base `base`. The sequence is
/// cyclic.
template <std::size_t Length>
constexpr unsigned key(const Digits<Length>& sequence, std::size_t start, int length,
                       unsigned base) {
    unsigned value = 0;
    for (int i = 0; i < length; ++i) {
        value = value * base + sequence[(start + static_cast<std::size_t>(i)) % Length];
    }
    return value;
}

/// Returns true if the cyclic sequence is quasi De Bruijn: all digits are less than `base`, and
/// every string of `order` digits occurs at most once.
template <std::size_t Length>
consteval bool is_quasi_de_bruijn(const Digits<Length>& sequence, int order, unsigned base) {
    constexpr std::size_t kMaxStrings = 2187;  // 7 digits in base 3
    std::array<bool, kMaxStrings> seen{};
    for (std::size_t i = 0; i < Length; ++i) {
        if (sequence[i] >= base) return false;
        bool& seen_before = seen[key(sequence, i, order, base)];
        if (seen_before) return false;
        seen_before = true;
    }
    return true;
}

/// Returns true if some string of `length` bits also occurs reversed and inverted. The sequence is
/// cyclic.
template <std::size_t Length>
consteval bool has_flipped_reverse(const Digits<Length>& sequence, std::size_t length) {
    for (std::size_t i = 0; i < Length; ++i) {
        for (std::size_t j = 0; j < Length; ++j) {
            bool same = true;
            for (std::size_t n = 0; n < length && same; ++n) {
                same = sequence[(i + n) % Length] != sequence[(j + length - 1 - n) % Length];
            }
            if (same) return true;
        }
    }
    return false;
}

static_assert(kMain.size() == 63, "the main sequence has 63 bits");
static_assert(is_quasi_de_bruijn(kMain, 6, 2), "6 bits determine a place in main");
static_assert(!has_flipped_reverse(kMain, 8),
              "8 bits of main determine whether main is upside down");
static_assert(!has_flipped_reverse(kMain, 7), "7 bits suffice; the paper asks for 8");
static_assert(has_flipped_reverse(kMain, 6),
              "6 bits do not suffice, so has_flipped_reverse can be true");

static_assert(kA1.size() == 236 && is_quasi_de_bruijn(kA1, 5, 3), "a1: order 5, length 236");
static_assert(kA2.size() == 233 && is_quasi_de_bruijn(kA2, 5, 3), "a2: order 5, length 233");
static_assert(kA3.size() == 31 && is_quasi_de_bruijn(kA3, 5, 2), "a3: order 5, length 31");
static_assert(kA4Restored.size() == 241 && is_quasi_de_bruijn(kA4Restored, 5, 3),
              "the restored a4: order 5, length 241");
static_assert(kA4Microdots.size() == 241 && is_quasi_de_bruijn(kA4Microdots, 5, 3),
              "py-microdots' a4: order 5, length 241");
static_assert(kA4Published.size() == 241 && !is_quasi_de_bruijn(kA4Published, 5, 3) &&
                  !is_quasi_de_bruijn(kA4Published, 6, 3) && is_quasi_de_bruijn(kA4Published, 7, 3),
              "the published a4 is misprinted: only 7 digits are unique");

static_assert(std::gcd(236, 233) == 1 && std::gcd(236, 31) == 1 && std::gcd(236, 241) == 1 &&
                  std::gcd(233, 31) == 1 && std::gcd(233, 241) == 1 && std::gcd(31, 241) == 1,
              "the lengths are pairwise coprime: four places give one position");

}  // namespace dotpose::code
