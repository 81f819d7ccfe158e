// Test vectors of the position code, made by an independent implementation or read from real paper.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "dotpose/code.hpp"

namespace dotpose::code_test {

/// A window of 8 x 8 symbols, with its top left symbol at `place`.
struct CodeVector {
    CodeVariant code;
    Place place;
    std::array<std::string_view, 8> rows;
};

inline constexpr std::array<CodeVector, 7> kCodeVectors{{
    {CodeVariant::anoto,
     {{0, 0}, {0, 0}},
     {"uulluldu", "udlurrdr", "rrdruduu", "ruldllul", "ulurddur", "rldrduur", "dduuuuul",
      "ulurllrd"}},
    {CodeVariant::anoto,
     {{122, 3219}, {0, 0}},
     {"ruldrdrr", "rdruudlr", "dllruuul", "lrlllrld", "dluruull", "luudlrrl", "lllulrll",
      "ulddurlr"}},
    {CodeVariant::anoto,
     {{217, 1134}, {0, 0}},
     {"dddurddl", "rdddrudu", "rrluulul", "rdulduru", "ululuudu", "rlrrruud", "uuldddlr",
      "lrlddurr"}},
    {CodeVariant::anoto,
     {{410815341, 5}, {62, 1}},
     {"urrrduul", "urdrllrl", "lrlrldlu", "drddduru", "drdurdru", "lulrurrl", "dlrlrdrd",
      "rrdllldr"}},
    {CodeVariant::anoto,
     {{123456789, 400000000}, {10, 2}},
     {"lddruddd", "ldluudlr", "uddddull", "llruldrr", "ddrdlulr", "lrrllull", "rllulddr",
      "uulluuru"}},
    {CodeVariant::libdots,
     {{122, 3219}, {0, 0}},
     {"ruldrdrr", "rdruudlr", "dllruuul", "lrlllrld", "dluruull", "luudlrrl", "lllulrll",
      "ulddurlr"}},
    {CodeVariant::microdots,
     {{7, 3}, {10, 2}},
     {"drurrdll", "ruldldud", "llrddrdl", "ddullluu", "udurdurr", "urlllldd", "ldududuu",
      "dlllldrd"}},
}};

/// Offsets of the main sequence in adjacent rows of commercial paper, as published in 2005 with the
/// Free Dot Toolkit. Six offsets (five differences) determine a position. The rows of each array
/// are consecutive, and the name of the array contains the position of the first row.
inline constexpr std::array<std::uint8_t, 25> kPaperRollsFrom1117{
    34, 46, 6, 33, 46, 41, 9, 52, 28, 44, 10, 18, 1, 59, 17, 8, 42, 54, 40, 29, 59, 31, 56, 51, 7};
inline constexpr std::array<std::uint8_t, 30> kPaperRollsFrom1097{
    28, 39, 13, 5,  59, 18, 48, 10, 3,  34, 50, 31, 5,  45, 58,
    51, 9,  0,  31, 23, 35, 47, 7,  34, 47, 42, 10, 53, 29, 45};

}  // namespace dotpose::code_test
