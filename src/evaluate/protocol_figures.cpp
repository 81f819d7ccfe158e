// Draws figures 13, 14 and 15 of the paper. Simulated figures show a perfect page on the left and
// the printer model on the right. Measured figures show one page.
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
constexpr double kHeight = kTop + kPanel + 150;

/// One page in a figure: its name, its stations, and the number of decimals for its values.
struct FigurePage {
    std::string name;
    std::span<const Station> stations;
    int decimals;
};

/// Coordinate shown in a figure. `spread` returns the spread of this coordinate at a station, in
/// units of `unit`.
struct Coordinate {
    int figure;
    const char* name;
    SpreadOf spread;
    const char* unit;
};

struct Labels {
    const char* how;       ///< how the poses were obtained
    std::string stations;  ///< number of stations
    const char* y_label;
    bool is_y_up = false;
};

/// Square region of the page that a panel shows.
struct Extent {
    Vec2 middle_mm;
    double side_mm = 1;
};

Extent extent_of(std::span<const Station> stations) {
    constexpr double kWithMargin = 1.1;
    constexpr double kMinSide_mm = 1;
    const auto [left, right] =
        std::ranges::minmax(stations, {}, [](const Station& s) { return s.place_mm.x; });
    const auto [top, bottom] =
        std::ranges::minmax(stations, {}, [](const Station& s) { return s.place_mm.y; });
    const double width_mm = right.place_mm.x - left.place_mm.x;
    const double height_mm = bottom.place_mm.y - top.place_mm.y;
    return {{(left.place_mm.x + right.place_mm.x) / 2, (top.place_mm.y + bottom.place_mm.y) / 2},
            kWithMargin * std::max({width_mm, height_mm, kMinSide_mm})};
}

