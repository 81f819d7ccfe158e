// Alternatives that differ in the places of several sequences: docs/integrity.md.
#pragma once

#include <array>

namespace dotpose::core {

/// Those of one set of sequences: how many, and how probable it is that they all show the reading's
/// digits in a step; as powers of two in 2^-8.
struct AlternativeSet {
    int alternatives_q8 = 0;
    int equal_q8 = 0;
};
/// Two with a3, two others, three with a3, the three others, all four.
inline constexpr std::array<AlternativeSet, 5> kAlternativeSets{
    {{3694, -661}, {4444, -811}, {5712, -1067}, {6057, -1217}, {7326, -1473}}};
/// log2(1.03): see ExpectedAlternatives.
inline constexpr int kUnevenness_q8 = 11;

}  // namespace dotpose::core
