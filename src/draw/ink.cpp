// Writes pen strokes as SVG and InkML.
#include "dotpose/tools/ink.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include <fmt/core.h>

#include "dotpose/files/degrees.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

constexpr double kMargin_mm = 5;
/// Line width of a ballpoint pen, in mm.
constexpr double kLine_mm = 0.4;

/// Returns the page unchanged if its size is known. Otherwise, returns the page with its size and
/// position set so that it contains all strokes and a margin around them.
InkPage with_size(InkPage page) {
    if (page.width_mm > 0) return page;
    constexpr double kFar = std::numeric_limits<double>::max();
    double left = kFar;
    double top = kFar;
    double right = -kFar;
    double bottom = -kFar;
    for (const InkStroke& stroke : page.strokes) {
        for (const InkPoint& point : stroke) {
            left = std::min(left, point.x_mm);
            right = std::max(right, point.x_mm);
            top = std::min(top, point.y_mm);
            bottom = std::max(bottom, point.y_mm);
        }
    }
    if (left > right) left = right = top = bottom = 0;
    page.left_mm = std::floor(left - kMargin_mm);
    page.top_mm = std::floor(top - kMargin_mm);
    page.width_mm = std::ceil(right + kMargin_mm) - page.left_mm;
    page.height_mm = std::ceil(bottom + kMargin_mm) - page.top_mm;
    return page;
}

/// Appends the coordinates of a point as "x y", in mm from the top left corner of the page.
void append_place(std::string& text, const InkPage& page, const InkPoint& point) {
    fmt::format_to(std::back_inserter(text), "{:.4f} {:.4f}", point.x_mm - page.left_mm,
                   point.y_mm - page.top_mm);
}

}  // namespace

std::string ink_svg(const InkPage& given) {
    const InkPage page = with_size(given);
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.10g}mm\" height=\"{1:.10g}mm\" "
        "viewBox=\"0 0 {0:.10g} {1:.10g}\">\n<title>{2}</title>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        "<g fill=\"none\" stroke=\"{3}\" stroke-width=\"{4}\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\">\n",
        page.width_mm, page.height_mm, draw::escaped(page.name.empty() ? "Ink" : page.name),
        draw::colour::kInk, kLine_mm);
    for (const InkStroke& stroke : page.strokes) {
        text += "<path d=\"M";
        for (const InkPoint& point : stroke) {
            if (&point != &stroke.front()) text += " L";
            append_place(text, page, point);
        }
        // A line of length 0 with round ends is visible as a dot.
        if (stroke.size() == 1) text += " h0";
        text += "\"/>\n";
    }
    return text + "</g>\n</svg>\n";
}

std::string ink_ml(const InkPage& given) {
    const InkPage page = with_size(given);
    std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<ink xmlns=\"http://www.w3.org/2003/InkML\">\n"
        "<annotation type=\"title\">{}</annotation>\n"
        "<definitions>\n<context xml:id=\"page\">\n<inkSource xml:id=\"pen\">\n<traceFormat>\n"
        "<channel name=\"X\" type=\"decimal\" units=\"mm\"/>\n"
        "<channel name=\"Y\" type=\"decimal\" units=\"mm\"/>\n"
        "<channel name=\"T\" type=\"decimal\" units=\"ms\"/>\n"
        "<channel name=\"OTx\" type=\"decimal\" units=\"deg\"/>\n"
        "<channel name=\"OTy\" type=\"decimal\" units=\"deg\"/>\n"
        "</traceFormat>\n</inkSource>\n</context>\n</definitions>\n",
        draw::escaped(page.name.empty() ? "Ink" : page.name));
    for (const InkStroke& stroke : page.strokes) {
        text += "<trace contextRef=\"#page\">";
        for (const InkPoint& point : stroke) {
            if (&point != &stroke.front()) text += ", ";
            append_place(text, page, point);
            const double slope = std::tan(point.tilt_rad);
            fmt::format_to(std::back_inserter(text), " {:.3f} {:.2f} {:.2f}", 1000 * point.t_s,
                           std::atan(slope * std::cos(point.azimuth_rad)) * kDegrees,
                           std::atan(slope * std::sin(point.azimuth_rad)) * kDegrees);
        }
        text += "</trace>\n";
    }
    return text + "</ink>\n";
}

}  // namespace dotpose