struct Panel {
    Svg& svg;
    Point corner;
    std::span<const Station> stations;
    SpreadOf spread;
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

constexpr double kMaxMark = 16;

double mark_radius(double bias, double scale) {
    // The area of a mark is proportional to the bias, but very small marks are enlarged to stay
    // visible.
    return std::max(1.2, kMaxMark * std::sqrt(std::abs(bias) / scale));
}

/// Scales of the x and y axes of a panel. y points up in the drawing if `is_y_up` is true, and down
/// otherwise.
struct PageScale {
    Scale x;
    Scale y;
    PageScale(const Extent& extent, Point corner, bool is_y_up)
        : x{extent.middle_mm.x - extent.side_mm / 2, extent.middle_mm.x + extent.side_mm / 2, false,
            corner.x, corner.x + kPanel},
          y{extent.middle_mm.y - extent.side_mm / 2, extent.middle_mm.y + extent.side_mm / 2, false,
            is_y_up ? corner.y + kPanel : corner.y, is_y_up ? corner.y : corner.y + kPanel} {}
    Point at(Vec2 place_mm) const { return {x.at(place_mm.x), y.at(place_mm.y)}; }
};

void draw_mark(const Panel& panel, const Station& station, Point at, double scale) {
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

void draw_page_axes(const Panel& panel, const PageScale& page, const char* y_name) {
    constexpr int kMinTicks = 4;
    const Point corner = panel.corner;
    panel.svg.add(R"(<rect x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="#f7f9fb" )"
                  R"(stroke="{}"/>)",
                  corner.x, corner.y, kPanel, kPanel, draw::colour::kFrame);
    for (const double mm : page.x.ticks(kMinTicks)) {
        panel.svg.text({page.x.at(mm), corner.y + kPanel + 22}, style::kFont, fmt::format("{}", mm),
                       text_in(draw::colour::kQuiet, "middle"));
    }
    for (const double mm : page.y.ticks(kMinTicks)) {
        panel.svg.text({corner.x - 10, page.y.at(mm) + 5}, style::kFont, fmt::format("{}", mm),
                       text_in(draw::colour::kQuiet, "end"));
    }
    panel.svg.text({corner.x + kPanel / 2, corner.y + kPanel + 46}, style::kFont, "x, mm",
                   text_in(draw::colour::kInk, "middle"));
    const Point y_label = corner + Point{-54, kPanel / 2};
    panel.svg.text(y_label, style::kFont, y_name,
                   fmt::format(R"svg({} transform="rotate(-90 {:.2f} {:.2f})")svg",
                               text_in(draw::colour::kInk, "middle"), y_label.x, y_label.y));
}

void draw_mark_legend(const Panel& panel, double scale) {
    Point at = panel.corner + Point{20, kPanel + 92};
    for (const double fraction : {-1.0, -0.25, 0.25, 1.0}) {
        const double value = fraction * scale;
        panel.svg.circle(at, mark_radius(value, scale),
                         fmt::format(R"(fill="{}" fill-opacity="0.82")", colour_of(value)));
        panel.svg.text(at + Point{22, 5}, style::kFont,
                       fmt::format("{:+.3g}{}", value, fraction == 1.0 ? panel.unit : ""),
                       text_in(draw::colour::kInk));
        at = at + Point{104, 0};
    }
}

void draw_map(const Panel& panel, const FigurePage& page, const Labels& labels) {
    draw_summary(panel, page.name, page.decimals);
    const PageScale on_page(extent_of(panel.stations), panel.corner, labels.is_y_up);
    draw_page_axes(panel, on_page, labels.y_label);
    std::string path;
    for (const Station& station : panel.stations) {
        const Point at = on_page.at(station.place_mm);
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', at.x, at.y);
    }
    panel.svg.add(R"(<path d="{}" fill="none" stroke="{}" stroke-width="1"/>)", path,
                  draw::colour::kFrame);
    const double scale = panel.scale();
    for (const Station& station : panel.stations)
        draw_mark(panel, station, on_page.at(station.place_mm), scale);
    draw_mark_legend(panel, scale);
}

// ---- Figure 15 ----

constexpr double kInnerRadius = 90;
constexpr double kOuterRadius = kPanel / 2 - 26;

void draw_rings(const Panel& panel, Point centre, double scale) {
    for (const double fraction : {0.0, 0.5, 1.0}) {
        panel.svg.circle(centre, kInnerRadius + fraction * (kOuterRadius - kInnerRadius),
                         fmt::format(R"(fill="none" stroke="{}" stroke-width="{}")",
                                     fraction == 0 ? draw::colour::kQuiet : draw::colour::kFrame,
                                     fraction == 0 ? 1.5 : 1.0));
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

void draw_rose(const Panel& panel, const FigurePage& page) {
    draw_summary(panel, page.name, page.decimals);
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

constexpr int kAngleFigure = 15;

Spread scaled(Spread spread, double factor) {
    return {factor * spread.bias, factor * spread.sigma};
}

Coordinate coordinate_of(int figure) {
    if (figure == 13) {
        return {13, "x", [](const Station& s) { return scaled(s.x_mm, 1000); }, " µm"};
    }
    if (figure == 14) {
        return {14, "y", [](const Station& s) { return scaled(s.y_mm, 1000); }, " µm"};
    }
    return {kAngleFigure, "the angle", [](const Station& s) { return s.theta; }, "°"};
}

void draw_figure(std::ostream& out, const Coordinate& coordinate, const Labels& labels,
                 std::span<const FigurePage> pages) {
    const bool is_rose = coordinate.figure == kAngleFigure;
    const auto count = static_cast<double>(pages.size());
    constexpr double kMinWidth = 800;
    const double width = std::max(2 * kLeft + count * kPanel + (count - 1) * kGap - 40, kMinWidth);
    const std::string title = fmt::format("Accuracy of {} at rest, {} (paper: Figure {})",
                                          coordinate.name, labels.how, coordinate.figure);
    Svg svg(width, is_rose ? kHeight - 70 : kHeight, title);
    draw_head(svg, title,
              fmt::format("{}; a {} is the mean of found minus true, red above 0, blue below",
                          labels.stations, is_rose ? "bar" : "mark's area"));
    double left = kLeft;
    for (const FigurePage& page : pages) {
        const Panel panel{svg, {left, kTop}, page.stations, coordinate.spread, coordinate.unit};
        if (is_rose) {
            draw_rose(panel, page);
        } else {
            draw_map(panel, page, labels);
        }
        left += kPanel + kGap;
    }
    out << std::move(svg).finish();
}

void draw_simulated(std::ostream& out, const Protocol& protocol, int figure) {
    const bool is_rose = figure == kAngleFigure;
    const auto stations = [is_rose](const ProtocolResult& result) {
        return std::span<const Station>(is_rose ? result.angles : result.positions);
    };
    const FigurePage pages[] = {
        {"Perfect page", stations(protocol.perfect), is_rose ? 3 : 2},
        {"Page of the printer model", stations(protocol.printed), is_rose ? 3 : 1}};
    draw_figure(out, coordinate_of(figure),
                {"simulated",
                 fmt::format("{} {}, {} samples each", pages[0].stations.size(),
                             is_rose ? "angles" : "positions", protocol.samples),
                 "y, mm (paper feed, down)"},
                pages);
}

}  // namespace

void draw_figure_13(std::ostream& out, const Protocol& protocol) {
    draw_simulated(out, protocol, 13);
}

void draw_figure_14(std::ostream& out, const Protocol& protocol) {
    draw_simulated(out, protocol, 14);
}

void draw_figure_15(std::ostream& out, const Protocol& protocol) {
    draw_simulated(out, protocol, kAngleFigure);
}

namespace evaluate_detail {

void draw_measured_figure(std::ostream& out, int figure, std::span<const Station> stations,
                          bool is_in_world) {
    int samples = 0;
    for (const Station& station : stations)
        samples += station.samples;
    const bool is_rose = figure == kAngleFigure;
    const FigurePage page{is_in_world ? "In the world" : "On the sheet", stations, is_rose ? 3 : 1};
    draw_figure(out, coordinate_of(figure),
                {"measured",
                 fmt::format("{} {}, {} samples", stations.size(), is_rose ? "angles" : "positions",
                             samples),
                 is_in_world ? "y, mm (up)" : "y, mm (down)", is_in_world},
                std::span(&page, 1));
}

}  // namespace evaluate_detail

}  // namespace dotpose
