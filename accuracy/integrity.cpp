// Compares p_wrong, the upper bound on the probability that a position is wrong, with the frequency
// of wrong positions. Accepts all readings, and groups them by p_wrong.
//
//   dotpose_tables integrity [--grids N] [--doubtful N] [--frames N] [--seed S] [--threads N]
//
// A grid consists of bits with random errors and is decoded without an image. As in the model from
// which p_wrong is computed, the errors are independent, and bits of larger weight have fewer
// errors. In doubtful grids, the number of errors is chosen so that p_wrong is between 1e-5 and
// 1e-3. In this range, wrong positions are frequent enough to show whether p_wrong is too small.
// Frames are images of patterns with flipped bits. They are read by `locate`.
//
// The exit status is 1 if significantly more positions are wrong than p_wrong predicts. Ctrl-C ends
// the run early and prints the results so far.
#include "integrity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "../tests/altered_pattern.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

// ---- Frames ----

void try_flipped_frame(std::uint64_t seed, std::uint64_t index, IntegrityTally& tally) {
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
    DeviceOptions options;
    options.integrity = kAcceptAll;
    const Fix fix = Locator(thread_memory(), options).locate(image.view());
    if (fix.status != Status::ok) {
        ++tally.unread;
        return;
    }
    const double theta =
        std::remainder(fix.theta_rad() - shot.pose.theta_rad, 2 * std::numbers::pi);
    const bool is_right = std::abs(fix.x_grid() - x_grid(shot.pose)) < 1 &&
                          std::abs(fix.y_grid() - y_grid(shot.pose)) < 1 && std::abs(theta) < 0.2 &&
                          fix.section == pattern.section;
    tally.add(fix.p_wrong_log2, !is_right);
}

// ---- Result ----

/// Returns P(X <= count) for a Poisson variable X with mean `mean`.
double poisson_at_most(std::uint64_t count, double mean) {
    double sum = 0;
    for (std::uint64_t n = 0; n <= count; ++n) {
        const auto k = static_cast<double>(n);
        sum += std::exp(k * std::log(mean) - mean - std::lgamma(k + 1));
    }
    return sum;
}

/// Returns P(X >= count) for a Poisson variable X with mean `mean`.
double poisson_at_least(std::uint64_t count, double mean) {
    return count == 0 || mean <= 0 ? 1 : 1 - poisson_at_most(count - 1, mean);
}

/// Returns the upper 95 % confidence limit for the mean of a Poisson variable whose observed value
/// is `count`.
double upper_limit(std::uint64_t count) {
    double low = static_cast<double>(count);
    double high = 2 * low + 10;
    while (high - low > 1e-6 * high) {
        const double mean = (low + high) / 2;
        (poisson_at_most(count, mean) > 0.05 ? low : high) = mean;
    }
    return high;
}

/// Returns true if the number of wrong positions is consistent with p_wrong, at a significance
/// level of 0.001.
bool holds(const Bin& bin) {
    return static_cast<double>(bin.wrong) <= bin.predicted ||
           poisson_at_least(bin.wrong, bin.predicted) > 1e-3;
}

/// Prints the counts of all readings, grouped by p_wrong. The first range contains only p_wrong =
/// 1, and the last range has no lower limit. All other ranges are a factor of 8 wide. Returns true
/// if the counts in all ranges are consistent with p_wrong.
bool print(std::string_view title, const IntegrityTally& tally) {
    constexpr std::size_t kWidth_log2 = 3;
    constexpr std::size_t kLast = 34;  // first bin of the last range, which has no lower limit
    bool all_hold = true;
    fmt::print("\n{} ({} not read{})\n{:>17} {:>9} {:>7} {:>10} {:>10}\n", title, tally.unread,
               tally.skipped > 0 ? fmt::format(", {} skipped", tally.skipped) : "", "p_wrong",
               "read", "wrong", "rate", "predicted");
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
        fmt::print("{:>17} {:>9} {:>7} {:>10.2e} {:>10.2e}{}\n", range, bin.frames, bin.wrong,
                   static_cast<double>(bin.wrong) / frames, bin.predicted / frames,
                   holds(bin) ? "" : "  MORE THAN PREDICTED");
        all_hold &= holds(bin);
    }
    return all_hold;
}

/// Prints the counts of the readings with p_wrong near 1e-3, 1e-4 and 1e-5, with upper confidence
/// limits for the true rates. Each of the three ranges is a factor of 8 wide. Returns true if the
/// counts in all ranges are consistent with p_wrong.
bool print_doubtful(const IntegrityTally& tally) {
    bool all_hold = true;
    fmt::print("\n{:>15} {:>9} {:>7} {:>10} {:>16} {:>13}\n", "p_wrong", "read", "wrong", "rate",
               "95 % upper limit", "predicted");
    for (const std::size_t middle : {10U, 13U, 17U}) {
        const Bin bin = tally.sum(middle - 1, middle + 1);
        const auto frames = static_cast<double>(std::max<std::uint64_t>(bin.frames, 1));
        const double limit = upper_limit(bin.wrong) / frames;
        const double predicted = bin.predicted / frames;
        const char* verdict = !holds(bin)          ? "MORE THAN PREDICTED"
                              : limit <= predicted ? "shown"
                                                   : "too few to tell";
        fmt::print("{:>15} {:>9} {:>7} {:>10.2e} {:>16.2e} {:>13.2e}  {}\n",
                   fmt::format("2^-{}..2^-{}", middle + 1, middle - 1), bin.frames, bin.wrong,
                   static_cast<double>(bin.wrong) / frames, limit, predicted, verdict);
        all_hold &= holds(bin);
    }
    return all_hold;
}

}  // namespace

bool integrity_table(TableRun& run) {
    std::uint64_t grids = 200'000;
    std::uint64_t doubtful = 200'000;
    std::uint64_t frames = 4'000;
    run.add_count("--grids", grids, "Grids with errors of all rates");
    run.add_count("--doubtful", doubtful, "Grids whose p_wrong is near 1e-3 to 1e-5");
    run.add_count("--frames", frames, "Rendered frames");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;

    using Counted = Count<IntegrityTally>;
    const auto count_grids = [&](const char* what, GridKind kind, std::uint64_t count) -> Counted {
        return run.count<IntegrityTally>(what, count, [&](std::uint64_t i, IntegrityTally& tally) {
            try_grid(kind, run.seed, i, tally);
        });
    };
    const Counted any = count_grids("grids", GridKind::any, grids);
    const Counted near = count_grids("doubtful grids", GridKind::doubtful, doubtful);
    const Counted rendered = run.count<IntegrityTally>(
        "frames", frames,
        [&](std::uint64_t i, IntegrityTally& tally) { try_flipped_frame(run.seed, i, tally); });
    bool all_hold = print("Grids of 8 to 13 lines", any.tally);
    all_hold &= print("Doubtful grids of 8 to 13 lines", near.tally);
    all_hold &= print_doubtful(near.tally);
    all_hold &= print("Rendered frames of 188 x 120 px", rendered.tally);
    fmt::print("\nseed {}, {} threads\n{}\n{}\n{}\n", run.seed, run.threads,
               any.speed_text("grids"), near.speed_text("doubtful grids"),
               rendered.speed_text("frames"));
    return all_hold && any.is_complete() && near.is_complete() && rendered.is_complete();
}

}  // namespace dotpose::tables
