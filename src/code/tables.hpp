// Tables: lookup tables that are computed from the sequences at compile time. Encoding uses the
// tables of rolls, and decoding uses the tables of places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "code/sequences.hpp"
#include "dotpose/code.hpp"

namespace dotpose::code {

/// Table entry for a digit string that does not occur in the sequence.
inline constexpr std::uint8_t kAbsent = 255;
/// Number of consecutive roll differences that determine a place in a secondary sequence. Each
/// difference contains one digit of the sequence. In the a4 of `libdots`, some strings of this
/// length occur twice (see `Secondary::has_twins`).
inline constexpr int kOrder = 5;

/// Padding of the tables beyond the end of a sequence, so that loops over adjacent lines need not
/// wrap around. kLinesAhead entries cover a view of 64 lines that begins at the last place. The
/// kVectorAhead entries after them cover a vector load that begins at the last line of such a view.
inline constexpr std::size_t kLinesAhead = 64;
inline constexpr std::size_t kVectorAhead = 32;

/// Returns n modulo 63 for n < 4095. Uses shifts instead of a division, which works because 64
/// modulo 63 is 1.
constexpr std::uint32_t short_modulo_sections(std::uint32_t n) {
    n = (n & 63) + (n >> 6);
    return n < kSections ? n : n - kSections;
}

/// Returns n modulo 63 for any n.
constexpr std::uint32_t modulo_sections(std::uint32_t n) {
    n = (n & 0xFFFFFF) + (n >> 24);
    n = (n & 0xFFF) + (n >> 12);
    return short_modulo_sections((n & 63) + (n >> 6));
}

/// A secondary sequence and its tables. Not a template, so that sequences of all lengths and bases
/// have the same type.
struct Secondary {
    /// Contribution of the sequence to the roll, indexed by place: the sum of all weighted digits
    /// before the place, modulo 63. The table contains kLinesAhead + kVectorAhead entries beyond
    /// the end of the sequence.
    const std::uint8_t* rolls;
    /// First place of each 5-digit string, or kAbsent if the string does not occur. The index is
    /// the `key` of the string.
    const std::uint8_t* first_place_of;
    /// For each digit, a bit set of the places at which the digit occurs. Place 0 is the lowest bit
    /// of the first word. The sequence is repeated to fill 256 + kLinesAhead bits.
    const std::uint32_t* const* places_of;
    std::uint32_t reciprocal;     ///< 2^20 / length, rounded down
    std::uint16_t rest_of_65536;  ///< 65536 modulo length
    std::uint8_t length;
    std::uint8_t period_roll;  ///< rolls[length] times the inverse of `length`, modulo 63
    std::uint8_t base;
    std::uint8_t weight;  ///< weight of the digits in a roll difference
    bool has_twins;       ///< true if some string of 5 digits occurs twice

