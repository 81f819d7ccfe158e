// p_wrong against reality: how often is a position wrong of which `verify` says that it is wrong
// with probability p? Every frame is accepted, however doubtful, and counted by what it claims.
//
//   dotpose_integrity [--grids N] [--frames N] [--seed S] [--threads N]
//
// Grids: bits with random errors, handed to the decoder directly. Their errors are independent of
// each other, and rarer the larger the weight, as the model behind p_wrong has it. Frames: rendered
// patterns with flipped bits, seen by `locate`. Exits 1 if more is wrong than claimed.
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "../tests/altered_pattern.hpp"
#include "core/decode/nominal.hpp"
#include "core/decode/position.hpp"
#include "core/decode/verify.hpp"
#include "core/decode/window.hpp"
#include "dotpose/locate.hpp"
#include "workers.hpp"

namespace {

using namespace dotpose;

struct Arguments {
    std::uint64_t grids = 200'000;
    std::uint64_t frames = 4'000;
    std::uint64_t seed = 1;
    unsigned threads = std::max(std::thread::hardware_concurrency(), 1u);
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; i += 2) {
        const std::string_view name = argv[i];
        const auto value = i + 1 < argc ? std::strtoull(argv[i + 1], nullptr, 10) : 0;
        if (name == "--grids" && i + 1 < argc) {
            arguments.grids = value;
        } else if (name == "--frames" && i + 1 < argc) {
            arguments.frames = value;
        } else if (name == "--seed" && value > 0) {
            arguments.seed = value;
        } else if (name == "--threads" && value > 0) {
            arguments.threads = static_cast<unsigned>(value);
        } else {
            throw BadArgument(
                "usage: dotpose_integrity [--grids N] [--frames N] [--seed S] [--threads N]");
        }
    }
    return arguments;
}

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

/// Frames by claimed p_wrong.
struct Bin {
    std::uint64_t frames = 0;
    double claimed = 0;  ///< sum of p_wrong
    std::array<std::uint64_t, kWrongs.size()> wrong{};

    std::uint64_t all_wrong() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t n : wrong)
            sum += n;
        return sum;
    }
};

struct Tally {
    /// Each spans a factor of 8; the first is p_wrong = 1, the last all below.
    static constexpr std::size_t kBins = 13;
    static constexpr int kWidth_log2 = 3;
    std::array<Bin, kBins> bins;
    std::uint64_t unread = 0;

