/// Frames designed to provoke wrong fixes, and the acceptable poses for each frame. A frame is
/// determined by its adversary, seed and index.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "adversarial_textures.hpp"
#include "altered_pattern.hpp"
#include "dotpose/device_options.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::test {

enum class Adversary : std::uint8_t {
    noise,           ///< dark grains of 1 to 4 px
    text,            ///< a page of printed words
    halftone,        ///< a printed halftone screen with dots of varying size
    texture,         ///< 1/f noise, thresholded in some frames
    plain_grid,      ///< dots on the intersections, without displacement
    random_symbols,  ///< a perfect grid with random symbols
    random_offsets,  ///< dots displaced by the nominal length in a random direction
    scattered_dots,
    seam,        ///< two sections that meet at a border anywhere in the frame
    cut,         ///< two distant parts of the pattern, joined at a border
    overlay,     ///< two patterns printed on top of each other
    mirrored,    ///< the mirrored pattern
    replaced,    ///< 30 to 60 % of the symbols are random
    flipped,     ///< 5 to 45 % of the bits are flipped
    half_empty,  ///< only one side of the frame contains a pattern
    few_lines,   ///< 5 to 8 columns or rows on blank paper
    slip,        ///< one column or row of dots is missing or occurs twice
    other_code,  ///< a pattern in the `anoto` code that is decoded as `libdots`, or vice versa
};
inline constexpr std::array kAdversaries = {Adversary::noise,          Adversary::text,
                                            Adversary::halftone,       Adversary::texture,
                                            Adversary::plain_grid,     Adversary::random_symbols,
                                            Adversary::random_offsets, Adversary::scattered_dots,
                                            Adversary::seam,           Adversary::cut,
                                            Adversary::overlay,        Adversary::mirrored,
                                            Adversary::replaced,       Adversary::flipped,
                                            Adversary::half_empty,     Adversary::few_lines,
                                            Adversary::slip,           Adversary::other_code};

constexpr std::string_view name(Adversary adversary) {
    constexpr std::array<std::string_view, kAdversaries.size()> kNames = {
        "noise",          "text",      "halftone",   "texture",   "plain grid", "random symbols",
        "random offsets", "scattered", "seam",       "cut",       "overlay",    "mirrored",
        "replaced",       "flipped",   "half empty", "few lines", "slip",       "other code"};
    return kNames[static_cast<std::size_t>(adversary)];
}

struct Answer {
    CameraPose pose;
    Section section;
};

struct AdversarialFrame {
    GreyImage image;
    DeviceOptions options;
    /// Acceptable poses. The first is the pose of the pattern at the image centre. If the list is
    /// empty, every fix is wrong.
    std::vector<Answer> answers;
    Pattern printed;
};

enum class Verdict : std::uint8_t {
    refused,
    right,
    second,  ///< the pose of another part of the pattern, extrapolated to the image centre
    twin,    ///< a wrong position where `options.code` matches the print (see `is_twin`)
    wrong,
};

namespace detail {

inline bool agrees(const Fix& fix, const Answer& answer) {
    const double theta =
        std::remainder(fix.theta_rad() - answer.pose.theta_rad, 2 * std::numbers::pi);
    return std::hypot(fix.x_grid() - x_grid(answer.pose), fix.y_grid() - y_grid(answer.pose)) <
               0.5 &&
           std::abs(theta) < 0.1 && fix.section == answer.section;
}

/// Returns true if the pattern was printed in a code other than `frame.options.code`, but also
/// matches that code at the fix. The pattern matches if at least three quarters of the bits of
/// `frame.options.code` around the fix equal the bits printed around the first answer.
inline bool is_twin(const Fix& fix, const AdversarialFrame& frame) {
    if (frame.answers.empty() || frame.options.code == frame.printed.code) return false;
    const Answer& answer = frame.answers.front();
    const auto there = [](double value) { return static_cast<std::uint32_t>(std::llround(value)); };
    const Cell found{there(fix.x_grid()), there(fix.y_grid())};
    const Cell real{there(x_grid(answer.pose)), there(y_grid(answer.pose))};
    constexpr std::int32_t kReach = 5;
    constexpr int kBits = 2 * (2 * kReach + 1) * (2 * kReach + 1);
    int different = 0;
    for (std::int32_t y = -kReach; y <= kReach; ++y) {
        for (std::int32_t x = -kReach; x <= kReach; ++x) {
            const Place a = moved(frame.options.code, {found, fix.section}, x, y);
            const Place b = moved(frame.printed.code, {real, answer.section}, x, y);
            const Symbol one = symbol_at(frame.options.code, a.cell, a.section);
            const Symbol other = symbol_at(frame.printed.code, b.cell, b.section);
            different += (x_bit(one) != x_bit(other)) + (y_bit(one) != y_bit(other));
        }
    }
    return 4 * different <= kBits;
}

inline Section random_section(Rng& rng) {
    return {static_cast<std::uint8_t>(rng.below(kSections)),
            static_cast<std::uint8_t>(rng.below(kSections))};
}

/// Returns half the width of the view, in cells.
inline int reach_cells(const Shot& shot) {
    const double cells =
        shot.camera.width_px * shot.camera.mm_per_px / shot.page.pattern.spacing_mm;
    return static_cast<int>(cells / 2);
}

/// Two parts of the pattern that are joined at a border. Beyond the border, the frame shows the
/// pattern at an offset of (`other_x`, `other_y`) cells, in the same section or another one.
struct Joint {
    bool is_vertical;
    std::uint32_t border;
    std::int32_t other_x, other_y;
    Section beyond;

