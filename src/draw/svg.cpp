#include "draw/svg.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "dotpose/files/error.hpp"

namespace dotpose::draw {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

/// Returns the number of bytes of the first character of a UTF-8 string, or 0 if this character is
/// invalid or not permitted in XML.
std::size_t character_bytes(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t first = byte(0);
    if (first < 0x80) return first >= 0x20 || first == '\t' || first == '\n' ? 1 : 0;
    const std::size_t count = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < count) return 0;
    std::uint32_t code_point = first & (0x7FU >> count);
    for (std::size_t i = 1; i < count; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return 0;
        code_point = code_point << 6 | (byte(i) & 0x3FU);
    }
    constexpr std::uint32_t kMinCode[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code_point >= 0xD800 && code_point < 0xE000;
    const bool is_character = code_point >= kMinCode[count] && code_point < 0x110000 &&
                              !is_surrogate && code_point != 0xFFFE && code_point != 0xFFFF;
    return is_character ? count : 0;
}

}  // namespace

double length(Point a) {
    return std::hypot(a.x, a.y);
}

std::string escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t count = character_bytes(text);
        const std::string_view character = text.substr(0, count);
        if (count == 0) {
            result += kReplacement;
        } else if (character == "&") {
            result += "&amp;";
        } else if (character == "<") {
            result += "&lt;";
        } else if (character == ">") {
            result += "&gt;";
        } else if (character == "\"") {
            result += "&quot;";
        } else {
            result += character;
        }
        text.remove_prefix(count == 0 ? 1 : count);
    }
    return result;
}

Svg::Svg(double width, double height, std::string_view title) {
    add(R"(<?xml version="1.0" encoding="UTF-8"?>)");
    add(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
        R"(viewBox="0 0 {0:.0f} {1:.0f}" width="{0:.0f}" height="{1:.0f}" )"
        R"(font-family="Inter, 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif">)",
        width, height);
    add("<title>{}</title>", escaped(title));
    add(R"(<rect width="{:.0f}" height="{:.0f}" fill="#ffffff"/>)", width, height);
}

void Svg::line(Point from, Point to, std::string_view attributes) {
    add(R"(<line x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}" {}/>)", from.x, from.y, to.x, to.y,
        attributes);
}

void Svg::circle(Point centre, double radius, std::string_view attributes) {
    add(R"(<circle cx="{:.2f}" cy="{:.2f}" r="{:.2f}" {}/>)", centre.x, centre.y, radius,
        attributes);
}

void Svg::discs(std::span<const Point> centres, double diameter, std::string_view attributes) {
    // A line of length 0 with round ends is drawn as a disc.
    std::string path;
    for (const Point& centre : centres)
        path += fmt::format("M{:.1f} {:.1f}h0", centre.x, centre.y);
    add(R"(<path d="{}" stroke-width="{:.2f}" stroke-linecap="round" fill="none" {}/>)", path,
        diameter, attributes);
}

void Svg::arrow(Point from, Point to, double width, std::string_view colour,
                std::string_view attributes) {
    const Point along = to - from;
    const double distance = length(along);
    if (distance <= 0) return;
    const double head = std::min(4.5 * width, distance);
    const Point ahead = (1 / distance) * along;
    const Point side{-ahead.y, ahead.x};
    const Point neck = to - head * ahead;
    add(R"(<line x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}" stroke="{}" )"
        R"(stroke-width="{:.2f}" {}/>)",
        from.x, from.y, neck.x, neck.y, colour, width, attributes);
    const Point left = neck + 0.45 * head * side;
    const Point right = neck - 0.45 * head * side;
    add(R"(<path d="M{:.2f} {:.2f}L{:.2f} {:.2f}L{:.2f} {:.2f}Z" fill="{}"/>)", to.x, to.y, left.x,
        left.y, right.x, right.y, colour);
}

void Svg::text(Point at, double size, std::string_view content, std::string_view attributes) {
    add(R"(<text x="{:.2f}" y="{:.2f}" font-size="{:.2f}" {}>{}</text>)", at.x, at.y, size,
        attributes, escaped(content));
}

std::string Svg::finish() && {
    text_ += "</svg>\n";
    return std::move(text_);
}

void write_file(const std::filesystem::path& path,
                const std::function<void(std::ostream&)>& write) {
    errno = 0;
    std::ofstream stream(path, std::ios::binary);
    if (stream) write(stream);
    stream.close();
    if (!stream)
        throw Error(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace dotpose::draw
