#include "core/decode/position.hpp"

#include "core/decode/correlation.hpp"
#include "core/decode/lines.hpp"
#include "core/decode/orientation.hpp"
#include "core/decode/search.hpp"
#include "core/decode/window.hpp"

namespace dotpose::core {
namespace {

/// Minimum number of lines per axis. Fewer lines do not determine a position.
constexpr int kMinLines = 6;

/// Reads the position on an axis from the best roll of each line.
Status read_axis(CodeVariant code, const Lines& lines, AxisReading& reading) {
    std::array<std::uint8_t, kMaxLines> rolls{};
    for (int i = 0; i < lines.count(); ++i) {
        const Match match = best_match(lines[i]);
        rolls[static_cast<std::size_t>(i)] = match.roll;
        reading.score += match.score;
    }
    reading.roll = rolls[0];
    const auto used = std::span<const std::uint8_t>(rolls).first(lines.all.size());
    return position_from_rolls(code, used, reading.position);
}

void set_place(CodeVariant code, const Upright& upright, QuarterTurn turn, const AxisReading& x,
               const AxisReading& y, Decoding& decoding) {
    const auto section = [&](const AxisReading& own, const AxisReading& other) {
        return static_cast<std::uint8_t>(section_of(code, own.roll, own.position, other.position));
    };
    const Place corner{{x.position, y.position}, {section(x, y), section(y, x)}};
    const FixedVec step = turn(-upright.corner());
    decoding.pattern_from_grid = turn;
    decoding.place = moved(code, corner, step.x, step.y);
}

Status decode_lines(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                    decltype(find_axis) find, Decoding& decoding) {
    const auto [turns, agreement] = rank_turns(grid, decoding.region);
    decoding.agreement = agreement;
    if (decoding.region.columns < kMinLines || decoding.region.rows < kMinLines) {
        return Status::grid_too_small;
    }
    std::int32_t best = INT32_MIN;
    Status status = Status::not_in_code;
    for (const QuarterTurn turn : {turns[0], turns[1]}) {
        const Upright upright(grid, decoding.region, turn);
        const Lines columns = score_lines(upright, Axis::x, scores_of(Axis::x, storage));
        const Lines rows = score_lines(upright, Axis::y, scores_of(Axis::y, storage));
        decoding.lines_are_scored = false;
        AxisReading x;
        AxisReading y;
        if (find(code, columns, x) != Status::ok || find(code, rows, y) != Status::ok ||
            x.score + y.score <= best) {
            continue;
        }
        best = x.score + y.score;
        status = Status::ok;
        set_place(code, upright, turn, x, y, decoding);
        decoding.lines_are_scored = true;
        if (x.is_clear() && y.is_clear()) break;
    }
    return status;
}

}  // namespace

Status decode_window(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                     Decoding& decoding) {
    const GridRegion& window = decoding.window;
    decoding.agreement = rank_turns(grid, decoding.region).agreement;
    constexpr int kMinDots_q8 = 256 / 3;
    if (window.columns < kWindowSide || window.rows < kWindowSide ||
        mean_quality_q8(grid, window) < kMinDots_q8) {
        return Status::grid_too_small;
    }
    const QuarterTurn turn = rank_turns(grid, window).turns[0];
    const Upright upright(grid, window, turn);
    AxisReading x;
    AxisReading y;
    Status status = read_axis(code, score_lines(upright, Axis::x, storage), x);
    if (status == Status::ok) {
        status = read_axis(code, score_lines(upright, Axis::y, storage), y);
    }
    if (status != Status::ok) return status;
    set_place(code, upright, turn, x, y, decoding);
    return Status::ok;
}

Status decode_all(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                  Decoding& decoding) {
    return decode_lines(grid, code, storage, find_axis, decoding);
}

Status decode_briefly(const Grid& grid, CodeVariant code, std::span<ScoredLine> storage,
                      Decoding& decoding) {
    return decode_lines(grid, code, storage, find_axis_briefly, decoding);
}

}  // namespace dotpose::core
