// p_wrong against reality: how often is a position wrong of which `verify` says that it is wrong
// with probability p? Every frame is accepted, however doubtful, and counted by what it claims.
//
//   dotpose_integrity [--grids N] [--doubtful N] [--frames N] [--seed S] [--threads N]
//
// Grids: bits with random errors, handed to the decoder directly. Their errors are independent of
// each other, and rarer the larger the weight, as the model behind p_wrong has it. Doubtful grids:
// with as many errors as make p_wrong land between 1e-3 and 1e-5, where a claim can be refuted by
// counting. Frames: rendered patterns with flipped bits, seen by `locate`. Exits 1 if more is wrong
// than claimed. Ctrl-C prints what was counted so far.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "../tests/altered_pattern.hpp"
#include "core/decode/nominal.hpp"
#include "core/decode/position.hpp"
#include "core/decode/rivals.hpp"
#include "core/decode/upright.hpp"
#include "core/decode/verify.hpp"
#include "core/decode/window.hpp"
#include "counting.hpp"
#include "dotpose/locate.hpp"

namespace {

using namespace dotpose;

/// What kind of position was taken for the true one.
enum class Wrong : std::uint8_t {
    near,       ///< shares five or more lines in a row
    single,     ///< differs in the place of one secondary sequence
    far,        ///< differs in two or more, and shares some line
    section,    ///< the same position in another section
    unrelated,  ///< none of these, or another turn
    none,
};
constexpr std::array kWrongs{Wrong::near, Wrong::single, Wrong::far, Wrong::section,
                             Wrong::unrelated};
constexpr std::array kWrongNames{"near", "single", "far", "section", "unrelated"};

/// Frames that claim the same p_wrong, or a similar one.
struct Bin {
    std::uint64_t frames = 0;
    double claimed = 0;  ///< sum of p_wrong
    std::array<std::uint64_t, kWrongs.size()> wrong{};

    std::uint64_t all_wrong() const {
        return std::accumulate(wrong.begin(), wrong.end(), std::uint64_t{0});
    }
    Bin& operator+=(const Bin& other) {
        frames += other.frames;
        claimed += other.claimed;
        for (std::size_t w = 0; w < wrong.size(); ++w)
            wrong[w] += other.wrong[w];
        return *this;
    }
};

struct Tally {
    /// p_wrong = 2^-n in bin n; the last holds all below.
    std::array<Bin, 64> bins;
    std::uint64_t unread = 0;
    std::uint64_t passed_over = 0;  ///< not doubtful

    void add(int p_wrong_log2, Wrong wrong) {
        Bin& bin = bins[std::min(static_cast<std::size_t>(-p_wrong_log2), bins.size() - 1)];
        ++bin.frames;
        bin.claimed += std::ldexp(1.0, p_wrong_log2);
        if (wrong != Wrong::none) ++bin.wrong[static_cast<std::size_t>(wrong)];
    }
    /// Bins `first` to `last`; those that do not exist are empty.
    Bin sum(std::size_t first, std::size_t last) const {
        Bin sum;
        for (std::size_t n = first; n <= last && n < bins.size(); ++n)
            sum += bins[n];
        return sum;
    }
    Tally& operator+=(const Tally& other) {
        unread += other.unread;
        passed_over += other.passed_over;
        for (std::size_t n = 0; n < bins.size(); ++n)
            bins[n] += other.bins[n];
        return *this;
    }
};

// ---- Grids ----

constexpr int kMaxSide = 16;

/// Bits as read from a pattern.
struct Reading {
    std::array<GridCell, kMaxSide * kMaxSide> cells;
    Grid grid;
    Profile profile = Profile::anoto;
    Turn turn;
    Place place;  ///< true place of grid cell (0, 0)
};

/// The cell that `core::turned` turns to these bits.
GridCell cell_of(Turn turn, int x, int y) {
    const Vec grid = turn.quarters == 1   ? Vec{-y, x}
                     : turn.quarters == 3 ? Vec{y, -x}
                     : turn.quarters == 2 ? Vec{-x, -y}
                                          : Vec{x, y};
    return {static_cast<std::int8_t>(grid.x), static_cast<std::int8_t>(grid.y), 0};
}

/// Statistics of the errors of one reading.
struct Noise {
    double odds_log2;  ///< that a bit of full weight is right
    double missing;    ///< share of the cells
    int least_weight;

