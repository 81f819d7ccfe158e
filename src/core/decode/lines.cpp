#include "core/decode/lines.hpp"

#include "core/decode/correlation.hpp"

namespace dotpose::core {
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
    for (; i + 1 < lines.all.size(); i += 2) {
        correlate_both(weights(i, one), weights(i + 1, other), storage[i].scores,
                       storage[i + 1].scores);
    }
    if (i < lines.all.size()) correlate(weights(i, one), storage[i].scores);
    for (ScoredLine& line : storage.first(lines.all.size()))
        line.best = best_score(line.scores);
    return lines;
}

}  // namespace dotpose::core
