// Lookup tables made from the sequences at compile time: prefix sums for O(1) encoding, and the
// place of every string for decoding.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "code/sequences.hpp"

namespace dotpose::code {

/// No such string in the sequence.
inline constexpr std::uint8_t kAbsent = 255;
/// Differences (one digit each) that it takes to look up a place.
inline constexpr int kOrder = 5;

/// A secondary number sequence in a form that code of one type can walk.
struct Secondary {
    const std::uint8_t* digits;          ///< `length` of them
    const std::uint16_t* prefix_sums;    ///< length + 1: sum of the first i digits
    const std::uint8_t* first_place_of;  ///< by the key of 5 digits; kAbsent where there is none
    /// By place: the next with the same 3 digits, and with the same 4 digits, each in a cycle.
    std::array<const std::uint8_t*, 2> next_twins;
    std::uint16_t length;
    std::uint8_t base;
    std::uint8_t weight;  ///< in the basis equation of section II-A
    bool has_twins;       ///< whether some string of 5 digits stands twice
};

template <std::size_t Length>
consteval std::array<std::uint16_t, Length + 1> prefix_sums(const Digits<Length>& sequence) {
    std::array<std::uint16_t, Length + 1> sums{};
    for (std::size_t i = 0; i < Length; ++i) {
        sums[i + 1] = static_cast<std::uint16_t>(sums[i] + sequence[i]);
    }
    return sums;
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

template <unsigned Base, const auto& Sequence>
struct Tables {
    static constexpr auto kSums = prefix_sums(Sequence);
    static constexpr auto kPlaces = first_places<Base, kOrder>(Sequence);
    static constexpr auto kTwinsOf3 = next_twins<Base, 3>(Sequence);
    static constexpr auto kTwinsOf4 = next_twins<Base, 4>(Sequence);
    static constexpr Secondary make(std::uint8_t weight) {
        return {Sequence.data(), kSums.data(),
                kPlaces.data(),  {kTwinsOf3.data(), kTwinsOf4.data()},
                Sequence.size(), Base,
                weight,          !is_quasi_de_bruijn(Sequence, kOrder, Base)};
    }
};

using Basis = std::array<Secondary, 4>;

/// d = 5 + a1 + 3 a2 + 9 a3 + 18 a4 (section II-A).
template <const auto& A4>
inline constexpr Basis kBasis{Tables<3, kA1>::make(1), Tables<3, kA2>::make(3),
                              Tables<2, kA3>::make(9), Tables<3, A4>::make(18)};

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

/// Bits of the main sequence that tell the place in it.
inline constexpr int kMainOrder = 6;
inline constexpr auto kPlaceInMain = first_places<2, kMainOrder>(kMain);

}  // namespace dotpose::code
