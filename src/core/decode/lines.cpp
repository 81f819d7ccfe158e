#include "core/decode/lines.hpp"

#include "core/decode/correlation.hpp"
#include "core/decode/eight_lines.hpp"
#include "core/pixels/words.hpp"

namespace dotpose::core {
namespace {

/// Scores eight lines at a time as long as there are more than two. Returns how many.
template <typename Weights>
std::size_t score_eights(Weights weights, std::span<LineScores> lines) {
    EightWeights eight;
    std::size_t scored = 0;
    while (scored + 2 < lines.size()) {
        const auto some = lines.subspan(scored, std::min<std::size_t>(lines.size() - scored, 8));
        Line storage;
        std::size_t length = 0;
        for (std::size_t i = 0; i < some.size(); ++i) {
            const auto line = weights(scored + i, storage);
            put_line(line, i, eight);
            length = line.size();
        }
        EightScores scores;
        correlate_eight(std::span(eight).first(length), scores);
        write_scores(scores, some);
        scored += some.size();
    }
    return scored;
}

}  // namespace

Lines scored_lines(const Upright& upright, Axis axis, std::span<LineScores> storage) {
    const int count = axis == Axis::x ? upright.columns() : upright.rows();
    return {storage.first(static_cast<std::size_t>(count))};
}

Lines score_lines(const Upright& upright, Axis axis, std::span<LineScores> storage) {
    const Lines lines = scored_lines(upright, axis, storage);
    const auto weights = [&](std::size_t i, Line& line) {
        const int n = static_cast<int>(i);
        return axis == Axis::x ? upright.column(n, line) : upright.row(n, line);
    };
    Line one;
    Line other;
    std::size_t i = 0;
    if constexpr (sizeof(Word) == 8) i = score_eights(weights, storage.first(lines.scores.size()));
    for (; i + 1 < lines.scores.size(); i += 2) {
        correlate_both(weights(i, one), weights(i + 1, other), storage[i], storage[i + 1]);
    }
    if (i < lines.scores.size()) correlate(weights(i, one), storage[i]);
    return lines;
}

}  // namespace dotpose::core