    double chance_of_error(int weight) const {
        return 1 / (1 + std::exp2(odds_log2 * weight / 127));
    }
    int read(int bit, Rng& rng) const {
        const int range = 127 - least_weight + 1;
        const int weight = least_weight + static_cast<int>(rng.below(static_cast<unsigned>(range)));
        const bool is_wrong = rng.uniform() < chance_of_error(weight);
        return (bit == 1) != is_wrong ? weight : -weight;
    }
    /// What a reading says of a bit, in bits: 1 - H(chance of error).
    double information(int weight) const {
        const double q = chance_of_error(weight);
        return 1 + q * std::log2(q) + (1 - q) * std::log2(1 - q);
    }
    /// The mean over all cells.
    double information() const {
        double sum = 0;
        for (int weight = least_weight; weight <= 127; ++weight)
            sum += information(weight);
        return (1 - missing) * sum / (127 - least_weight + 1);
    }
};

enum class Kind : std::uint8_t { any, doubtful };

/// What a position needs on one axis: log2 of positions, sections and turns is 36.6. With some 30
/// bits more the rivals leave a doubt of about 2^-13.
double draw_odds_of_doubt(double cells, Noise noise, Rng& rng) {
    const double wanted_bits = rng.uniform(60, 80);
    constexpr double kMostOdds_log2 = 12;
    noise.odds_log2 = 0;
    for (double step = kMostOdds_log2 / 2; step > 0.01; step /= 2) {
        noise.odds_log2 += step;
        if (cells * noise.information() > wanted_bits) noise.odds_log2 -= step;
    }
    return noise.odds_log2;
}

/// Size, place and turn.
void draw_frame(Rng& rng, Reading& reading) {
    Grid& grid = reading.grid;
    grid.storage = reading.cells;
    const auto other = static_cast<Profile>(rng.below(3));
    if (rng.below(3) == 0) reading.profile = other;
    grid.side = kMaxSide;
    grid.columns = 8 + static_cast<int>(rng.below(6));
    grid.rows = 8 + static_cast<int>(rng.below(6));
    grid.i0 = -static_cast<int>(rng.below(8));
    grid.j0 = -static_cast<int>(rng.below(8));
    reading.turn.quarters = static_cast<int>(rng.below(4));
    reading.place = {{rng.below(kPositionsPerAxis), rng.below(kPositionsPerAxis)},
                     {static_cast<std::uint8_t>(rng.below(kSections)),
                      static_cast<std::uint8_t>(rng.below(kSections))}};
}

void draw(Kind kind, Rng& rng, Reading& reading) {
    draw_frame(rng, reading);
    Grid& grid = reading.grid;
    Noise noise{rng.uniform(2.5, 9), rng.below(2) == 0 ? 0 : rng.uniform(0, 0.25),
                rng.below(2) == 0 ? 127 : 8};
    // In some, blank paper beyond some column.
    const int visible = rng.below(3) == 0 ? 6 + static_cast<int>(rng.below(3)) : grid.columns;
    if (kind == Kind::doubtful) {
        const int cells = std::min(visible, grid.columns) * grid.rows;
        noise.odds_log2 = draw_odds_of_doubt(cells, noise, rng);
    }
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            GridCell& cell = grid.at(i, j);
            cell = {};
            if (i - grid.i0 >= visible || rng.uniform() < noise.missing) continue;
            const Vec step = reading.turn({i, j});
            const Place at = moved(reading.profile, reading.place, step.x, step.y);
            const Symbol symbol = symbol_at(reading.profile, at.cell, at.section);
            const int x = noise.read(x_bit(symbol), rng);
            const int y = noise.read(y_bit(symbol), rng);
            cell = cell_of(reading.turn, x, y);
        }
    }
}

/// Where the first of some lines stands, and the first of those that cross them.
struct AxisPlace {
    std::uint32_t position;
    int section;
    std::uint32_t cross;
};

/// Rolls of `count` lines.
std::array<int, kMaxSide> rolls_of(Profile profile, const AxisPlace& place, int count) {
    std::array<int, kMaxSide> rolls{};
    std::uint32_t position = place.position;
    int here = roll(profile, position) + place.section + static_cast<int>(place.cross % kSections);
    for (int i = 0; i < count; ++i) {
        rolls[static_cast<std::size_t>(i)] = here % kSections;
        here += delta(profile, position);
        position = position + 1 == kPositionsPerAxis ? 0 : position + 1;
    }
    return rolls;
}