    bool is_beyond(Cell cell) const { return (is_vertical ? cell.x : cell.y) >= border; }
};

inline void render_joint(const Shot& shot, const Joint& joint, AdversarialFrame& frame) {
    const Pattern pattern = shot.page.pattern;
    const auto shifted = [&](Cell cell) {
        return moved(pattern.code, {cell, joint.beyond}, joint.other_x, joint.other_y);
    };
    frame.image = render_dots(shot, [&](Cell cell) {
        const Place place = joint.is_beyond(cell) ? shifted(cell) : Place{cell, pattern.section};
        return displacement_of(symbol_at(pattern.code, place.cell, place.section));
    });
    const Place beyond = shifted(shot.pose.cell);
    Answer answer{shot.pose, beyond.section};
    answer.pose.cell = beyond.cell;
    frame.answers = {{shot.pose, pattern.section}, answer};
    if (joint.is_beyond(shot.pose.cell)) std::swap(frame.answers[0], frame.answers[1]);
}

inline Joint random_joint(const Shot& shot, Rng& rng) {
    const int reach = reach_cells(shot);
    const bool is_vertical = rng.below(2) == 0;
    const std::uint32_t here = is_vertical ? shot.pose.cell.x : shot.pose.cell.y;
    const auto offset = static_cast<int>(rng.below(static_cast<unsigned>(2 * reach + 1))) - reach;
    return {is_vertical, here + static_cast<std::uint32_t>(offset), 0, 0,
            shot.page.pattern.section};
}

inline void render_overlay(const Shot& shot, Rng& rng, AdversarialFrame& frame) {
    const Imperfections& seen = shot.imperfections;
    Shot other = shot;
    other.page.pattern.section = random_section(rng);
    other.pose.cell = {rng.below(kPositionsPerAxis - 200) + 100,
                       rng.below(kPositionsPerAxis - 200) + 100};
    other.pose.fraction_x = rng.uniform();
    other.pose.fraction_y = rng.uniform();
    if (rng.below(2) == 0) other.pose.theta_rad = rng.uniform(-3, 3);
    simulate::Ink ink;
    for (const Shot* s : {&shot, static_cast<const Shot*>(&other)}) {
        const simulate::View view(s->camera, s->pose, seen);
        simulate::add_dots(ink, view, s->page, seen, simulate::code_of(s->page.pattern));
    }
    const simulate::View view(shot.camera, shot.pose, seen);
    frame.image =
        simulate::read_out(simulate::expose(ink, view, shot.page, seen), shot.camera, seen, rng);
    frame.answers = {{shot.pose, shot.page.pattern.section},
                     {other.pose, other.page.pattern.section}};
}

/// Renders the pattern with some symbols changed. The correct answer is still the pose of the shot.
inline void render_changed(Adversary adversary, const Shot& shot, Rng& rng,
                           AdversarialFrame& frame) {
    const Pattern pattern = shot.page.pattern;
    const double fraction =
        adversary == Adversary::replaced ? rng.uniform(0.3, 0.6) : rng.uniform(0.05, 0.45);
    frame.image = render_dots(shot, [&](Cell cell) {
        if (adversary == Adversary::flipped) {
            return displacement_of(flipped_symbol(pattern, fraction, shot.seed, cell));
        }
        Rng here = rng_of(shot.seed, cell);
        return displacement_of(here.uniform() < fraction
                                   ? static_cast<Symbol>(here.below(4))
                                   : symbol_at(pattern.code, cell, pattern.section));
    });
    frame.answers = {{shot.pose, pattern.section}};
}

/// Renders a pattern with only some of its columns or rows printed.
inline void render_part(Adversary adversary, Shot shot, Rng& rng, AdversarialFrame& frame) {
    constexpr std::uint32_t kFar = 1000;
    const int reach = reach_cells(shot);
    const bool has_few = adversary == Adversary::few_lines;
    std::uint32_t lines = has_few ? 5 + rng.below(4) : kFar;
    // A pattern that consists of a few lines may be anywhere in the view. If half of the pattern is
    // empty, the border between the two halves is near the middle of the view.
    const int spread = has_few ? reach : reach / 3;
    const auto offset = static_cast<int>(rng.below(static_cast<unsigned>(2 * spread + 1))) - spread;
    const bool is_vertical = rng.below(2) == 0;
    const bool is_before = !has_few && rng.below(2) == 0;
    const auto first = [&](std::uint32_t here) {
        return static_cast<std::uint32_t>(static_cast<int>(here) + offset -
                                          static_cast<int>(has_few     ? lines / 2
                                                           : is_before ? lines
                                                                       : 0));
    };
    shot.page.columns = is_vertical ? lines : 2 * kFar;
    shot.page.rows = is_vertical ? 2 * kFar : lines;
    shot.page.origin = is_vertical ? Cell{first(shot.pose.cell.x), shot.pose.cell.y - kFar}
                                   : Cell{shot.pose.cell.x - kFar, first(shot.pose.cell.y)};
    frame.image = render(shot);
    frame.answers = {{shot.pose, shot.page.pattern.section}};
}

inline void render_random_dots(Adversary adversary, const Shot& shot, AdversarialFrame& frame) {
    frame.image = render_dots(shot, [&](Cell cell) {
        Rng here = rng_of(shot.seed, cell);
        if (adversary == Adversary::plain_grid) return Vec2{};
        if (adversary == Adversary::random_symbols) {
            return displacement_of(static_cast<Symbol>(here.below(4)));
        }
        const double direction = here.uniform(0, 2 * std::numbers::pi);
        return Vec2{std::cos(direction), std::sin(direction)};
    });
}

inline Shot shot_of(Adversary adversary, std::uint64_t seed, std::uint64_t index) {
    Setup setup;
    setup.seed = seed * kAdversaries.size() + static_cast<std::uint64_t>(adversary);
    constexpr std::array kConditions{Preset::clean, Preset::nominal, Preset::hard};
    setup.preset = kConditions[index % kConditions.size()];
    if (index % 16 == 15) {
        setup.camera.width_px = 320;
        setup.camera.height_px = 240;
    }
    return draw_shot(setup, index);
}

}  // namespace detail

