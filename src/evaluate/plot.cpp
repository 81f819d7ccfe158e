#include "evaluate/plot.hpp"

#include <algorithm>
#include <cmath>

namespace dotpose::plot {
namespace {

std::string filled(const char* colour) {
    return fmt::format(R"(fill="{}")", colour);
}

double width_of(const Axes::Line& line) {
    const double width = line.is_wide ? 6 : 2.2;
    return line.is_dashed ? 0.7 * width : width;
}

const char* dashes_of(const Axes::Line& line) {
    return line.is_dashed ? R"( stroke-dasharray="5 6")" : "";
}

bool is_point(Point p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

}  // namespace

double tick_step(double range, int min_count) {
    const double power = std::pow(10, std::floor(std::log10(range / min_count)));
    for (const double factor : {5.0, 2.5, 2.0}) {
        if (factor * power * min_count <= range * (1 + 1e-9)) return factor * power;
    }
    return power;
}

double rounded_up(double value) {
    if (!(value > 0)) return 1;
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double factor : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        if (factor * power >= value * (1 - 1e-9)) return factor * power;
    }
    return 10 * power;
}

double Scale::at(double value) const {
    const auto on = [this](double v) { return is_log ? std::log(v) : v; };
    return at_first + (on(value) - on(first)) / (on(last) - on(first)) * (at_last - at_first);
}

std::vector<double> Scale::ticks(int min_count) const {
    std::vector<double> result;
    if (!is_log) {
        // `last` is less than `first` if, for example, y points down as on a page.
        const auto [low, high] = std::minmax(first, last);
        const double step = tick_step(high - low, min_count);
        for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
            result.push_back(i * step + 0.0);  // adding 0 turns -0 into 0
        return result;
    }
    // If an axis covers more than about two decades, only powers of ten are labelled.
    const bool is_long = last / first > 150;
    for (double power = std::pow(10, std::floor(std::log10(first))); power <= last; power *= 10) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double value = factor * power;
            if (is_long && factor > 1) continue;
            if (value >= first * (1 - 1e-9) && value <= last * (1 + 1e-9)) result.push_back(value);
        }
    }
    return result;
}

Scale log_scale(double min, double max) {
    return {1 / rounded_up(1 / (0.9 * min)), rounded_up(1.1 * max), true};
}

Axes::Axes(Svg& svg, const Area& area, Scale x, Scale y) : svg_(svg), area_(area), x_(x), y_(y) {
    x_.at_first = area.left;
    x_.at_last = area.left + area.width;
    y_.at_first = area.top + area.height;
    y_.at_last = area.top;
}

void Axes::draw_y(std::string_view label) const {
    for (const double value : y_.ticks(4)) {
        const double y = y_.at(value);
        svg_.line({area_.left, y}, {area_.left + area_.width, y},
                  fmt::format(R"(stroke="{}" stroke-width="1")", draw::colour::kFrame));
        svg_.text({area_.left - 10, y + 5}, style::kFont, fmt::format("{:g}", value),
                  fmt::format(R"(text-anchor="end" fill="{}")", draw::colour::kQuiet));
    }
    svg_.text({area_.left, area_.top - 14}, style::kFont, label, filled(draw::colour::kInk));
}

void Axes::draw_x(std::string_view label) const {
    const double bottom = area_.top + area_.height;
    for (const double value : x_.ticks(5)) {
        const double x = x_.at(value);
        svg_.line({x, bottom}, {x, bottom + 6},
                  fmt::format(R"(stroke="{}" stroke-width="1")", draw::colour::kQuiet));
        svg_.text({x, bottom + 24}, style::kFont, fmt::format("{:g}", value),
                  fmt::format(R"(text-anchor="middle" fill="{}")", draw::colour::kQuiet));
    }
    svg_.line({area_.left, bottom}, {area_.left + area_.width, bottom},
              fmt::format(R"(stroke="{}" stroke-width="1.5")", draw::colour::kQuiet));
    svg_.text({area_.left + area_.width / 2, bottom + 50}, style::kFont, label,
              fmt::format(R"(text-anchor="middle" fill="{}")", draw::colour::kInk));
}

void Axes::curve(std::span<const Point> data, const Line& line) const {
    std::string path;
    bool is_open = false;
    for (const Point p : data) {
        if (!is_point(p)) {
            is_open = false;
            continue;
        }
        const Point q = at(p.x, p.y);
        path += fmt::format("{}{:.2f} {:.2f}", is_open ? 'L' : 'M', q.x, q.y);
        is_open = true;
    }
    svg_.add(R"(<path d="{}" fill="none" stroke="{}" stroke-width="{}" stroke-linejoin="round" )"
             R"(stroke-linecap="round"{}/>)",
             path, line.colour, width_of(line), dashes_of(line));
    if (!line.has_marks) return;
    for (const Point p : data) {
        if (!is_point(p)) continue;
        svg_.circle(at(p.x, p.y), 4,
                    fmt::format(R"(fill="#ffffff" stroke="{}" stroke-width="2.2")", line.colour));
    }
}

void Axes::band(std::span<const Point> low, std::span<const Point> high, const char* colour) const {
    std::string path;
    const auto add = [&](Point p) {
        if (!is_point(p)) return;
        const Point q = at(p.x, p.y);
        path += fmt::format("{}{:.2f} {:.2f}", path.empty() ? 'M' : 'L', q.x, q.y);
    };
    for (const Point p : low)
        add(p);
    for (std::size_t i = high.size(); i > 0; --i)
        add(high[i - 1]);
    svg_.add(R"(<path d="{}Z" fill="{}" fill-opacity="0.10"/>)", path, colour);
}

void draw_title(Svg& svg, double left, std::string_view title, std::string_view below) {
    svg.text({left, 44}, style::kTitleFont, title,
             fmt::format(R"(font-weight="bold" fill="{}")", draw::colour::kInk));
    if (!below.empty()) svg.text({left, 68}, style::kFont, below, filled(draw::colour::kQuiet));
}

double text_width(std::string_view text, double font) {
    return 0.54 * font * static_cast<double>(text.size());
}

double legend_entry(Svg& svg, Point at, const Axes::Line& line, std::string_view text) {
    constexpr double kLength = 30;
    svg.line(at, at + Point{kLength, 0},
             fmt::format(R"(stroke="{}" stroke-width="{}"{})", line.colour, width_of(line),
                         dashes_of(line)));
    if (line.has_marks) {
        svg.circle(at + Point{kLength / 2, 0}, 4,
                   fmt::format(R"(fill="#ffffff" stroke="{}" stroke-width="2.2")", line.colour));
    }
    svg.text(at + Point{kLength + 8, 5}, style::kFont, text, filled(draw::colour::kInk));
    return at.x + kLength + 34 + text_width(text, style::kFont);
}

}  // namespace dotpose::plot