Wrong kind_on_axis(Profile profile, const AxisPlace& found, const AxisPlace& real, int count) {
    const auto a = rolls_of(profile, found, count);
    const auto b = rolls_of(profile, real, count);
    int shared = 0;
    int longest = 0;
    int run = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        run = a[i] == b[i] ? run + 1 : 0;
        shared += a[i] == b[i];
        longest = std::max(longest, run);
    }
    if (shared == count) return Wrong::none;
    if (found.position == real.position) return Wrong::section;
    if (longest >= 5) return Wrong::near;
    int different = 0;
    for (const unsigned length : {236u, 233u, 31u, 241u})
        different += found.position % length != real.position % length;
    if (different == 1) return Wrong::single;
    return shared > 0 ? Wrong::far : Wrong::unrelated;
}

Wrong kind_of_error(const Reading& reading, const Decoding& decoding) {
    const Place& found = decoding.place;
    const Place& real = reading.place;
    if (decoding.pattern_from_grid.quarters != reading.turn.quarters) return Wrong::unrelated;
    if (found == real) return Wrong::none;
    // Compared in the columns and rows in view.
    const Vec a = reading.turn({reading.grid.i0, reading.grid.j0});
    const Vec b = reading.turn(
        {reading.grid.i0 + reading.grid.columns - 1, reading.grid.j0 + reading.grid.rows - 1});
    const Vec corner{std::min(a.x, b.x), std::min(a.y, b.y)};
    const Vec size{std::abs(a.x - b.x) + 1, std::abs(a.y - b.y) + 1};
    const Place f = moved(reading.profile, found, corner.x, corner.y);
    const Place r = moved(reading.profile, real, corner.x, corner.y);
    const Wrong x = kind_on_axis(reading.profile, {f.cell.x, f.section.u, f.cell.y},
                                 {r.cell.x, r.section.u, r.cell.y}, size.x);
    if (x != Wrong::none) return x;
    return kind_on_axis(reading.profile, {f.cell.y, f.section.v, f.cell.x},
                        {r.cell.y, r.section.v, r.cell.x}, size.y);
}

/// What the bits of a reading say, per axis, if its odds are those that `verify` takes for it: a
/// cheap measure of how doubtful it is, from nothing but what the decoder sees.
double apparent_information(const Grid& grid, const Decoding& decoding,
                            const core::Nominal& nominal) {
    core::Confidence confidence;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            const core::Bits read = core::turned(decoding.pattern_from_grid, grid.at(i, j));
            const Symbol expected = nominal.symbol(nominal.pattern_step({i, j}));
            if (read.x != 0) confidence.add(read.x, (read.x > 0) != (x_bit(expected) == 1));
            if (read.y != 0) confidence.add(read.y, (read.y > 0) != (y_bit(expected) == 1));
        }
    }
    const Noise noise{core::odds_per_bit_q8(confidence) / 256.0, 0, 127};
    double bits = 0;
    for (int bin = 0; bin < core::Confidence::kBins; ++bin)
        bits += confidence.bits[static_cast<std::size_t>(bin)] * noise.information(8 * bin + 4);
    return bits / 2;
}

/// Whether p_wrong is likely to be near 1e-5, the claim that takes the most cases; enough of those
/// that look so are near 1e-4 and 1e-3. `verify` takes 20 times as long as all before it.
bool looks_doubtful(const Grid& grid, const Decoding& decoding, const core::Nominal& nominal) {
    const double bits = apparent_information(grid, decoding, nominal);
    return bits > 62 && bits < 75;
}

constexpr IntegrityOptions kAcceptAll{0, 256};

void try_grid(Kind kind, std::uint64_t seed, std::uint64_t index, Tally& tally) {
    Rng rng(seed, index);
    Reading reading;
    draw(kind, rng, reading);
    Decoding decoding;
    decoding.window = core::choose_window(reading.grid, kWindowSide);
    decoding.region = core::choose_window(reading.grid, kMaxSide);
    std::array<LineScores, kMaxSide> storage;
    if (core::decode_all(reading.grid, reading.profile, storage, decoding) != Status::ok) {
        ++tally.unread;
        return;
    }
    const core::Nominal nominal(reading.grid, reading.profile, decoding);
    if (kind == Kind::doubtful && !looks_doubtful(reading.grid, decoding, nominal)) {
        ++tally.passed_over;
        return;
    }
    Fix fix;
    const Status status =
        core::verify(reading.grid, reading.profile, decoding, nominal, kAcceptAll, storage, fix);
    if (status != Status::ok) {
        ++tally.unread;
        return;
    }
    tally.add(fix.p_wrong_log2, kind_of_error(reading, decoding));
}

