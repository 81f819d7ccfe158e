// Eight lines: correlated at once, one in each number of a vector. For processors that have them:
// it takes them hardly longer than one line.
#pragma once

#include <array>
#include <span>

#include "core/vectors.hpp"
#include "dotpose/stages.hpp"

namespace dotpose::core {

/// Weights of eight lines, by their place in the line.
using EightWeights = std::array<Eight, kMaxGridSide>;

/// Scores of eight lines, by the offset.
using EightScores = std::array<Eight, kSections>;

/// As `correlate`, of lines of so many weights: at least one.
void correlate_eight(const EightWeights& weights, std::size_t length, EightScores& scores);

/// Sorts the scores by line, of as many lines as there are in `lines`; at most eight.
void write_scores(const EightScores& scores, std::span<ScoredLine> lines);

}  // namespace dotpose::core
