#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "draw/frame_panels.hpp"

namespace dotpose::draw {
namespace {

constexpr double kMaxWeight = 127;  // maximum weight of a bit

/// Returns the likelihood |Px Py| of the symbol, as in the paper, in the range [0, 1].
double quality(const GridCell& cell) {
    return std::abs(cell.x * cell.y) / (kMaxWeight * kMaxWeight);
}

/// Returns a colour from red (0) through amber to green (1).
std::string quality_colour(double quality) {
    struct Rgb {
        double red, green, blue;
    };
    constexpr Rgb kRed{192, 57, 43};
    constexpr Rgb kAmber{214, 137, 16};
    constexpr Rgb kGreen{30, 132, 73};
    const Rgb& low = quality < 0.5 ? kRed : kAmber;
    const Rgb& high = quality < 0.5 ? kAmber : kGreen;
    const double fraction = quality < 0.5 ? 2 * quality : 2 * quality - 1;
    const auto mix = [fraction](double a, double b) {
        return static_cast<int>(std::lround(a + fraction * (b - a)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(low.red, high.red), mix(low.green, high.green),
                       mix(low.blue, high.blue));
}

/// Converts a symbol from the axes of the grid to the axes of the pattern.
Symbol turned(Symbol symbol, QuarterTurn pattern_from_grid) {
    const FixedVec d = pattern_from_grid({dx(symbol), dy(symbol)});
    return make_symbol((d.y - d.x + 1) / 2, (d.y + d.x + 1) / 2);
}

/// Draws the symbols of a frame, layer by layer.
class Reading {
  public:
    Reading(const FrameView& view, Svg& svg) : view_(view), trace_(view.trace()), svg_(svg) {}

    void draw_grid() const;
    void draw_symbols() const;
    void draw_window() const;
    void draw_corner() const;
    void draw_reference() const;

  private:
    QuarterTurn turn() const {
        return view_.reached().place ? trace_.decoding.pattern_from_grid : QuarterTurn{};
    }
    void draw_axes() const;
    Symbol read_in(const GridCell& cell) const {
        return turned(make_symbol(cell.x > 0, cell.y > 0), turn());
    }
    bool is_error(int i, int j, const GridCell& cell) const;
    void draw_symbol(int i, int j, const GridCell& cell) const;
    void draw_points() const;
    /// Calls `draw` with the column, row and cell of each dot that was read. Returns the centres of
    /// the unread dots. A dot is unread if it is far from all intersections, or if another dot at
    /// the same intersection has a higher quality.
    std::vector<Point> for_each_read_dot(
        const std::function<void(int, int, const GridCell&)>& draw) const;
    /// Draws a grid line as a polyline, because lens distortion can bend the line.
    void draw_grid_line(double i, double j, int steps, Point step) const;

    const FrameView& view_;
    const Trace& trace_;
    Svg& svg_;
};

void Reading::draw_grid_line(double i, double j, int steps, Point step) const {
    std::string path;
    for (int n = 0; n <= steps; ++n) {
        const Point at = view_.at_grid(i + n * step.x, j + n * step.y);
        path += fmt::format("{}{:.2f} {:.2f}", n == 0 ? 'M' : 'L', at.x, at.y);
    }
    svg_.add(R"(<path d="{}"/>)", path);
}

void Reading::draw_grid() const {
    if (!view_.reached().cells || view_.is_dense()) return;
    const GridRegion& grid = trace_.grid.region;
    svg_.add(R"(<g class="grid" fill="none" stroke="#7f8c99" stroke-opacity="0.7" )"
             R"(stroke-width="{:.2f}">)",
             1.6 * view_.stroke());
    for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
        draw_grid_line(i, grid.j0, grid.rows - 1, {0, 1});
    }
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        draw_grid_line(grid.i0, j, grid.columns - 1, {1, 0});
    }
    svg_.add("</g>");
}

bool Reading::is_error(int i, int j, const GridCell& cell) const {
    if (!view_.reached().place) return false;
    const Place place = place_of(trace_, {i, j});
    return symbol_at(trace_.options.code, place.cell, place.section) != read_in(cell);
}

void Reading::draw_symbol(int i, int j, const GridCell& cell) const {
    const Point at = view_.at_dot(trace_.dots[cell.dot]);
    const double radius = 0.27 * view_.spacing();
    svg_.circle(
        at, radius,
        fmt::format(R"(fill="{}"{})", quality_colour(quality(cell)),
                    is_error(i, j, cell) ? fmt::format(R"( stroke="{}" stroke-width="{:.2f}")",
                                                       colour::kError, 7 * view_.stroke())
                                         : ""));
    const bool is_legible = cell.x != 0 && cell.y != 0;
    const char capital = static_cast<char>(letter(read_in(cell)) - 'a' + 'A');
    const double size = 1.45 * radius;
    // The letters are upright relative to the pattern, so they show its orientation.
    const double angle_deg =
        view_.reached().pose ? -trace_.fix.theta_rad() * 180 / std::numbers::pi : 0;
    svg_.add(R"svg(<text transform="translate({:.2f} {:.2f}) rotate({:.2f})" y="{:.2f}" )svg"
             R"svg(font-size="{:.2f}">{}</text>)svg",
             at.x, at.y, angle_deg, 0.36 * size, size, is_legible ? capital : '?');
}

void Reading::draw_symbols() const {
    if (!view_.reached().cells) {
        svg_.add(R"(<g class="dots" fill="{}">)", colour::kQuiet);
        for (const DetectedDot& dot : trace_.dots) {
            svg_.circle(view_.at_dot(dot), 0.1 * view_.spacing(), {});
        }
        svg_.add("</g>");
        return;
    }
    if (view_.is_dense()) return draw_points();
    svg_.add(R"(<g class="symbols" font-weight="bold" fill="#ffffff" text-anchor="middle">)");
    const std::vector<Point> unread =
        for_each_read_dot([this](int i, int j, const GridCell& cell) { draw_symbol(i, j, cell); });
    svg_.add("</g>");
    svg_.add(R"(<g class="unread" fill="none" stroke="{}" stroke-width="{:.2f}">)", colour::kBad,
             4 * view_.stroke());
    for (const Point& centre : unread)
        svg_.circle(centre, 0.2 * view_.spacing(), {});
    svg_.add("</g>");
}

std::vector<Point> Reading::for_each_read_dot(
    const std::function<void(int, int, const GridCell&)>& draw) const {
    std::vector<bool> is_read(trace_.dots.size(), false);
    const GridRegion& grid = trace_.grid.region;
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            const GridCell& cell = trace_.grid.at(i, j);
            if (cell.dot >= is_read.size()) continue;
            is_read[cell.dot] = true;
            draw(i, j, cell);
        }
    }
    std::vector<Point> unread;
    for (std::size_t d = 0; d < is_read.size(); ++d) {
        if (!is_read[d]) unread.push_back(view_.at_dot(trace_.dots[d]));
    }
    return unread;
}

/// Draws the dots without letters. Dots of similar likelihood are drawn as one SVG element.
void Reading::draw_points() const {
    constexpr std::size_t kColours = 8;
    std::array<std::vector<Point>, kColours> points;
    std::vector<Point> errors;
    const std::vector<Point> unread = for_each_read_dot([&](int i, int j, const GridCell& cell) {
        const Point at = view_.at_dot(trace_.dots[cell.dot]);
        const auto colour = static_cast<std::size_t>(kColours * quality(cell));
        points[std::min(colour, kColours - 1)].push_back(at);
        if (is_error(i, j, cell)) errors.push_back(at);
    });
    const auto draw = [this](const std::vector<Point>& centres, double size, const char* what,
                             const std::string& colour) {
        svg_.discs(centres, size * view_.spacing(),
                   fmt::format(R"(class="{}" stroke="{}")", what, colour));
    };
    draw(errors, 1.1, "errors", colour::kError);
    draw(unread, 0.4, "unread", colour::kBad);
    for (std::size_t i = 0; i < kColours; ++i)
        draw(points[i], 0.54, "points", quality_colour((static_cast<double>(i) + 0.5) / kColours));
}

void Reading::draw_window() const {
    if (!view_.reached().window) return;
    const GridRegion& window = trace_.decoding.window;
    // The outline is half a cell outside the outermost intersections. Lens distortion can bend the
    // outline, so it has one segment per cell.
    const double left = window.i0 - 0.5;
    const double top = window.j0 - 0.5;
    std::string path;
    const auto side = [&](double i, double j, int steps, int di, int dj) {
        for (int n = 0; n < steps; ++n) {
            const Point at = view_.at_grid(i + n * di, j + n * dj);
            path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? 'M' : 'L', at.x, at.y);
        }
    };
    side(left, top, window.columns, 1, 0);
    side(left + window.columns, top, window.rows, 0, 1);
    side(left + window.columns, top + window.rows, window.columns, -1, 0);
    side(left, top + window.rows, window.rows, 0, -1);
    svg_.add(R"(<path class="window" d="{}Z" fill="none" stroke="{}" stroke-width="{:.2f}" )"
             R"(stroke-linejoin="round"/>)",
             path, colour::kWindow, 7 * view_.stroke());
}

