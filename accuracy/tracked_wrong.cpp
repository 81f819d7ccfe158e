#include <array>
#include <optional>

#include <fmt/core.h>

#include "../tests/adversarial_textures.hpp"
#include "tracked.hpp"

namespace dotpose::tables {
namespace {

/// A correctly located frame with its fix, and the fix of another frame.
struct LocatedPair {
    Shot shot;
    GreyImage image;
    Fix fix;
    Fix other_fix;
};

std::int32_t between(std::uint32_t from, std::uint32_t to) {
    return static_cast<std::int32_t>(static_cast<std::int64_t>(to) - from);
}

/// Returns a prediction of the wrong position that shares the most lines with the true position.
/// The view shows 11 to 18 lines. Only the 10 to 16 lines in its middle are compared.
template <bool is_along_x>
Prediction worst(const LocatedPair& views, Rng& rng) {
    const Fix& fix = views.fix;
    const std::int32_t before = 5 + static_cast<std::int32_t>(rng.below(4));
    Prediction prediction = Prediction::like(fix);
    const Place middle{fix.cell, fix.section};
    const Place first =
        moved(CodeVariant::anoto, middle, is_along_x ? -before : 0, is_along_x ? 0 : -before);
    const Place alternative = worst_alternative(CodeVariant::anoto, first, is_along_x, 2 * before);
    prediction.place =
        moved(CodeVariant::anoto, alternative, between(first.cell.x, fix.place.cell.x),
              between(first.cell.y, fix.place.cell.y));
    return prediction;
}

/// Returns a prediction that is displaced by `dx` cells along x and by `dy` cells along y. The
/// signs of the displacements are random.
Prediction displaced(const Fix& fix, int dx, int dy, Rng& rng) {
    Prediction prediction = Prediction::like(fix);
    const auto either = [&rng](int step) { return rng.below(2) == 0 ? step : -step; };
    prediction.place = moved(CodeVariant::anoto, prediction.place, either(dx), either(dy));
    return prediction;
}

template <int dx, int dy>
Prediction displaced(const LocatedPair& views, Rng& rng) {
    return displaced(views.fix, dx, dy, rng);
}

Prediction from_other_frame(const LocatedPair& views, Rng& rng) {
    return displaced(views.other_fix, 0, 0, rng);
}

std::uint32_t any_position(Rng& rng) {
    return 100 + rng.below(kPositionsPerAxis - 200);
}

std::uint8_t any_section(Rng& rng) {
    return static_cast<std::uint8_t>(rng.below(kSections));
}

Prediction elsewhere(const LocatedPair& views, Rng& rng) {
    Prediction prediction = Prediction::like(views.fix);
    prediction.place = {{any_position(rng), any_position(rng)},
                        {any_section(rng), any_section(rng)}};
    return prediction;
}

Prediction elsewhere_on_one_axis(const LocatedPair& views, Rng& rng) {
    Prediction prediction = Prediction::like(views.fix);
    Cell& cell = prediction.place.cell;
    (rng.below(2) == 0 ? cell.x : cell.y) = any_position(rng);
    return prediction;
}

Prediction in_another_section(const LocatedPair& views, Rng& rng) {
    Prediction prediction = Prediction::like(views.fix);
    Section& section = prediction.place.section;
    std::uint8_t& one = rng.below(2) == 0 ? section.u : section.v;
    one = static_cast<std::uint8_t>((one + 1 + rng.below(kSections - 1)) % kSections);
    return prediction;
}

template <Scene scene>
GreyImage image_of(const Shot& shot, Rng&) {
    return render_scene(scene, shot);
}

GreyImage scattered_dots(const Shot& shot, Rng& rng) {
    return render_scene(Scene::scattered_dots, shot, rng.uniform(0.1, 1));
}

struct WrongClass {
    const char* name;
    Prediction (*predict)(const LocatedPair& views, Rng& rng);
    /// Renders a scene without a valid code, as seen by the camera of the shot. Every prediction
    /// for this scene is wrong. Null if the class uses the image of the shot.
    GreyImage (*draw)(const Shot& shot, Rng& rng) = nullptr;
};
constexpr Prediction (*kRight)(const LocatedPair&, Rng&) = displaced<0, 0>;
constexpr std::array kWrongClasses{
    WrongClass{"another frame's", from_other_frame},
    WrongClass{"the same lattice, elsewhere in the code", elsewhere},
    WrongClass{"the same, elsewhere on one axis", elsewhere_on_one_axis},
    WrongClass{"one cell off in x", displaced<1, 0>},
    WrongClass{"one cell off in y", displaced<0, 1>},
    WrongClass{"one cell off in both", displaced<1, 1>},
    WrongClass{"two cells off in x", displaced<2, 0>},
    WrongClass{"two cells off in y", displaced<0, 2>},
    WrongClass{"two cells off in both", displaced<2, 2>},
    WrongClass{"another section", in_another_section},
    WrongClass{"the worst alternative in x", worst<true>},
    WrongClass{"the worst alternative in y", worst<false>},
    WrongClass{"right, but the paper is blank", kRight, image_of<Scene::white>},
    WrongClass{"right, but there is noise", kRight, test::detail::noise},
    WrongClass{"right, but there is text", kRight, image_of<Scene::text>},
    WrongClass{"right, but there is a printed screen", kRight, test::detail::halftone},
    WrongClass{"right, but there is texture", kRight, test::detail::texture},
    WrongClass{"right, but all dots are on their intersections", kRight,
               image_of<Scene::plain_grid>},
    WrongClass{"right, but the symbols are random", kRight, image_of<Scene::random_symbols>},
    WrongClass{"right, but the dots are scattered", kRight, scattered_dots},
    WrongClass{"right, but the pattern is seen from behind", kRight, image_of<Scene::mirrored>},
};

void try_all(std::uint64_t seed, std::uint64_t index, TrackedTallies& tallies) {
    Setup setup;
    setup.seed = seed;
    LocatedPair views;
    views.shot = draw_shot(setup, 2 * index);
    const Shot other = draw_shot(setup, 2 * index + 1);
    views.image = render(views.shot);
    const GreyImage other_image = render(other);
    views.fix = Locator(thread_memory(), DeviceOptions{}).locate(views.image.view());
    views.other_fix = Locator(thread_memory(), DeviceOptions{}).locate(other_image.view());
    if (views.fix.status != Status::ok || views.other_fix.status != Status::ok) return;
    Rng rng(views.shot.seed, 79);
    for (std::size_t i = 0; i < kWrongClasses.size(); ++i) {
        const auto& [name, predict, draw] = kWrongClasses[i];
        const Prediction prediction = predict(views, rng);
        const GreyImage image = draw == nullptr ? views.image : draw(views.shot, rng);
        tallies[i].count(Locator(thread_memory(), DeviceOptions{}).locate(image.view(), prediction),
                         draw == nullptr ? std::optional(TrueView::of(views.shot)) : std::nullopt);
    }
}

}  // namespace

TrackedTable wrong_predictions_table(const TableRun& run, std::uint64_t predictions) {
    const auto count = run.count<TrackedTallies>(
        "frames with wrong predictions",
        (predictions + kWrongClasses.size() - 1) / kWrongClasses.size(),
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
    for (std::size_t i = 0; i < kWrongClasses.size(); ++i) {
        row(kWrongClasses[i].name, tallies[i]);
        all += tallies[i];
    }
    row("all", all);
    table.wrong = tallies.wrong();
    table.is_complete = count.is_complete();
    return table;
}

}  // namespace dotpose::tables
