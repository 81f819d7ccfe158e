// Builds SVG drawings, and defines their common palette.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

namespace dotpose::draw {

/// A 2D point or vector. Where the unit matters, variable names have a unit suffix, such as _px or
/// _mm.
struct Point {
    double x = 0;
    double y = 0;
};
constexpr Point operator+(Point a, Point b) {
    return {a.x + b.x, a.y + b.y};
}
constexpr Point operator-(Point a, Point b) {
    return {a.x - b.x, a.y - b.y};
}
constexpr Point operator*(double factor, Point a) {
    return {factor * a.x, factor * a.y};
}
double length(Point a);

namespace colour {
inline constexpr const char* kInk = "#17202a";
inline constexpr const char* kQuiet = "#6b7885";
inline constexpr const char* kFrame = "#d5dbe1";
inline constexpr const char* kGood = "#1e8449";
inline constexpr const char* kBad = "#c0392b";
inline constexpr const char* kError = "#d500f9";
inline constexpr const char* kDot = "#ff8f00";
inline constexpr const char* kEdge = "#2979ff";
inline constexpr const char* kWindow = "#1565c0";
inline constexpr const char* kPattern = "#8e24aa";
}  // namespace colour

class Svg {
  public:
    /// Starts a drawing with a white background. The size is in user units.
    Svg(double width, double height, std::string_view title);

    /// Appends formatted markup and a line break. The markup is not escaped.
    template <typename... Values>
    void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
        text_ += '\n';
    }
    void line(Point from, Point to, std::string_view attributes);
    void circle(Point centre, double radius, std::string_view attributes);
    /// Draws filled discs of equal size as a single element. `attributes` must set the colour with
    /// `stroke`.
    void discs(std::span<const Point> centres, double diameter, std::string_view attributes);
    /// Draws a line with an arrowhead at its end. `width` is the width of the line.
    void arrow(Point from, Point to, double width, std::string_view colour,
               std::string_view attributes = {});
    /// Draws one line of text. `size` is the font size.
    void text(Point at, double size, std::string_view content, std::string_view attributes = {});

    std::string finish() &&;

  private:
    std::string text_;
};

/// Escapes text for use between tags or in an attribute. Replaces bytes that are not valid UTF-8,
/// and control characters other than tab and line feed, with the replacement character.
std::string escaped(std::string_view text);

/// Creates a file. `write` writes the contents to a stream. Throws Error if the file cannot be
/// written.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write);

}  // namespace dotpose::draw