void Reading::draw_corner() const {
    if (!view_.reached().place) return;
    const FixedVec cell = window_corner(trace_);
    svg_.circle(view_.at_grid(cell.x, cell.y), 0.44 * view_.spacing(),
                fmt::format(R"(class="corner" fill="none" stroke="{}" stroke-width="{:.2f}")",
                            colour::kWindow, 7 * view_.stroke()));
}

void Reading::draw_axes() const {
    const Point reference = view_.at(view_.reference_px());
    const double stroke = std::max(view_.stroke(), 0.35);
    const FixedVec cell = window_corner(trace_);
    svg_.line(view_.at_grid(cell.x, cell.y), reference,  // the vector t (paper, equation 10)
              fmt::format(R"(stroke="{}" stroke-width="{:.2f}" stroke-dasharray="{:.2f}")",
                          colour::kWindow, 4 * stroke, 11 * stroke));
    const double reach = 2.4 * view_.spacing();
    const Point ahead = reach * view_.ahead_of_reference();
    const double arc = 0.6;  // radius of the arc as a fraction of the arrow length
    svg_.add(R"(<path d="M{:.2f} {:.2f}A{:.2f} {:.2f} 0 0 {} {:.2f} {:.2f}" fill="none" )"
             R"(stroke="{}" stroke-width="{:.2f}"/>)",
             reference.x + arc * reach, reference.y, arc * reach, arc * reach, ahead.y > 0 ? 1 : 0,
             reference.x + arc * ahead.x, reference.y + arc * ahead.y, colour::kPattern,
             4 * stroke);
    const Point between = Point{reach, 0} + ahead;
    if (length(between) < 1.98 * reach && length(between) > 0.1 * reach) {
        const Point at = reference + 0.8 * reach / length(between) * between;
        svg_.text(at + Point{0, 12 * stroke}, 36 * stroke, "θ",
                  fmt::format(R"(text-anchor="middle" font-weight="bold" fill="{}" )"
                              R"(stroke="#ffffff" stroke-width="{:.2f}" paint-order="stroke")",
                              colour::kPattern, 8 * stroke));
    }
    svg_.arrow(reference, reference + Point{reach, 0}, 7 * stroke, colour::kInk);
    svg_.arrow(reference, reference + ahead, 7 * stroke, colour::kPattern);
}

void Reading::draw_reference() const {
    if (view_.reached().pose) draw_axes();
    const Point reference = view_.at(view_.reference_px());
    const double stroke = std::max(view_.stroke(), 0.35);
    const double arm = 24 * stroke;
    svg_.add(R"(<g class="reference" stroke="{}" stroke-width="{:.2f}">)", colour::kInk,
             6 * stroke);
    svg_.line(reference - Point{arm, 0}, reference + Point{arm, 0}, {});
    svg_.line(reference - Point{0, arm}, reference + Point{0, arm}, {});
    svg_.add("</g>");
}

}  // namespace

void draw_reading(const FrameView& view, Svg& svg) {
    const Reading reading(view, svg);
    reading.draw_grid();
    reading.draw_symbols();
    reading.draw_window();
    reading.draw_corner();
    reading.draw_reference();
}

}  // namespace dotpose::draw
