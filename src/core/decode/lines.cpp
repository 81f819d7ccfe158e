#include "core/decode/lines.hpp"

#include "core/decode/correlation.hpp"
#include "core/decode/eight_lines.hpp"
#include "core/wide.hpp"

namespace dotpose::core {
namespace {

/// Scores eight lines at a time as long as there are more than two. Returns how many.
std::size_t score_eights(const Upright& upright, Axis axis, std::span<ScoredLine> lines) {
    const bool is_x = axis == Axis::x;
    const auto length = static_cast<std::size_t>(is_x ? upright.rows() : upright.columns());
    EightWeights weights;
    std::size_t scored = 0;
    while (scored + 2 < lines.size()) {
        const auto some = lines.subspan(scored, std::min<std::size_t>(lines.size() - scored, 8));
        if (some.size() < 8) std::fill_n(weights.begin(), length, Eight{});
        for (std::size_t i = 0; i < some.size(); ++i, ++scored) {
            const auto line = static_cast<int>(scored);
            is_x ? upright.column(line, i, weights) : upright.row(line, i, weights);
        }
        EightScores scores;
        correlate_eight(weights, length, scores);
        write_scores(scores, some);
    }
    return scored;
}

}  // namespace

Lines scored_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage) {
    const int count = axis == Axis::x ? upright.columns() : upright.rows();
    return {storage.first(static_cast<std::size_t>(count))};
}

Lines score_lines(const Upright& upright, Axis axis, std::span<ScoredLine> storage) {
    const Lines lines = scored_lines(upright, axis, storage);
    const auto weights = [&](std::size_t i, Line& line) {
        const int n = static_cast<int>(i);
        return axis == Axis::x ? upright.column(n, line) : upright.row(n, line);
    };
    Line one;
    Line other;
    std::size_t i = 0;
    if constexpr (kIsWide) i = score_eights(upright, axis, storage.first(lines.all.size()));
    for (; i + 1 < lines.all.size(); i += 2) {
        correlate_both(weights(i, one), weights(i + 1, other), storage[i].scores,
                       storage[i + 1].scores);
    }
    if (i < lines.all.size()) correlate(weights(i, one), storage[i].scores);
    for (ScoredLine& line : storage.first(lines.all.size()))
        line.lead = lead_of(line.scores);
    return lines;
}

}  // namespace dotpose::core
