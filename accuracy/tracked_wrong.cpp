#include <array>
#include <optional>

#include <fmt/core.h>

#include "../tests/adversarial_textures.hpp"
#include "tracked.hpp"

namespace dotpose::tables {
namespace {

/// A class of wrong predictions, or of images for which every prediction is wrong.
struct WrongClass {
    const char* name;
    /// Error of the prediction in cells, for the classes that have one.
    int dx = 0;
    int dy = 0;
};

enum WrongKind : std::size_t {
    another_frame,
    elsewhere,
    far_on_one_axis,
    one_x,
    one_y,
    one_both,
    two_x,
    two_y,
    two_both,
    section,
    alternative_x,
    alternative_y,
    blank,
    noise,
    text,
    halftone,
    texture,
    plain_grid,
    random_symbols,
    scattered,
    mirrored,
    kind_count,
};
constexpr std::array<WrongClass, kind_count> kWrongClasses{{
    {"another frame's"},
    {"the same lattice, elsewhere in the code"},
    {"the same, elsewhere on one axis"},
    {"one cell off in x", 1, 0},
    {"one cell off in y", 0, 1},
    {"one cell off in both", 1, 1},
    {"two cells off in x", 2, 0},
    {"two cells off in y", 0, 2},
    {"two cells off in both", 2, 2},
    {"another section"},
    {"the worst alternative in x"},
    {"the worst alternative in y"},
    {"right, but the paper is blank"},
    {"right, but there is noise"},
    {"right, but there is text"},
    {"right, but there is a printed screen"},
    {"right, but there is texture"},
    {"right, but all dots are on their intersections"},
    {"right, but the symbols are random"},
    {"right, but the dots are scattered"},
    {"right, but the pattern is seen from behind"},
}};

/// A frame whose fix is right, and another frame.
struct LocatedPair {
    Shot shot;
    GreyImage image;
    Fix fix;
    Fix other_fix;
};

std::int32_t between(std::uint32_t from, std::uint32_t to) {
    return static_cast<std::int32_t>(static_cast<std::int64_t>(to) - from);
}

/// Returns a prediction of the wrong position that shares the most of the 10 to 16 lines in the
/// middle of the view, which shows 11 to 18 lines.
Prediction alternative_of(const Fix& fix, bool is_along_x, Rng& rng) {
    const std::int32_t before = 5 + static_cast<std::int32_t>(rng.below(4));
    Prediction prediction = Prediction::like(fix);
    const Place middle{fix.cell, fix.section};
    const Place first =
        moved(Profile::anoto, middle, is_along_x ? -before : 0, is_along_x ? 0 : -before);
    const Place alternative = worst_alternative(Profile::anoto, first, is_along_x, 2 * before);
    prediction.place = moved(Profile::anoto, alternative, between(first.cell.x, fix.place.cell.x),
                             between(first.cell.y, fix.place.cell.y));
    return prediction;
}

Prediction predicted(std::size_t kind, const LocatedPair& views, Rng& rng) {
    Prediction prediction = Prediction::like(kind == another_frame ? views.other_fix : views.fix);
    Place& place = prediction.place;
    const auto anywhere = [&rng] { return 100 + rng.below(kPositionsPerAxis - 200); };
    const auto any_section = [&rng] { return static_cast<std::uint8_t>(rng.below(kSections)); };
    switch (kind) {
        case elsewhere:
            place = {{anywhere(), anywhere()}, {any_section(), any_section()}};
            break;
        case far_on_one_axis:
            (rng.below(2) == 0 ? place.cell.x : place.cell.y) = anywhere();
            break;
        case section: {
            std::uint8_t& one = rng.below(2) == 0 ? place.section.u : place.section.v;
            one = static_cast<std::uint8_t>((one + 1 + rng.below(kSections - 1)) % kSections);
            break;
        }
        case alternative_x:
        case alternative_y:
            return alternative_of(views.fix, kind == alternative_x, rng);
        default: {
            const auto either = [&rng](int step) { return rng.below(2) == 0 ? step : -step; };
            place = moved(Profile::anoto, place, either(kWrongClasses[kind].dx),
                          either(kWrongClasses[kind].dy));
        }
    }
    return prediction;
}

/// Returns an image of the same camera without a valid code, on the same grid.
GreyImage without_code(std::size_t kind, const Shot& shot, Rng& rng) {
    switch (kind) {
        case noise:
            return test::detail::noise(shot, rng);
        case text:
            return render_scene(Scene::text, shot);
        case halftone:
            return test::detail::halftone(shot, rng);
        case texture:
            return test::detail::texture(shot, rng);
        case plain_grid:
            return render_scene(Scene::plain_grid, shot);
        case random_symbols:
            return render_scene(Scene::random_symbols, shot);
        case scattered:
            return render_scene(Scene::scattered_dots, shot, rng.uniform(0.1, 1));
        case mirrored:
            return render_scene(Scene::mirrored, shot);
        default:
            return render_scene(Scene::white, shot);
    }
}

void try_all(std::uint64_t seed, std::uint64_t index, TrackedTallies& tallies) {
    Setup setup;
    setup.seed = seed;
    LocatedPair views;
    views.shot = draw_shot(setup, 2 * index);
    const Shot other = draw_shot(setup, 2 * index + 1);
    views.image = render(views.shot);
    const GreyImage other_image = render(other);
    views.fix = Locator(thread_memory()).locate(views.image.view());
    views.other_fix = Locator(thread_memory()).locate(other_image.view());
    if (views.fix.status != Status::ok || views.other_fix.status != Status::ok) return;
    Rng rng(views.shot.seed, 79);
    for (std::size_t kind = 0; kind < kind_count; ++kind) {
        const Prediction prediction = predicted(kind, views, rng);
        if (kind < blank) {
            tallies[kind].count(Locator(thread_memory()).locate(views.image.view(), prediction),
                                TrueView::of(views.shot));
        } else {
            const GreyImage image = without_code(kind, views.shot, rng);
            tallies[kind].count(Locator(thread_memory()).locate(image.view(), prediction),
                                std::nullopt);
        }
    }
}

}  // namespace

TrackedTable wrong_predictions_table(const TableRun& run, std::uint64_t predictions) {
    const auto count = run.count<TrackedTallies>(
        "frames with wrong predictions", (predictions + kind_count - 1) / kind_count,
        [&](std::uint64_t i, TrackedTallies& tallies) { try_all(run.seed, i, tallies); });
    TrackedTable table;
    table.text =
        "| the prediction is | predictions | wrong position, tracked | the right one, tracked | "
        "the right one, afresh | no fix | wrong, afresh |\n"
        "|---|--:|--:|--:|--:|--:|--:|\n";
    TrackedTallies tallies = count.tally;
    TrackedTally all;
    const auto row = [&table](const char* name, const TrackedTally& tally) {
        table.text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", name, tally.all(),
                                  tally.tracked_wrong, tally.tracked, tally.afresh, tally.none,
                                  tally.afresh_wrong);
    };
    for (std::size_t kind = 0; kind < kind_count; ++kind) {
        row(kWrongClasses[kind].name, tallies[kind]);
        all += tallies[kind];
    }
    row("all", all);
    table.wrong = tallies.wrong();
    table.is_complete = count.is_complete();
    return table;
}

}  // namespace dotpose::tables
