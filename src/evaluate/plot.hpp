/// Draws axes with ticks around a rectangular area, and curves in the coordinates of the axes.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "draw/svg.hpp"

namespace dotpose::plot {

using draw::Point;
using draw::Svg;

namespace style {
inline constexpr double kFont = 15;
inline constexpr double kTitleFont = 22;
inline constexpr const char* kAll = draw::colour::kWindow;
inline constexpr const char* kWindow = "#ffa726";
inline constexpr const char* kAbove =
    "#c62828";  ///< colour of positive errors: red, as in the paper
inline constexpr const char* kBelow =
    "#1565c0";  ///< colour of negative errors: blue, as in the paper
}  // namespace style

/// Returns the largest step of the form 1, 2, 2.5 or 5 times a power of ten that divides `range`
/// into at least `min_count` steps.
double tick_step(double range, int min_count);

/// Rounds up to 1, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten. Returns 1 if `value` is not
/// positive.
double rounded_up(double value);

/// Scale of one axis. Converts data values to drawing units.
struct Scale {
    double first = 0;
    double last = 1;  ///< may be less than `first` if `is_log` is false
    bool is_log = false;
    double at_first = 0;  ///< drawing coordinate of `first`
    double at_last = 1;

    double at(double value) const;
    std::vector<double> ticks(int min_count) const;
};

/// Returns a logarithmic scale that contains `min` and `max` with a margin of at least 10 %. Both
/// ends are round numbers: `rounded_up` is applied to the upper end, and to the reciprocal of the
/// lower end. `min` must be positive.
Scale log_scale(double min, double max);

/// A rectangular area with an x axis below it and a y axis to its left.
class Axes {
  public:
    struct Area {
        double left = 0;
        double top = 0;
        double width = 0;
        double height = 0;
    };

    Axes(Svg& svg, const Area& area, Scale x, Scale y);

    /// Draws horizontal grid lines with their values, and the axis label above the upper end of the
    /// y axis.
    void draw_y(std::string_view label) const;
    void draw_x(std::string_view label) const;

    Point at(double x, double y) const { return {x_.at(x), y_.at(y)}; }

    struct Line {
        const char* colour = draw::colour::kInk;
        bool is_dashed = false;
        bool has_marks = true;
        bool is_wide = false;  ///< true if the line must remain visible under another curve
    };
    /// Draws a curve through the points. The curve is interrupted where a coordinate is NaN.
    void curve(std::span<const Point> data, const Line& line) const;
    /// Fills the area between two curves. The points of both curves must have the same x
    /// coordinates.
    void band(std::span<const Point> low, std::span<const Point> high, const char* colour) const;

  private:
    Svg& svg_;
    Area area_;
    Scale x_;
    Scale y_;
};

/// Draws a title in bold at the top of a drawing, and a line of text below it.
void draw_title(Svg& svg, double left, std::string_view title, std::string_view below = "");

/// Draws an entry of a legend: a short line and a label. Returns the x coordinate of the next
/// entry.
double legend_entry(Svg& svg, Point at, const Axes::Line& line, std::string_view text);

/// Estimates the width of a string from its number of characters.
double text_width(std::string_view text, double font);

}  // namespace dotpose::plot
