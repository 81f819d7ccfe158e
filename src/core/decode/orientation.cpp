#include "core/decode/orientation.hpp"

#include "core/decode/correlation.hpp"
#include "core/decode/upright.hpp"

namespace dotpose::core {
namespace {

/// How the bits of a line are taken.
struct Reading {
    bool is_column;
    std::int8_t GridCell::*bit;
    bool flipped;
    bool reversed;
};

/// So many lines of the middle half, which has the longest ones, settle the turn.
constexpr int kVoters = 4;

/// Sum over columns (or rows) of the best correlation with the main sequence.
std::int32_t agreement(const Grid& grid, const Region& region, Reading how) {
    const int lines = how.is_column ? region.columns : region.rows;
    const int length = how.is_column ? region.rows : region.columns;
    const auto read = [&](int i, Line& line) {
        for (int n = 0; n < length; ++n) {
            const int along = how.reversed ? length - 1 - n : n;
            const GridCell& cell = how.is_column ? grid.at(region.i0 + i, region.j0 + along)
                                                 : grid.at(region.i0 + along, region.j0 + i);
            const std::int8_t weight = cell.*how.bit;
            line[static_cast<std::size_t>(n)] =
                how.flipped ? static_cast<std::int8_t>(-weight) : weight;
        }
        return std::span<const std::int8_t>(line).first(static_cast<std::size_t>(length));
    };
    std::array<Line, 2> storage;
    std::array<LineScores, 2> scores;
    std::int32_t sum = 0;
    const int step = std::max(lines / (2 * kVoters), 1);
    const int first = (lines - (kVoters - 1) * step) / 2;
    for (int i = first; i < first + kVoters * step; i += 2 * step) {
        correlate_both(read(i, storage[0]), read(i + step, storage[1]), scores[0], scores[1]);
        sum += best_match(scores[0]).score + best_match(scores[1]).score;
    }
    return sum;
}

/// Agreement of the columns (of the x bits) and of the rows (of the y bits), as they are and after
/// half a turn, which flips and reverses them.
struct Votes {
    std::int32_t columns, turned_columns, rows, turned_rows;
};

Votes votes(const Grid& grid, const Region& region) {
    return {agreement(grid, region, {true, &GridCell::x, false, false}),
            agreement(grid, region, {true, &GridCell::x, true, true}),
            agreement(grid, region, {false, &GridCell::y, false, false}),
            agreement(grid, region, {false, &GridCell::y, true, true})};
}

}  // namespace

std::array<Turn, 4> rank_turns(const Grid& grid, const Region& region) {
    // differs: the paper counts lines that stand in the main sequence exactly; the sum of best
    // correlations is the same vote, but lines with a misread bit keep their say.
    const Votes v = votes(grid, region);
    // A quarter turn lays rows into columns and flips only one of the two: see `turned`.
    const std::array<std::int32_t, 4> scores{v.columns + v.rows, v.turned_columns + v.rows,
                                             v.turned_columns + v.turned_rows,
                                             v.columns + v.turned_rows};
    std::array<Turn, 4> turns{Turn{0}, Turn{1}, Turn{2}, Turn{3}};
    std::sort(turns.begin(), turns.end(), [&](Turn a, Turn b) {
        const auto score = [&](Turn t) { return scores[static_cast<std::size_t>(t.quarters)]; };
        return score(a) != score(b) ? score(a) > score(b) : a.quarters < b.quarters;
    });
    return turns;
}

bool is_mirrored(const Grid& grid, const Region& region) {
    // In a mirror image the projections of eq. 7 and 8 change places, and lines may run backwards.
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    for (const bool flipped : {false, true}) {
        for (const bool reversed : {false, true}) {
            columns =
                std::max(columns, agreement(grid, region, {true, &GridCell::y, flipped, reversed}));
            rows =
                std::max(rows, agreement(grid, region, {false, &GridCell::x, flipped, reversed}));
        }
    }
    const Votes v = votes(grid, region);
    const std::int32_t upright =
        std::max(v.columns, v.turned_columns) + std::max(v.rows, v.turned_rows);
    // Lines of random bits reach about 60 % of what lines of the main sequence do.
    return 4 * (columns + rows) > 5 * upright;
}

}  // namespace dotpose::core
