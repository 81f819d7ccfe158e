// Double rivals: positions that differ from the one found in the places of two secondary sequences,
// looked at one by one. docs/integrity.md.
#pragma once

#include "core/decode/contest.hpp"

namespace dotpose::core {

/// Summed odds of the 190,027 pairs of places, each with every shift that makes it share a line
/// with the reading. Upper bound: those that share none of the lines that say most are counted at
/// the most that they can have. There must be 6 lines or more.
float sum_of_double_rivals(const Contest& contest);

}  // namespace dotpose::core
