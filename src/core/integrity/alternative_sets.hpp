// Sets of alternatives by the sequences in which their places differ: docs/integrity.md.
#pragma once

#include <array>

namespace dotpose::core {

/// The alternatives that differ in one set of sequences: their number, and the probability that all
/// their digits in a step equal the reading's. Both as log2 in 2^-8.
struct AlternativeSet {
    int alternatives_q8 = 0;
    int equal_q8 = 0;
};
/// The sets differ in: two sequences with a3, two others, three with a3, the three others, all
/// four.
inline constexpr std::array<AlternativeSet, 5> kAlternativeSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2(1.03), in 2^-8: see kUnevenness in expected_alternatives.cpp.
inline constexpr int kUnevenness_q8 = 11;

}  // namespace dotpose::core
