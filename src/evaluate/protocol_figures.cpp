// Draws figures 13, 14 and 15 of the paper, each for a perfect page on the left and for the printer
// model on the right.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "dotpose/tools/draw.hpp"
#include "evaluate/plot.hpp"
#include "evaluate/protocol.hpp"

namespace dotpose {
namespace {

using namespace dotpose::plot;
using namespace evaluate_detail;

constexpr double kPanel = 440;
constexpr double kGap = 110;
constexpr double kLeft = 80;
constexpr double kTop = 150;
constexpr double kWidth = 2 * kLeft + 2 * kPanel + kGap - 40;
constexpr double kHeight = kTop + kPanel + 150;

struct Panel {
    Svg& svg;
    Point corner;
    std::span<const Station> stations;
    SpreadOf spread;  ///< selects the spread, in the unit of the figure
    const char* unit;

    double scale() const {
        const Summary summary = summary_of(stations, spread);
        return rounded_up(summary.worst);
    }
};

std::string text_in(const char* colour, const char* anchor = "start") {
    return fmt::format(R"(fill="{}" text-anchor="{}")", colour, anchor);
}

void draw_head(Svg& svg, std::string_view title, std::string_view under) {
    svg.text({kLeft - 40, 44}, style::kTitleFont, title,
             fmt::format(R"(font-weight="bold" fill="{}")", draw::colour::kInk));
    svg.text({kLeft - 40, 70}, style::kFont, under, text_in(draw::colour::kQuiet));
}

void draw_summary(const Panel& panel, std::string_view name, int decimals) {
    const Summary summary = summary_of(panel.stations, panel.spread);
    panel.svg.text(panel.corner + Point{0, -38}, 17, name,
                   fmt::format(R"(font-weight="bold" fill="{}")", draw::colour::kInk));
    panel.svg.text(panel.corner + Point{0, -16}, style::kFont,
                   fmt::format("best {:.{}f}, mean {:.{}f}, worst {:.{}f}{}; sigma up to {:.{}f}",
                               summary.best, decimals, summary.mean, decimals, summary.worst,
                               decimals, panel.unit, summary.worst_sigma, decimals),
                   text_in(draw::colour::kQuiet));
}

const char* colour_of(double bias) {
    return bias >= 0 ? style::kAbove : style::kBelow;
}

// ---- Figures 13 and 14 ----

constexpr double kLargestMark = 16;

double mark_radius(double bias, double scale) {
    // The area of a mark is proportional to its value; small values keep a mark that can be seen.
    return std::max(1.2, kLargestMark * std::sqrt(std::abs(bias) / scale));
}

Point on_page(Vec2 place_mm) {
    const double side_mm = PrintModel::kSide_mm * 1.1;
    return {kPanel * (place_mm.x / side_mm + 0.5), kPanel * (place_mm.y / side_mm + 0.5)};
}

void draw_mark(const Panel& panel, const Station& station, double scale) {
    const Point at = panel.corner + on_page(station.place_mm);
    if (station.located == 0) {
        const std::string pen =
            fmt::format(R"(stroke="{}" stroke-width="2.5")", draw::colour::kInk);
        panel.svg.line(at + Point{-7, -7}, at + Point{7, 7}, pen);
        panel.svg.line(at + Point{-7, 7}, at + Point{7, -7}, pen);
        return;
    }
    const double bias = panel.spread(station).bias;
    panel.svg.circle(at, mark_radius(bias, scale),
                     fmt::format(R"(fill="{}" fill-opacity="0.82")", colour_of(bias)));
}

void draw_page_axes(const Panel& panel) {
    const Point corner = panel.corner;
    panel.svg.add(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="#f7f9fb" )"
                  R"(stroke="{}"/>)",
                  corner.x, corner.y, kPanel, kPanel, draw::colour::kFrame);
    for (int mm = -100; mm <= 100; mm += 50) {
        const Point at = on_page({1.0 * mm, 1.0 * mm});
        panel.svg.text({corner.x + at.x, corner.y + kPanel + 22}, style::kFont,
                       fmt::format("{}", mm), text_in(draw::colour::kQuiet, "middle"));
        panel.svg.text({corner.x - 10, corner.y + at.y + 5}, style::kFont, fmt::format("{}", mm),
                       text_in(draw::colour::kQuiet, "end"));
    }
    panel.svg.text({corner.x + kPanel / 2, corner.y + kPanel + 46}, style::kFont, "x, mm",
                   text_in(draw::colour::kInk, "middle"));
    const Point y_label = corner + Point{-54, kPanel / 2};
    panel.svg.text(y_label, style::kFont, "y, mm (paper feed, down)",
                   fmt::format(R"svg({} transform="rotate(-90 {:.2f} {:.2f})")svg",
                               text_in(draw::colour::kInk, "middle"), y_label.x, y_label.y));
}

void draw_mark_legend(const Panel& panel, double scale) {
    Point at = panel.corner + Point{20, kPanel + 92};
    for (const double share : {-1.0, -0.25, 0.25, 1.0}) {
        const double value = share * scale;
        panel.svg.circle(at, mark_radius(value, scale),
                         fmt::format(R"(fill="{}" fill-opacity="0.82")", colour_of(value)));
        panel.svg.text(at + Point{22, 5}, style::kFont,
                       fmt::format("{:+.3g}{}", value, share == 1.0 ? panel.unit : ""),
                       text_in(draw::colour::kInk));
        at = at + Point{104, 0};
    }
}

void draw_map(const Panel& panel, std::string_view name, int decimals) {
    draw_summary(panel, name, decimals);
    draw_page_axes(panel);
    std::string path;
    for (const Station& station : panel.stations) {
        const Point at = panel.corner + on_page(station.place_mm);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', at.x, at.y);
    }
    panel.svg.add(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1"/>)", path,
                  draw::colour::kFrame);
    const double scale = panel.scale();
    for (const Station& station : panel.stations)
        draw_mark(panel, station, scale);
    draw_mark_legend(panel, scale);
}

Spread scaled(Spread spread, double factor) {
    return {factor * spread.bias, factor * spread.sigma};
}

void draw_position_figure(std::ostream& out, const Protocol& protocol, int figure,
                          const char* coordinate, Spread Station::*spread_mm) {
    const std::string title =
        fmt::format("Accuracy of {} at rest, simulated (paper: Figure {})", coordinate, figure);
    Svg svg(kWidth, kHeight, title);
    draw_head(svg, title,
              fmt::format("{} positions, {} samples each; a mark's area is the mean of found minus "
                          "true, red above 0, blue below",
                          protocol.perfect.positions.size(), protocol.samples));
    const SpreadOf in_um = [spread_mm](const Station& s) { return scaled(s.*spread_mm, 1000); };
    draw_map({svg, {kLeft, kTop}, protocol.perfect.positions, in_um, " µm"}, "Perfect page", 2);
    draw_map({svg, {kLeft + kPanel + kGap, kTop}, protocol.printed.positions, in_um, " µm"},
             "Page of the printer model", 1);
    out << std::move(svg).finish();
}

// ---- Figure 15 ----

constexpr double kInnerRadius = 90;
constexpr double kOuterRadius = kPanel / 2 - 26;

void draw_rings(const Panel& panel, Point centre, double scale) {
    for (const double share : {0.0, 0.5, 1.0}) {
        panel.svg.circle(centre, kInnerRadius + share * (kOuterRadius - kInnerRadius),
                         fmt::format(R"(fill="none" stroke="{}" stroke-width="{}")",
                                     share == 0 ? draw::colour::kQuiet : draw::colour::kFrame,
                                     share == 0 ? 1.5 : 1.0));
    }
    for (int deg = 0; deg < 360; deg += 45) {
        const double angle = deg * std::numbers::pi / 180;
        const Point at = centre + (kOuterRadius + 20) * Point{std::cos(angle), std::sin(angle)};
        panel.svg.text(at + Point{0, 5}, style::kFont, fmt::format("{}°", deg),
                       text_in(draw::colour::kQuiet, "middle"));
    }
    panel.svg.text(centre + Point{0, -8}, style::kFont, "rings at",
                   text_in(draw::colour::kQuiet, "middle"));
    panel.svg.text(centre + Point{0, 14}, style::kFont,
                   fmt::format("{:.3g} and {:.3g}°", scale / 2, scale),
                   text_in(draw::colour::kInk, "middle"));
}

void draw_rose(const Panel& panel, std::string_view name) {
    draw_summary(panel, name, 3);
    const Point centre = panel.corner + Point{kPanel / 2, kPanel / 2 + 10};
    const double scale = panel.scale();
    draw_rings(panel, centre, scale);
    for (const Station& station : panel.stations) {
        const double angle = station.theta_deg * std::numbers::pi / 180;
        const Point ahead{std::cos(angle), std::sin(angle)};
        if (station.located == 0) {
            const Point at = centre + kInnerRadius * ahead;
            panel.svg.circle(at, 5, fmt::format(R"(fill="{}")", draw::colour::kInk));
            continue;
        }
        const double bias = panel.spread(station).bias;
        const double length = std::abs(bias) / scale * (kOuterRadius - kInnerRadius);
        panel.svg.line(
            centre + kInnerRadius * ahead, centre + (kInnerRadius + length) * ahead,
            fmt::format(R"(stroke="{}" stroke-width="9" stroke-opacity="0.85")", colour_of(bias)));
    }
}

}  // namespace

void draw_figure_13(std::ostream& out, const Protocol& protocol) {
    draw_position_figure(out, protocol, 13, "x", &Station::x_mm);
}

void draw_figure_14(std::ostream& out, const Protocol& protocol) {
    draw_position_figure(out, protocol, 14, "y", &Station::y_mm);
}

void draw_figure_15(std::ostream& out, const Protocol& protocol) {
    const std::string title = "Accuracy of the angle at rest, simulated (paper: Figure 15)";
    Svg svg(kWidth, kHeight - 70, title);
    draw_head(svg, title,
              fmt::format("{} angles, {} samples each; a bar is the mean of found minus true, red "
                          "above 0, blue below",
                          protocol.perfect.angles.size(), protocol.samples));
    const SpreadOf theta = [](const Station& s) { return s.theta; };
    draw_rose({svg, {kLeft, kTop}, protocol.perfect.angles, theta, "°"}, "Perfect page");
    draw_rose({svg, {kLeft + kPanel + kGap, kTop}, protocol.printed.angles, theta, "°"},
              "Page of the printer model");
    out << std::move(svg).finish();
}

}  // namespace dotpose
