// Plots a sweep over the values of a condition, with the fraction of located frames at the top and
// the errors at the bottom.
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "dotpose/files/option_names.hpp"
#include "dotpose/tools/draw.hpp"
#include "evaluate/plot.hpp"
#include "evaluate/sweep.hpp"

namespace dotpose {
namespace {

using namespace dotpose::plot;

constexpr double kWidth = 900;
constexpr double kHeight = 690;
constexpr double kLeft = 80;
constexpr double kPlotWidth = kWidth - kLeft - 40;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
/// Minimum number of fixes for drawing the errors at a value of the condition.
constexpr int kMinFixes = 5;

struct Words {
    const char* title;
    const char* x_label;
};

Words words_of(SweepKind kind) {
    switch (kind) {
        case SweepKind::noise:
            return {"Sensor noise", "sigma of the noise, grey levels of 255"};
        case SweepKind::blur:
            return {"Blur", "sigma of the blur, px"};
        case SweepKind::missing:
            return {"Missing dots", "dots that are not printed, %"};
        case SweepKind::tilt:
            return {"Tilt of the camera", "tilt about a random axis, degrees"};
        case SweepKind::spacing:
            return {"Grid spacing in the image", "grid spacing, px"};
        case SweepKind::occlusion:
            return {"Covered part of the frame", "area behind a straight dark edge, %"};
    }
    return {"", ""};
}

using Value = double (*)(const Score&);

std::vector<Point> data_of(const Sweep& sweep, Decoder decoder, Value value) {
    std::vector<Point> data;
    for (const SweepPoint& point : sweep.points) {
        data.push_back({point.value, value(decoder == Decoder::window ? point.window : point.all)});
    }
    return data;
}

double success(const Score& score) {
    return 100 * score.located_fraction();
}
double median_um(const Score& score) {
    return score.located >= kMinFixes ? score.position_um.median : kNone;
}
double p95_um(const Score& score) {
    return score.located >= kMinFixes ? score.position_um.p95 : kNone;
}

void draw_head(Svg& svg, const Sweep& sweep) {
    draw_title(svg, kLeft, words_of(sweep.kind).title,
               fmt::format("{} simulated frames for each value; all else as in preset {}",
                           sweep.frames_per_value, name(sweep.preset)));
    double x = 465;
    x = legend_entry(svg, {x, 39}, {style::kAll}, "all dots (default)");
    legend_entry(svg, {x, 39}, {style::kWindow, false, false, true}, "8 x 8 window (paper)");
}

/// Draws a red disc above each point with wrong fixes. The disc contains the number of wrong fixes.
void mark_wrong(Svg& svg, const Axes& axes, const Sweep& sweep, Decoder decoder) {
    for (const SweepPoint& point : sweep.points) {
        const Score& score = decoder == Decoder::window ? point.window : point.all;
        if (score.wrong == 0) continue;
        const Point at = axes.at(point.value, success(score)) + Point{0, -20};
        svg.circle(at, 10, fmt::format(R"(fill="{}")", draw::colour::kBad));
        svg.text(at + Point{0, 4}, 12, fmt::format("{}", score.wrong),
                 R"(text-anchor="middle" fill="#ffffff" font-weight="bold")");
    }
}

/// Returns a logarithmic scale that contains the medians and the 95th percentiles of the position
/// errors, for values of the condition with at least kMinFixes fixes. If there are no such values,
/// the scale ranges from 1 to 10 um.
Scale error_scale(const Sweep& sweep) {
    double low_um = 1e300;
    double high_um = 0;
    for (const SweepPoint& point : sweep.points) {
        for (const Score* score : {&point.window, &point.all}) {
            if (score->located < kMinFixes) continue;
            low_um = std::min(low_um, score->position_um.median);
            high_um = std::max(high_um, score->position_um.p95);
        }
    }
    if (high_um <= 0) return {1, 10, true};
    return log_scale(low_um, high_um);
}

}  // namespace

void draw_sweep(std::ostream& out, const Sweep& sweep) {
    if (sweep.points.size() < 2) throw BadArgument("a sweep needs at least two values");
    const Words words = words_of(sweep.kind);
    Svg svg(kWidth, kHeight, words.title);
    draw_head(svg, sweep);
    const Scale x{sweep.points.front().value, sweep.points.back().value};

    const Axes above(svg, {kLeft, 120, kPlotWidth, 200}, x, {0, 100});
    above.draw_y("frames located, %");
    above.draw_x("");
    const Axes below(svg, {kLeft, 390, kPlotWidth, 220}, x, error_scale(sweep));
    below.draw_y("position error of the fixes, µm: median (solid) and 95 % (dashed)");
    below.draw_x(words.x_label);
    // The curves of the `window` decoder are wider and drawn first, so they remain visible where
    // both curves coincide.
    for (const Decoder decoder : kDecoders) {
        const bool is_window = decoder == Decoder::window;
        const char* colour = is_window ? style::kWindow : style::kAll;
        const std::vector<Point> median = data_of(sweep, decoder, median_um);
        const std::vector<Point> p95 = data_of(sweep, decoder, p95_um);
        if (!is_window) below.band(median, p95, colour);
        above.curve(data_of(sweep, decoder, success), {colour, false, !is_window, is_window});
        below.curve(p95, {colour, true, false, is_window});
        below.curve(median, {colour, false, !is_window, is_window});
        mark_wrong(svg, above, sweep, decoder);
    }
    out << std::move(svg).finish();
}

}  // namespace dotpose
