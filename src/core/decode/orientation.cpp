#include "core/decode/orientation.hpp"

#include "core/decode/correlation.hpp"
#include "core/decode/tuning.hpp"
#include "core/decode/upright.hpp"

namespace dotpose::core {
namespace {

/// Number of lines per axis that vote on the turn. The voting lines are in the middle half of the
/// region, because the lines are longest there.
constexpr int kVoters = tuning::turns::kVoters;

/// The columns or rows that vote on the turn. Reads one bit (x or y) of each cell.
class Voters {
  public:
    Voters(const Grid& grid, const GridRegion& region, bool are_columns, std::int8_t GridCell::*bit)
        : first_(&grid.at(region.i0, region.j0)),
          across_(are_columns ? 1 : grid.columns),
          along_(are_columns ? grid.columns : 1),
          length_(are_columns ? region.rows : region.columns),
          bit_(bit) {
        const int lines = are_columns ? region.columns : region.rows;
        step_ = std::max(lines / (2 * kVoters), 1);
        first_ += (lines - (kVoters - 1) * step_) / 2 * across_;
    }

    std::span<const std::int8_t> read(int voter, bool reversed, Line& line) const {
        const GridCell* cell = first_ + voter * step_ * across_;
        const int step = reversed ? -along_ : along_;
        if (reversed) cell += (length_ - 1) * along_;
        for (int n = 0; n < length_; ++n)
            line[static_cast<std::size_t>(n)] = cell[n * step].*bit_;
        return std::span(line).first(static_cast<std::size_t>(length_));
    }

  private:
    const GridCell* first_;
    int across_;  ///< index step between adjacent lines
    int along_;   ///< index step within a line
    int length_;
    int step_;  ///< distance between adjacent voting lines, in lines
    std::int8_t GridCell::*bit_;
};

/// Sums of the voting lines' best scores, for bits as read and for flipped bits.
struct Agreement {
    std::int32_t as_is = 0;
    std::int32_t flipped = 0;
};

Agreement agreement_by_pairs(const Voters& voters, bool reversed) {
    std::array<Line, 2> lines;
    std::array<LineScores, 2> scores;
    Agreement sum;
    for (int i = 0; i < kVoters; i += 2) {
        correlate_both(voters.read(i, reversed, lines[0]), voters.read(i + 1, reversed, lines[1]),
                       scores[0], scores[1]);
        for (const LineScores& of_line : scores) {
            const Extremes extremes = extremes_of(of_line);
            sum.as_is += extremes.max;
            sum.flipped -= extremes.min;
        }
    }
    return sum;
}

/// Agreement of the voting lines with the main sequence, for both reading directions.
struct BothWays {
    Agreement forwards;
    Agreement backwards;
};

BothWays agreement(const Voters& voters) {
    return {agreement_by_pairs(voters, false), agreement_by_pairs(voters, true)};
}

/// Returns the maximum possible agreement of the voting lines, which is the sum of their absolute
/// weights.
std::int32_t max_possible(const Voters& voters) {
    std::int32_t sum = 0;
    Line storage;
    for (int i = 0; i < kVoters; ++i) {
        for (const std::int8_t weight : voters.read(i, false, storage))
            sum += magnitude<int>(weight);
    }
    return sum;
}

/// Returns the highest of four agreements: those of the bits as read and of the flipped bits, in
/// both reading directions.
std::int32_t best_agreement(const Voters& voters) {
    const auto [forwards, backwards] = agreement(voters);
    return std::max(std::max(forwards.as_is, forwards.flipped),
                    std::max(backwards.as_is, backwards.flipped));
}

}  // namespace

Orientation rank_turns(const Grid& grid, const GridRegion& region) {
    // Sums the best scores of the lines. The paper instead counts the lines that occur exactly in
    // the main sequence. Unlike this count, the sum also uses lines with misread bits.
    const Voters x_columns(grid, region, true, &GridCell::x);
    const Voters y_rows(grid, region, false, &GridCell::y);
    const BothWays of_columns = agreement(x_columns);
    const BothWays of_rows = agreement(y_rows);
    const std::int32_t columns = of_columns.forwards.as_is;
    const std::int32_t rows = of_rows.forwards.as_is;
    // A half turn reverses each line and flips its bits.
    const std::int32_t turned_columns = of_columns.backwards.flipped;
    const std::int32_t turned_rows = of_rows.backwards.flipped;
    // A quarter turn exchanges columns and rows. It also reverses and flips either the columns or
    // the rows (see `turned` in upright.hpp).
    const std::array<std::int32_t, 4> scores{columns + rows, turned_columns + rows,
                                             turned_columns + turned_rows, columns + turned_rows};
    std::array<QuarterTurn, 4> turns{QuarterTurn{0}, QuarterTurn{1}, QuarterTurn{2},
                                     QuarterTurn{3}};
    const auto score = [&](QuarterTurn t) { return scores[static_cast<std::size_t>(t.quarters)]; };
    // Stable insertion sort by decreasing score. A library sort would need much more code for four
    // elements.
    for (std::size_t n = 1; n < turns.size(); ++n) {
        for (std::size_t i = n; i > 0 && score(turns[i]) > score(turns[i - 1]); --i)
            std::swap(turns[i], turns[i - 1]);
    }
    return {turns, score(turns[0])};
}

bool is_mirrored(const Grid& grid, const GridRegion& region, std::int32_t upright) {
    // A mirror image exchanges the x and y bits (paper, equations 7 and 8). It may also reverse
    // lines or flip bits.
    const Voters y_columns(grid, region, true, &GridCell::y);
    const Voters x_rows(grid, region, false, &GridCell::x);
    const auto is_much_more = [&](std::int32_t mirrored) {
        return 4 * mirrored > tuning::turns::kMirrored_4ths * upright;
    };
    const std::int32_t max_of_rows = max_possible(x_rows);
    if (!is_much_more(max_possible(y_columns) + max_of_rows)) return false;
    const std::int32_t columns = best_agreement(y_columns);
    return is_much_more(columns + max_of_rows) && is_much_more(columns + best_agreement(x_rows));
}

}  // namespace dotpose::core
