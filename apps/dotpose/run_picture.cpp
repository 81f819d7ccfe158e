// Draws a run: the path on the left, and plots over time on the right.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "draw/svg.hpp"
#include "evaluate/plot.hpp"
#include "run_log.hpp"

namespace dotpose::cli {
namespace {

using plot::Axes;
using plot::Point;
using plot::Scale;
using plot::Svg;

constexpr double kWidth = 1500;
constexpr double kHeight = 900;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

bool jumps(const LogRow& row) {
    return row.events.find("kidnapped") != std::string::npos ||
           row.events.find("fix") != std::string::npos;
}

/// Returns the points of the path. A NaN point marks an interruption where the robot was lost or
/// was moved by hand.
std::vector<Point> path_of(const std::vector<LogRow>& rows) {
    std::vector<Point> path;
    for (const LogRow& row : rows) {
        if (!row.x_mm || !row.y_mm || jumps(row)) path.push_back({kNone, kNone});
        if (row.x_mm && row.y_mm) path.push_back({*row.x_mm, *row.y_mm});
    }
    return path;
}

/// Returns the offset in mm to subtract from the coordinates along an axis. If the coordinates
/// along the axis are large compared with the length of the axis, as they are in the pattern frame,
/// the labels of the axis would differ only in their last digits. In this case, the offset is the
/// coordinate of the axis centre (`middle_mm`), rounded to whole mm. Otherwise, the offset is 0.
/// `reach_mm` is half the length of the axis.
double offset_mm(double middle_mm, double reach_mm) {
    constexpr double kMaxReaches = 1000;
    return std::abs(middle_mm) > kMaxReaches * reach_mm ? std::round(middle_mm) : 0;
}

std::string axis_label(const char* name, double offset_mm) {
    if (offset_mm == 0) return fmt::format("{} [mm]", name);
    return fmt::format("{} {} {:.0f} [mm]", name, offset_mm < 0 ? '+' : '-', std::abs(offset_mm));
}

/// Draws the path, with equal scales on both axes.
void draw_path(Svg& svg, const std::vector<LogRow>& rows) {
    std::vector<Point> path = path_of(rows);
    Point low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    Point high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
    for (const Point p : path) {
        if (!std::isfinite(p.x)) continue;
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    if (low.x > high.x) low = high = {0, 0};
    const double reach = 0.55 * std::max({high.x - low.x, high.y - low.y, 0.01});
    Point middle = 0.5 * (low + high);
    const Point offset{offset_mm(middle.x, reach), offset_mm(middle.y, reach)};
    middle = middle - offset;
    for (Point& p : path)
        p = p - offset;
    const bool y_up = std::ranges::any_of(rows, [](const LogRow& r) { return r.plane == "world"; });
    const double down = y_up ? reach : -reach;
    const Axes axes(svg, {110, 120, 620, 620}, {middle.x - reach, middle.x + reach},
                    {middle.y - down, middle.y + down});
    axes.draw_y(axis_label("y", offset.y));
    axes.draw_x(axis_label("x", offset.x));
    axes.curve(path, {.colour = draw::colour::kWindow, .has_marks = false});
}

/// Draws a red stripe for each period without a fix.
void draw_gaps(const Axes& axes, const std::vector<LogRow>& rows, double low, double high) {
    for (std::size_t i = 0; i < rows.size();) {
        std::size_t end = i;
        while (end < rows.size() && !rows[end].has_fix())
            ++end;
        if (end > i) {
            const double from = rows[i].t_s;
            const double to = end < rows.size() ? rows[end].t_s : rows.back().t_s;
            const std::vector<Point> below = {{from, low}, {to, low}};
            const std::vector<Point> above = {{from, high}, {to, high}};
            axes.band(below, above, draw::colour::kBad);
        }
        i = end + 1;
    }
}

void draw_over_time(Svg& svg, const std::vector<LogRow>& rows, double top, const char* label,
                    const std::function<double(const LogRow&)>& value, bool has_time) {
    std::vector<Point> curve;
    double max_value = 0;
    for (const LogRow& row : rows) {
        curve.push_back({row.t_s, value(row)});
        if (std::isfinite(curve.back().y)) max_value = std::max(max_value, curve.back().y);
    }
    const double limit = plot::rounded_up(max_value);
    const double end_s = std::max(rows.back().t_s, rows.front().t_s + 1e-3);
    const Axes axes(svg, {850, top, 600, 170}, {rows.front().t_s, end_s}, {0, limit});
    axes.draw_y(label);
    if (has_time) axes.draw_x("time [s]");
    draw_gaps(axes, rows, 0, limit);
    axes.curve(curve, {.colour = draw::colour::kWindow, .has_marks = false});
}

}  // namespace

std::string draw_run(const std::vector<LogRow>& rows, const std::string& title) {
    Svg svg(kWidth, kHeight, title);
    svg.text({60, 56}, 26, title, R"(font-weight="bold" fill="#17202a")");
    if (!rows.empty()) {
        draw_path(svg, rows);
        draw_over_time(
            svg, rows, 120, "speed [mm/s]",
            [](const LogRow& row) { return row.x_mm ? row.speed_mm_s : kNone; }, false);
        draw_over_time(
            svg, rows, 370, "dots seen",
            [](const LogRow& row) { return static_cast<double>(row.dots_seen); }, false);
        draw_over_time(
            svg, rows, 620, "certainty: decimal zeros of p_wrong; red: no fix",
            [](const LogRow& row) {
                return row.p_wrong ? -std::log10(std::max(*row.p_wrong, 1e-300)) : kNone;
            },
            true);
    }
    return std::move(svg).finish();
}

}  // namespace dotpose::cli