// ---- Frames ----

void try_frame(std::uint64_t seed, std::uint64_t index, Workspace& workspace, Tally& tally) {
    Setup setup;
    setup.preset = Preset::clean;
    setup.seed = seed;
    Shot shot = draw_shot(setup, index);
    Rng rng(seed + 1, index);
    const double rate = rng.uniform(0, 0.3);
    if (rng.below(2) == 0) {
        shot.page.columns = 7 + rng.below(5);
        shot.page.rows = 1000;
        shot.page.origin = {shot.pose.cell.x - shot.page.columns / 2, shot.pose.cell.y - 500};
    }
    const Pattern pattern = shot.page.pattern;
    const GreyImage image = test::render_dots(shot, [&](Cell cell) {
        return test::displacement_of(test::flipped_symbol(pattern, rate, shot.seed, cell));
    });
    Options options;
    options.integrity = kAcceptAll;
    const Fix fix = locate(image.view(), options, workspace);
    if (fix.status != Status::ok) {
        ++tally.unread;
        return;
    }
    const double theta =
        std::remainder(fix.theta_rad() - shot.pose.theta_rad, 2 * std::numbers::pi);
    const bool is_right = std::abs(fix.x_grid() - x_grid(shot.pose)) < 1 &&
                          std::abs(fix.y_grid() - y_grid(shot.pose)) < 1 && std::abs(theta) < 0.2 &&
                          fix.section == pattern.section;
    tally.add(fix.p_wrong_log2, is_right ? Wrong::none : Wrong::unrelated);
}

// ---- Result ----

/// P(Poisson(mean) <= count).
double chance_of_as_few(std::uint64_t count, double mean) {
    double sum = 0;
    for (std::uint64_t n = 0; n <= count; ++n) {
        const auto k = static_cast<double>(n);
        sum += std::exp(k * std::log(mean) - mean - std::lgamma(k + 1));
    }
    return sum;
}

/// P(Poisson(mean) >= count).
double chance_of_as_many(std::uint64_t count, double mean) {
    return count == 0 || mean <= 0 ? 1 : 1 - chance_of_as_few(count - 1, mean);
}

/// The mean above which so few would be seen in less than 5 % of the cases.
double upper_limit(std::uint64_t count) {
    double low = static_cast<double>(count);
    double high = 2 * low + 10;
    while (high - low > 1e-6 * high) {
        const double mean = (low + high) / 2;
        (chance_of_as_few(count, mean) > 0.05 ? low : high) = mean;
    }
    return high;
}

/// Whether no more is wrong than claimed, but for a chance of one in a thousand.
bool holds(const Bin& bin) {
    const std::uint64_t wrong = bin.all_wrong();
    return static_cast<double>(wrong) <= bin.claimed ||
           chance_of_as_many(wrong, bin.claimed) > 1e-3;
}

/// All claims, by factors of 8. Returns whether all hold.
bool print(std::string_view title, const Tally& tally, bool with_kinds) {
    constexpr std::size_t kWidth_log2 = 3;
    constexpr std::size_t kLast = 34;  // and all below
    bool all_hold = true;
    fmt::print("\n{} ({} not read{})\n{:>17} {:>9} {:>7} {:>10} {:>10}", title, tally.unread,
               tally.passed_over > 0 ? fmt::format(", {} passed over", tally.passed_over) : "",
               "p_wrong", "read", "wrong", "rate", "claimed");
    if (with_kinds) {
        for (const char* name : kWrongNames)
            fmt::print(" {:>9}", name);
    }
    fmt::print("\n");
    for (std::size_t from = 0; from <= kLast; from += from == 0 ? 1 : kWidth_log2) {
        const std::size_t to = from == 0       ? 0
                               : from == kLast ? tally.bins.size() - 1
                                               : from + kWidth_log2 - 1;
        const Bin bin = tally.sum(from, to);
        if (bin.frames == 0) continue;
        const double high = std::ldexp(1.0, -static_cast<int>(from));
        const std::string range = from == 0       ? "1"
                                  : from == kLast ? fmt::format("up to {:.1e}", high)
                                                  : fmt::format("{:.1e}..{:.1e}", high / 4, high);
        const auto frames = static_cast<double>(bin.frames);
        fmt::print("{:>17} {:>9} {:>7} {:>10.2e} {:>10.2e}", range, bin.frames, bin.all_wrong(),
                   static_cast<double>(bin.all_wrong()) / frames, bin.claimed / frames);
        if (with_kinds) {
            for (const std::uint64_t n : bin.wrong)
                fmt::print(" {:>9}", n);
        }
        fmt::print("{}\n", holds(bin) ? "" : "  MORE THAN CLAIMED");
        all_hold &= holds(bin);
    }
    return all_hold;
}