    /// Returns the place of a position, which is `position` modulo `length`. Uses no division.
    constexpr std::uint32_t place_of(std::uint32_t position) const {
        // n is less than 2^24, so the product fits in 32 bits.
        const std::uint32_t n = (position >> 16) * rest_of_65536 + (position & 0xFFFF);
        std::uint32_t rest = n - ((n >> 8) * reciprocal >> 12) * length;
        while (rest >= length)
            rest -= length;
        return rest;
    }
    /// Returns the digit at a place below `length`. Computes the digit from `rolls`, so that
    /// devices need no flash memory for a separate table.
    constexpr std::uint8_t digit(std::uint32_t place) const {
        const int difference = rolls[place + 1] - rolls[place];
        const int weighted = difference < 0 ? difference + kSections : difference;
        return static_cast<std::uint8_t>((weighted >= weight ? 1 : 0) +
                                         (weighted > weight ? 1 : 0));
    }
    /// Compares the `count` digits that begin at `place` with the digits at each of 32 places. Bit
    /// i of the result is 1 if the `count` digits that begin at place 32 * word + i are the same.
    /// Indices wrap around. Bits beyond the end of the sequence are 0.
    constexpr std::uint32_t equal_places(std::uint32_t place, int count, std::uint32_t word) const {
        const std::uint32_t rest = length - 32 * word;
        std::uint32_t places = rest < 32 ? ~(~std::uint32_t{0} << rest) : ~std::uint32_t{0};
        for (int ahead = 0; ahead < count; ++ahead) {
            const std::uint32_t* here = places_of[digit(place)] + word;
            places &= here[0] >> ahead | here[1] << 1 << (31 - ahead);
            if (++place == length) place = 0;
        }
        return places;
    }
};

/// Returns the table `Secondary::rolls` of a sequence.
template <std::size_t Length>
consteval Digits<Length + kLinesAhead + kVectorAhead> rolls(const Digits<Length>& sequence,
                                                            int weight) {
    Digits<Length + kLinesAhead + kVectorAhead> result{};
    for (std::size_t i = 1; i < result.size(); ++i) {
        result[i] = static_cast<std::uint8_t>(
            (result[i - 1] + weight * sequence[(i - 1) % Length]) % kSections);
    }
    return result;
}

/// Returns the bit set of the places at which a digit occurs (see `Secondary::places_of`).
template <std::size_t Length>
consteval auto places_of(const Digits<Length>& sequence, int digit) {
    std::array<std::uint32_t, (256 + kLinesAhead) / 32> words{};
    for (std::size_t i = 0; i < 32 * words.size(); ++i) {
        if (sequence[i % Length] == digit) words[i / 32] |= std::uint32_t{1} << i % 32;
    }
    return words;
}

/// Returns `roll_of_period` times the inverse of `length`, modulo 63.
consteval std::uint8_t period_roll(std::size_t length, unsigned roll_of_period) {
    std::size_t inverse = 1;
    while (length * inverse % kSections != 1)
        ++inverse;
    return static_cast<std::uint8_t>(roll_of_period * inverse % kSections);
}

/// Returns the first place of each string with `Order` digits, or kAbsent if the string does not
/// occur. The index is the `key` of the string in base `Base`.
template <unsigned Base, int Order, std::size_t Length>
constexpr auto first_places(const Digits<Length>& sequence) {
    constexpr std::size_t kKeys = [] {
        std::size_t keys = 1;
        for (int i = 0; i < Order; ++i)
            keys *= Base;
        return keys;
    }();
    std::array<std::uint8_t, kKeys> places{};
    places.fill(kAbsent);
    for (std::size_t i = Length; i-- > 0;) {
        places[key(sequence, i, Order, Base)] = static_cast<std::uint8_t>(i);
    }
    return places;
}

template <unsigned Base, const auto& Sequence, std::uint8_t Weight>
struct Tables {
    static constexpr std::size_t kLength = Sequence.size();
    static constexpr auto kRolls = rolls(Sequence, Weight);
    static constexpr auto kPlaces = first_places<Base, kOrder>(Sequence);
    static constexpr auto kPlacesOf0 = places_of(Sequence, 0);
    static constexpr auto kPlacesOf1 = places_of(Sequence, 1);
    static constexpr auto kPlacesOf2 = places_of(Sequence, Base == 3 ? 2 : 1);
    static constexpr std::array<const std::uint32_t*, 3> kPlacesOf{
        kPlacesOf0.data(), kPlacesOf1.data(), kPlacesOf2.data()};
    static constexpr Secondary kSecondary{kRolls.data(),
                                          kPlaces.data(),
                                          kPlacesOf.data(),
                                          (1U << 20) / kLength,
                                          65536 % kLength,
                                          kLength,
                                          period_roll(kLength, kRolls[kLength]),
                                          Base,
                                          Weight,
                                          !is_quasi_de_bruijn(Sequence, kOrder, Base)};
};

using Basis = std::array<Secondary, 4>;

/// The four sequences of a code. A roll difference is d = 5 + a1 + 3 a2 + 9 a3 + 18 a4 (paper,
/// section II-A).
template <const auto& A4>
inline constexpr Basis kBasis{Tables<3, kA1, 1>::kSecondary, Tables<3, kA2, 3>::kSecondary,
                              Tables<2, kA3, 9>::kSecondary, Tables<3, A4, 18>::kSecondary};

inline constexpr int kMinDelta = 5;
inline constexpr int kMaxDelta = 58;

/// Digits of each roll difference from 5 to 58, two bits per digit. a1 is in the lowest bits.
inline constexpr auto kDigitsOfDelta = [] {
    std::array<std::uint8_t, kMaxDelta - kMinDelta + 1> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] =
            static_cast<std::uint8_t>(i % 3 | i / 3 % 3 << 2 | i / 9 % 2 << 4 | i / 18 << 6);
    }
    return result;
}();

/// Returns the digit of sequence a(n + 1) in a roll difference, for n = 0 to 3.
constexpr unsigned digit_of_delta(std::size_t delta, std::size_t n) {
    return kDigitsOfDelta[delta - kMinDelta] >> 2 * n & 3U;
}

/// The main sequence, repeated so that 256 bits can be read from any index below 63.
inline constexpr auto kMainRepeated = [] {
    std::array<std::uint8_t, kSections + 256> bits{};
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = kMain[i % kSections];
    return bits;
}();

/// For each index, the 32 bits of the main sequence that begin there. The first bit is the lowest
/// bit.
inline constexpr auto kMainWords = [] {
    std::array<std::uint32_t, kSections> words{};
    for (std::size_t i = 0; i < words.size(); ++i) {
        for (std::size_t bit = 0; bit < 32; ++bit)
            words[i] |= std::uint32_t{kMainRepeated[i + bit]} << bit;
    }
    return words;
}();

/// Returns the 64 bits of the main sequence that begin at `index`. The first bit is the lowest bit.
constexpr std::uint64_t main_bits(std::size_t index) {
    const std::size_t next = index + 32;
    return kMainWords[index] | std::uint64_t{kMainWords[next < kSections ? next : next - kSections]}
                                   << 32;
}

/// Number of consecutive bits that determine a place in the main sequence.
inline constexpr int kMainOrder = 6;
inline constexpr auto kPlaceInMain = first_places<2, kMainOrder>(kMain);

}  // namespace dotpose::code