inline AdversarialFrame make_adversarial(Adversary adversary, std::uint64_t seed,
                                         std::uint64_t index) {
    Shot shot = detail::shot_of(adversary, seed, index);
    Rng rng(shot.seed);
    AdversarialFrame frame;
    frame.printed = shot.page.pattern;
    const auto scene = [&](Scene s, double density = 0.5) {
        frame.image = render_scene(s, shot, density);
    };
    switch (adversary) {
        case Adversary::noise:
            frame.image = detail::noise(shot, rng);
            break;
        case Adversary::text:
            scene(Scene::text);
            break;
        case Adversary::halftone:
            frame.image = detail::halftone(shot, rng);
            break;
        case Adversary::texture:
            frame.image = detail::texture(shot, rng);
            break;
        case Adversary::plain_grid:
        case Adversary::random_symbols:
        case Adversary::random_offsets:
            detail::render_random_dots(adversary, shot, frame);
            break;
        case Adversary::scattered_dots:
            scene(Scene::scattered_dots, rng.uniform(0.1, 1));
            break;
        case Adversary::seam: {
            detail::Joint joint = detail::random_joint(shot, rng);
            joint.beyond = detail::random_section(rng);
            detail::render_joint(shot, joint, frame);
            break;
        }
        case Adversary::cut: {
            detail::Joint joint = detail::random_joint(shot, rng);
            joint.other_x = static_cast<std::int32_t>(rng.below(2000));
            joint.other_y = static_cast<std::int32_t>(rng.below(2000));
            detail::render_joint(shot, joint, frame);
            break;
        }
        case Adversary::overlay:
            detail::render_overlay(shot, rng, frame);
            break;
        case Adversary::mirrored:
            scene(Scene::mirrored);
            break;
        case Adversary::replaced:
        case Adversary::flipped:
            detail::render_changed(adversary, shot, rng, frame);
            break;
        case Adversary::half_empty:
        case Adversary::few_lines:
            detail::render_part(adversary, shot, rng, frame);
            break;
        case Adversary::slip: {
            detail::Joint joint = detail::random_joint(shot, rng);
            const int step = rng.below(2) == 0 ? 1 : -1;
            (joint.is_vertical ? joint.other_x : joint.other_y) = step;
            detail::render_joint(shot, joint, frame);
            break;
        }
        case Adversary::other_code: {
            const bool prints_anoto = rng.below(2) == 0;
            shot.page.pattern.code = prints_anoto ? CodeVariant::anoto : CodeVariant::libdots;
            frame.options.code = prints_anoto ? CodeVariant::libdots : CodeVariant::anoto;
            frame.printed = shot.page.pattern;
            frame.image = render(shot);
            frame.answers = {{shot.pose, shot.page.pattern.section}};
            break;
        }
    }
    return frame;
}

inline Verdict judge(const Fix& fix, const AdversarialFrame& frame) {
    if (fix.status != Status::ok) return Verdict::refused;
    for (std::size_t i = 0; i < frame.answers.size(); ++i) {
        if (detail::agrees(fix, frame.answers[i])) return i == 0 ? Verdict::right : Verdict::second;
    }
    return detail::is_twin(fix, frame) ? Verdict::twin : Verdict::wrong;
}

}  // namespace dotpose::test
