#include "core/decode/lines.hpp"

#include "core/decode/correlation.hpp"

namespace dotpose::core {

Lines score_lines(const Upright& upright, Axis axis, std::span<LineScores> storage) {
    const int count = axis == Axis::x ? upright.columns() : upright.rows();
    Lines lines;
    Line weights;
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<std::size_t>(i);
        const auto line = axis == Axis::x ? upright.column(i, weights) : upright.row(i, weights);
        correlate(line, storage[n]);
        lines.dots[n] = static_cast<std::uint8_t>(
            std::count_if(line.begin(), line.end(), [](std::int8_t w) { return w != 0; }));
    }
    lines.scores = storage.first(static_cast<std::size_t>(count));
    return lines;
}

}  // namespace dotpose::core
