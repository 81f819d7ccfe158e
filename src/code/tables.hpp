// Lookup tables made from the sequences at compile time: rolls for O(1) encoding, and the place of
// every string for decoding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "code/sequences.hpp"
#include "dotpose/code.hpp"

namespace dotpose::code {

/// No such string in the sequence.
inline constexpr std::uint8_t kAbsent = 255;
/// Differences (one digit each) that it takes to look up a place.
inline constexpr int kOrder = 5;

/// Lines beyond its end to which a sequence's rolls are continued.
inline constexpr std::size_t kLinesAhead = 64;
inline constexpr std::size_t kVectorAhead = 32;

/// n modulo 63 without a division, which small processors lack: 64 leaves 1. For n < 4095.
constexpr std::uint32_t few_modulo_sections(std::uint32_t n) {
    n = (n & 63) + (n >> 6);
    return n < kSections ? n : n - kSections;
}

/// The same of any number.
constexpr std::uint32_t modulo_sections(std::uint32_t n) {
    n = (n & 0xFFFFFF) + (n >> 24);
    n = (n & 0xFFF) + (n >> 12);
    return few_modulo_sections((n & 63) + (n >> 6));
}

/// A secondary number sequence in a form that code of one type can walk.
struct Secondary {
    const std::uint8_t* digits;  ///< `length` of them
    /// By line, from place 0 on: what the digits before it add to the roll, modulo 63. Beyond the
    /// end of the sequence it goes on for `kLinesAhead` lines, and for a vector that begins within.
    const std::uint8_t* rolls;
    const std::uint8_t* first_place_of;  ///< by the key of 5 digits; kAbsent where there is none
    /// By digit: a bit for each place, whether it stands there, from the lowest bit on. Beyond the
    /// end of the sequence it goes on: for 256 bits from each of `kLinesAhead` places on.
    const std::uint32_t* const* places_of;
    std::uint32_t reciprocal;     ///< 2^20 / length
    std::uint16_t rest_of_65536;  ///< modulo length
    std::uint8_t length;
    std::uint8_t turn_roll;  ///< per line, on whole turns: see `roll`
    std::uint8_t base;
    std::uint8_t weight;  ///< in the basis equation of section II-A
    bool has_twins;       ///< whether some string of 5 digits stands twice

    /// The place of a position: that modulo `length`, without a division.
    constexpr std::uint32_t place_of(std::uint32_t position) const {
        // Less than 2^24.
        const std::uint32_t n = (position >> 16) * rest_of_65536 + (position & 0xFFFF);
        std::uint32_t rest = n - ((n >> 8) * reciprocal >> 12) * length;
        while (rest >= length)
            rest -= length;
        return rest;
    }
};

/// See Secondary::rolls.
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

/// See Secondary::places_of.
template <std::size_t Length>
consteval auto places_of(const Digits<Length>& sequence, int digit) {
    std::array<std::uint32_t, (256 + kLinesAhead) / 32> words{};
    for (std::size_t i = 0; i < 32 * words.size(); ++i) {
        if (sequence[i % Length] == digit) words[i / 32] |= std::uint32_t{1} << i % 32;
    }
    return words;
}

/// The roll that a turn of a sequence adds, divided by the turn's length, modulo 63.
consteval std::uint8_t turn_roll(std::size_t length, unsigned roll_of_turn) {
    std::size_t inverse = 1;
    while (length * inverse % kSections != 1)
        ++inverse;
    return static_cast<std::uint8_t>(roll_of_turn * inverse % kSections);
}

/// First place of each string of `Order` digits, by its key.
template <unsigned Base, int Order, std::size_t Length>
consteval auto first_places(const Digits<Length>& sequence) {
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

/// For each place the next one, cyclic, at which the same `Order` digits stand; itself if none
/// does.
template <unsigned Base, int Order, std::size_t Length>
consteval Digits<Length> next_twins(const Digits<Length>& sequence) {
    Digits<Length> twins{};
    for (std::size_t i = 0; i < Length; ++i) {
        std::size_t j = (i + 1) % Length;
        while (key(sequence, j, Order, Base) != key(sequence, i, Order, Base))
            j = (j + 1) % Length;
        twins[i] = static_cast<std::uint8_t>(j);
    }
    return twins;
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
    static constexpr Secondary kSecondary{Sequence.data(),
                                          kRolls.data(),
                                          kPlaces.data(),
                                          kPlacesOf.data(),
                                          (1U << 20) / kLength,
                                          65536 % kLength,
                                          kLength,
                                          turn_roll(kLength, kRolls[kLength]),
                                          Base,
                                          Weight,
                                          !is_quasi_de_bruijn(Sequence, kOrder, Base)};
};

using Basis = std::array<Secondary, 4>;

/// d = 5 + a1 + 3 a2 + 9 a3 + 18 a4 (section II-A).
template <const auto& A4>
inline constexpr Basis kBasis{Tables<3, kA1, 1>::kSecondary, Tables<3, kA2, 3>::kSecondary,
                              Tables<2, kA3, 9>::kSecondary, Tables<3, A4, 18>::kSecondary};

/// By sequence and place: the next with the same 3 digits, and with the same 4 digits, each in a
/// cycle.
using Twins = std::array<std::array<const std::uint8_t*, 2>, 4>;

template <unsigned Base, const auto& Sequence>
struct TwinTables {
    static constexpr auto kOf3 = next_twins<Base, 3>(Sequence);
    static constexpr auto kOf4 = next_twins<Base, 4>(Sequence);
    static constexpr std::array<const std::uint8_t*, 2> kBoth{kOf3.data(), kOf4.data()};
};

template <const auto& A4>
inline constexpr Twins kTwins{TwinTables<3, kA1>::kBoth, TwinTables<3, kA2>::kBoth,
                              TwinTables<2, kA3>::kBoth, TwinTables<3, A4>::kBoth};

inline constexpr int kSmallestDelta = 5;
inline constexpr int kLargestDelta = 58;

/// Digits a1..a4 of each difference, from 5 to 58.
inline constexpr auto kDigitsOfDelta = [] {
    std::array<std::array<std::uint8_t, 4>, kLargestDelta - kSmallestDelta + 1> result{};
    for (int i = 0; i < static_cast<int>(result.size()); ++i) {
        result[static_cast<std::size_t>(i)] = {
            static_cast<std::uint8_t>(i % 3), static_cast<std::uint8_t>(i / 3 % 3),
            static_cast<std::uint8_t>(i / 9 % 2), static_cast<std::uint8_t>(i / 18)};
    }
    return result;
}();

/// The main sequence from any index on, 256 bits long.
inline constexpr auto kMainRepeated = [] {
    std::array<std::uint8_t, kSections + 256> bits{};
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = kMain[i % kSections];
    return bits;
}();

/// 32 bits of the main sequence from any index on, the first in the lowest bit.
inline constexpr auto kMainWords = [] {
    std::array<std::uint32_t, kSections> words{};
    for (std::size_t i = 0; i < words.size(); ++i) {
        for (std::size_t bit = 0; bit < 32; ++bit)
            words[i] |= std::uint32_t{kMainRepeated[i + bit]} << bit;
    }
    return words;
}();

/// Bits of the main sequence that tell the place in it.
inline constexpr int kMainOrder = 6;
inline constexpr auto kPlaceInMain = first_places<2, kMainOrder>(kMain);

}  // namespace dotpose::code