/// The claims near 1e-3, 1e-4 and 1e-5, each of three powers of two, with what can be said of the
/// true rate. Returns whether all hold.
bool print_doubtful(const Tally& tally) {
    bool all_hold = true;
    fmt::print("\n{:>15} {:>9} {:>7} {:>10} {:>16} {:>13}\n", "p_wrong", "read", "wrong", "rate",
               "95 % upper limit", "claimed, mean");
    for (const std::size_t middle : {10U, 13U, 17U}) {
        const Bin bin = tally.sum(middle - 1, middle + 1);
        const auto frames = static_cast<double>(std::max<std::uint64_t>(bin.frames, 1));
        const double limit = upper_limit(bin.all_wrong()) / frames;
        const double claimed = bin.claimed / frames;
        const char* verdict = !holds(bin)        ? "MORE THAN CLAIMED"
                              : limit <= claimed ? "shown"
                                                 : "too few to tell";
        fmt::print("{:>15} {:>9} {:>7} {:>10.2e} {:>16.2e} {:>13.2e}  {}\n",
                   fmt::format("2^-{}..2^-{}", middle + 1, middle - 1), bin.frames, bin.all_wrong(),
                   static_cast<double>(bin.all_wrong()) / frames, limit, claimed, verdict);
        all_hold &= holds(bin);
    }
    return all_hold;
}

struct Arguments {
    Counting counting;
    std::uint64_t grids = 200'000;
    std::uint64_t doubtful = 200'000;
    std::uint64_t frames = 4'000;
};

int run(const Arguments& arguments) {
    const std::uint64_t seed = arguments.counting.seed;
    const unsigned threads = arguments.counting.threads;
    const auto count_grids = [&](const char* what, Kind kind, std::uint64_t count) {
        return count_on_threads<Tally>(what, count, threads, [&](std::uint64_t i, Tally& tally) {
            try_grid(kind, seed, i, tally);
        });
    };
    const Count<Tally> grids = count_grids("grids", Kind::any, arguments.grids);
    const Count<Tally> doubtful = count_grids("doubtful grids", Kind::doubtful, arguments.doubtful);
    const Count<Tally> frames = count_on_threads<Tally>(
        "frames", arguments.frames, threads, [&](std::uint64_t i, Tally& tally) {
            thread_local const auto kWorkspace = std::make_unique<LargeWorkspace>();
            try_frame(seed, i, *kWorkspace, tally);
        });
    bool all_hold = print("Grids of 8 to 13 lines", grids.tally, true);
    all_hold &= print("Doubtful grids of 8 to 13 lines", doubtful.tally, true);
    all_hold &= print_doubtful(doubtful.tally);
    all_hold &= print("Rendered frames of 188 x 120 px", frames.tally, false);
    fmt::print("\nseed {}, {} threads\n", seed, threads);
    bool all_done = true;
    for (const auto& [what, count] :
         {std::pair{"grids", &grids}, {"doubtful grids", &doubtful}, {"frames", &frames}}) {
        fmt::print("{}\n", speed_line(what, count->asked, count->done, count->seconds));
        all_done &= count->done == count->asked;
    }
    return all_hold && all_done ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app("Is p_wrong what it claims to be? Status 1 if more is wrong than claimed.",
                 "dotpose_integrity");
    add_count(app, "--grids", arguments.grids, "Grids with errors of all rates");
    add_count(app, "--doubtful", arguments.doubtful, "Grids whose p_wrong is near 1e-3 to 1e-5");
    add_count(app, "--frames", arguments.frames, "Rendered frames");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