    void add(int p_wrong_log2, Wrong wrong) {
        const int n = (-p_wrong_log2 + kWidth_log2 - 1) / kWidth_log2;
        Bin& bin = bins[std::min(static_cast<std::size_t>(n), kBins - 1)];
        ++bin.frames;
        bin.claimed += std::ldexp(1.0, p_wrong_log2);
        if (wrong != Wrong::none) ++bin.wrong[static_cast<std::size_t>(wrong)];
    }
    Tally& operator+=(const Tally& other) {
        unread += other.unread;
        for (std::size_t b = 0; b < kBins; ++b) {
            bins[b].frames += other.bins[b].frames;
            bins[b].claimed += other.bins[b].claimed;
            for (std::size_t w = 0; w < kWrongs.size(); ++w)
                bins[b].wrong[w] += other.bins[b].wrong[w];
        }
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

    int read(int bit, Rng& rng) const {
        const int range = 127 - least_weight + 1;
        const int weight = least_weight + static_cast<int>(rng.below(static_cast<unsigned>(range)));
        const bool is_wrong = rng.uniform() * (1 + std::exp2(odds_log2 * weight / 127)) < 1;
        return (bit == 1) != is_wrong ? weight : -weight;
    }
};

void draw(Rng& rng, Reading& reading) {
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
    const Noise noise{rng.uniform(2.5, 9), rng.below(2) == 0 ? 0 : rng.uniform(0, 0.25),
                      rng.below(2) == 0 ? 127 : 8};
    // In some, blank paper beyond some column.
    const int visible = rng.below(3) == 0 ? 6 + static_cast<int>(rng.below(3)) : grid.columns;
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

Wrong kind(const Reading& reading, const Decoding& decoding) {
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

constexpr IntegrityOptions kAcceptAll{0, 256};

void try_grid(std::uint64_t seed, std::uint64_t index, Tally& tally) {
    Rng rng(seed, index);
    Reading reading;
    draw(rng, reading);
    Decoding decoding;
    decoding.window = core::choose_window(reading.grid, kWindowSide);
    decoding.region = core::choose_window(reading.grid, kMaxSide);
    std::array<LineScores, kMaxSide> storage;
    if (core::decode_all(reading.grid, reading.profile, storage, decoding) != Status::ok) {
        ++tally.unread;
        return;
    }
    const core::Nominal nominal(reading.grid, reading.profile, decoding);
    Fix fix;
    const Status status =
        core::verify(reading.grid, reading.profile, decoding, nominal, kAcceptAll, storage, fix);
    if (status != Status::ok) {
        ++tally.unread;
        return;
    }
    tally.add(fix.p_wrong_log2, kind(reading, decoding));
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

/// P(Poisson(mean) >= count).
double chance_of_as_many(std::uint64_t count, double mean) {
    double term = std::exp(-mean);
    double below = 0;
    for (std::uint64_t n = 0; n < count; ++n) {
        below += term;
        term *= mean / static_cast<double>(n + 1);
    }
    return std::max(1 - below, 0.0);
}

/// Returns whether all claims hold.
bool print(std::string_view title, const Tally& tally, bool with_kinds) {
    constexpr double kBeyondNoise = 1e-3;
    bool all_hold = true;
    fmt::print("\n{} ({} not read)\n{:>17} {:>9} {:>7} {:>10} {:>10}", title, tally.unread,
               "p_wrong", "read", "wrong", "rate", "claimed");
    if (with_kinds) {
        for (const char* name : kWrongNames)
            fmt::print(" {:>9}", name);
    }
    fmt::print("\n");
    for (std::size_t b = 0; b < Tally::kBins; ++b) {
        const Bin& bin = tally.bins[b];
        if (bin.frames == 0) continue;
        const std::uint64_t wrong = bin.all_wrong();
        const auto frames = static_cast<double>(bin.frames);
        const bool holds = chance_of_as_many(wrong, std::min(bin.claimed, 700.0)) > kBeyondNoise ||
                           static_cast<double>(wrong) <= bin.claimed;
        all_hold &= holds;
        const double high =
            std::ldexp(1.0, b == 0 ? 0 : -Tally::kWidth_log2 * static_cast<int>(b) + 2);
        const std::string range = b == 0 ? "1"
                                  : b + 1 < Tally::kBins
                                      ? fmt::format("{:.1e}..{:.1e}", high / 4, high)
                                      : fmt::format("up to {:.1e}", high);
        fmt::print("{:>17} {:>9} {:>7} {:>10.2e} {:>10.2e}", range, bin.frames, wrong,
                   static_cast<double>(wrong) / frames, bin.claimed / frames);
        if (with_kinds) {
            for (const std::uint64_t n : bin.wrong)
                fmt::print(" {:>9}", n);
        }
        fmt::print("{}\n", holds ? "" : "  MORE THAN CLAIMED");
    }
    return all_hold;
}

int run(const Arguments& arguments) {
    const auto start = std::chrono::steady_clock::now();
    const Tally grids = run_on_threads<Tally>(
        arguments.grids, arguments.threads,
        [&](std::uint64_t i, Tally& tally) { try_grid(arguments.seed, i, tally); });
    const Tally frames = run_on_threads<Tally>(
        arguments.frames, arguments.threads, [&](std::uint64_t i, Tally& tally) {
            thread_local const auto kWorkspace = std::make_unique<LargeWorkspace>();
            try_frame(arguments.seed, i, *kWorkspace, tally);
        });
    bool all_hold = print("Grids of 8 to 13 lines", grids, true);
    all_hold &= print("Rendered frames of 188 x 120 px", frames, false);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("\nseed {}, {:.0f} s with {} threads\n", arguments.seed, seconds.count(),
               arguments.threads);
    return all_hold ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(parse(argc, argv));
    } catch (const std::exception& error) {
        fmt::print(stderr, "dotpose_integrity: {}\n", error.what());
        return 2;
    }
}
