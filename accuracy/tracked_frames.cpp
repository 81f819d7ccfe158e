#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/core.h>

#include "../tests/adversarial_textures.hpp"
#include "tracked.hpp"

namespace dotpose::tables {
namespace {

constexpr double kBam_per_degree = 4294967296.0 / 360;

/// The error of a prediction: a distance and an angle.
struct Offset {
    double spacings;
    double degrees;
};
constexpr std::array kOffsets{Offset{0, 0},   Offset{0.1, 0}, Offset{0.2, 0}, Offset{0.3, 0},
                              Offset{0.4, 0}, Offset{0.5, 0}, Offset{0.6, 0}, Offset{0.7, 0},
                              Offset{0.9, 0}, Offset{0, 1},   Offset{0, 2},   Offset{0, 3},
                              Offset{0, 4},   Offset{0, 5},   Offset{0, 6},   Offset{0.3, 2},
                              Offset{0.5, 3}, Offset{0.6, 4}, Offset{0.9, 6}};

/// Returns the prediction from a fix, displaced by `offset` in a random direction.
Prediction displaced(const Fix& fix, const Offset& offset, Rng& rng) {
    const double direction = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double sign = rng.below(2) == 0 ? 1 : -1;
    const auto q16 = [](double v) { return static_cast<std::int32_t>(std::lround(v * 65536)); };
    return moved(
        Prediction::like(fix), CodeVariant::anoto,
        {q16(offset.spacings * std::cos(direction)), q16(offset.spacings * std::sin(direction))},
        static_cast<std::int32_t>(std::lround(sign * offset.degrees * kBam_per_degree)),
        fix.pattern_from_image.centre_q8);
}

Setup nominal(std::uint64_t seed) {
    Setup setup;
    setup.seed = seed;
    return setup;
}

/// Locates a frame without a prediction. If this succeeds, locates the frame again for each error
/// in kOffsets, with a prediction that has this error. Tally i + 1 counts the results for
/// kOffsets[i]. In tally 0, `afresh` counts the fixes without a prediction.
void try_offsets(const Shot& shot, TrackedTallies& tallies) {
    const GreyImage image = render(shot);
    const Fix fresh = Locator(thread_memory(), DeviceOptions{}).locate(image.view());
    if (fresh.status != Status::ok) return;
    const TrueView truth = TrueView::of(shot);
    ++tallies[0].afresh;
    tallies[0].errors_um.push_back(truth.error_um(fresh));
    Rng rng(shot.seed, 77);
    for (std::size_t i = 0; i < kOffsets.size(); ++i) {
        const Prediction prediction = displaced(fresh, kOffsets[i], rng);
        tallies[i + 1].count(
            Locator(thread_memory(), DeviceOptions{}).locate(image.view(), prediction), truth);
    }
}

void drive_on(Shot& shot, const Shot&, Rng& rng) {
    const double direction = rng.uniform(-std::numbers::pi, std::numbers::pi);
    const double way = rng.uniform(0, 0.5);
    constexpr double kMax_rad = 2 * std::numbers::pi / 180;
    shot.pose.fraction_x += way * std::cos(direction);
    shot.pose.fraction_y += way * std::sin(direction);
    shot.pose.theta_rad += rng.uniform(-kMax_rad, kMax_rad);
}

void change_light(Shot& shot, const Shot&, Rng& rng) {
    double& level = shot.imperfections.paper_level;
    level = std::min(level * rng.uniform(0.5, 1.5), 255.0);
}

void cover(Shot& shot, const Shot&, Rng& rng) {
    shot.imperfections.graphics = 1 + static_cast<int>(rng.below(3));
    shot.imperfections.dirt_blobs = static_cast<int>(rng.below(12));
}

void shade(Shot& shot, const Shot&, Rng& rng) {
    shot.imperfections.fall = rng.uniform(0.3, 1);
    shot.imperfections.fall_direction_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
}

void turn(Shot& shot, const Shot&, Rng& rng) {
    shot.pose.theta_rad +=
        rng.uniform(std::numbers::pi / 18, std::numbers::pi) * (rng.below(2) == 0 ? 1 : -1);
}

/// A change between the first and the second frame.
struct Change {
    const char* text;
    /// Changes the first shot into the second shot. `other` is a shot of another sheet. If the
    /// camera is lifted, `apply` is null, and `nothing_in_focus` returns the second frame.
    void (*apply)(Shot& shot, const Shot& other, Rng& rng);
};
constexpr std::array kChanges{
    Change{"nothing but noise", [](Shot&, const Shot&, Rng&) {}},
    Change{"driven on by up to 0.5 spacing, turned by up to 2 degrees", drive_on},
    Change{"light of 0.5 to 1.5 times as much", change_light},
    Change{"graphics and dirt came into view", cover},
    Change{"a light that falls off to one side", shade},
    Change{"lifted: nothing in focus", nullptr},
    Change{"turned by 10 to 180 degrees", turn},
    Change{"put on another sheet", [](Shot& shot, const Shot& other, Rng&) { shot = other; }},
};

/// Returns a frame without dots, as seen by a lifted camera that is out of focus.
GreyImage nothing_in_focus(const Shot& shot, Rng& rng) {
    return test::detail::painted(
        shot, [&](int, int) { return 120 + shot.imperfections.noise_sigma * rng.normal(); });
}

void try_changes(const Setup& setup, std::uint64_t index, TrackedTallies& tallies) {
    const Shot first = draw_shot(setup, 2 * index);
    const Shot other = draw_shot(setup, 2 * index + 1);
    const Fix seen = Locator(thread_memory(), DeviceOptions{}).locate(render(first).view());
    if (seen.status != Status::ok) return;
    Rng rng(first.seed, 78);
    for (std::size_t i = 0; i < kChanges.size(); ++i) {
        const bool is_lifted = kChanges[i].apply == nullptr;
        // The second frame has different noise but the same printing errors.
        Shot shot = first;
        shot.seed = rng.bits();
        if (!is_lifted) kChanges[i].apply(shot, other, rng);
        const GreyImage next = is_lifted ? nothing_in_focus(shot, rng) : render(shot);
        tallies[i].count(
            Locator(thread_memory(), DeviceOptions{}).locate(next.view(), Prediction::like(seen)),
            is_lifted ? std::nullopt : std::optional(TrueView::of(shot)));
    }
}

}  // namespace

TrackedTable offsets_table(const TableRun& run, std::uint64_t frames) {
    const auto count = run.count<TrackedTallies>(
        "predictions that are off", frames, [&](std::uint64_t i, TrackedTallies& tallies) {
            try_offsets(draw_shot(nominal(run.seed), i), tallies);
        });
    TrackedTable table;
    table.text =
        "| prediction off by, spacings | degrees | frames | tracked, % | afresh, % | no fix | "
        "wrong | error of the tracked, µm: median | 95 % |\n"
        "|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    TrackedTallies tallies = count.tally;
    for (std::size_t i = 0; i <= kOffsets.size(); ++i) {
        const TrackedTally& tally = tallies[i];
        const std::string what =
            i == 0 ? "no prediction | "
                   : fmt::format("{:g} | {:g}", kOffsets[i - 1].spacings, kOffsets[i - 1].degrees);
        table.text +=
            fmt::format("| {} | {} | {:.1f} | {:.1f} | {} | {} | {} |\n", what, tally.all(),
                        tally.percent(tally.tracked), tally.percent(tally.afresh), tally.none,
                        tally.wrong(), tally.errors());
    }
    table.wrong = tallies.wrong();
    table.is_complete = count.is_complete();
    return table;
}

TrackedTable changes_table(const TableRun& run, std::uint64_t frames) {
    const auto count = run.count<TrackedTallies>("frames that change", frames,
                                                 [&](std::uint64_t i, TrackedTallies& tallies) {
                                                     try_changes(nominal(run.seed), i, tallies);
                                                 });
    TrackedTable table;
    table.text =
        "| since the frame before | frames | tracked, % | afresh, % | no fix, % | wrong |\n"
        "|---|--:|--:|--:|--:|--:|\n";
    TrackedTallies tallies = count.tally;
    for (std::size_t i = 0; i < kChanges.size(); ++i) {
        const TrackedTally& tally = tallies[i];
        table.text +=
            fmt::format("| {} | {} | {:.1f} | {:.1f} | {:.1f} | {} |\n", kChanges[i].text,
                        tally.all(), tally.percent(tally.tracked), tally.percent(tally.afresh),
                        tally.percent(tally.none), tally.wrong());
    }
    table.wrong = tallies.wrong();
    table.is_complete = count.is_complete();
    return table;
}

}  // namespace dotpose::tables
