#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "draw/frame_panels.hpp"

namespace dotpose::draw {
namespace {

const DetectedDot& dot_of_seed(const Trace& trace, int seed) {
    return trace.dots[trace.seeds[static_cast<std::size_t>(seed)]];
}

/// Returns the radius of a dot in the drawing. Dots that were measured at their predicted positions
/// have no known area. They are drawn with a diameter of a third of the spacing, which is typical
/// of blurred dots.
double radius_of(const DetectedDot& dot, const FrameView& view) {
    return dot.area_px == 0 ? view.spacing() / 6
                            : std::sqrt(dot.area_px / std::numbers::pi) * view.scale();
}

void draw_axis(Point from, Point to, std::string_view name, Svg& svg) {
    svg.arrow(from, to, 4.5, colour::kInk);
    const Point along = to - from;
    const Point beyond = to + 24 / std::max(1.0, length(along)) * along;
    svg.text(beyond + Point{0, 10}, 32, name,
             R"(text-anchor="middle" font-style="italic" font-weight="bold" fill="#17202a" )"
             R"(stroke="#ffffff" stroke-width="7" paint-order="stroke")");
}

void draw_connections(const FrameView& view, Svg& svg) {
    const Trace& trace = view.trace();
    svg.add(R"(<g class="connections" stroke="{}" stroke-width="{:.2f}" )"
            R"(stroke-linecap="round" stroke-opacity="0.85">)",
            colour::kEdge, 3.5 * view.stroke());
    // The edges connect the dot centres of the first measurement, so no edges are drawn if the dots
    // were measured again.
    if (view.reached().edges && !trace.seeds.empty() && !view.is_dense()) {
        for (const SeedEdge& edge : trace.edges) {
            svg.line(view.at_dot(dot_of_seed(trace, edge.from)),
                     view.at_dot(dot_of_seed(trace, edge.to)), {});
        }
    }
    svg.add("</g>");
}

void draw_dots(const FrameView& view, Svg& svg) {
    const double stroke = view.stroke();
    const std::span<const DetectedDot> dots = view.trace().dots;
    svg.add(R"(<g class="dots" fill="none" stroke="{}" stroke-width="{:.2f}">)", colour::kDot,
            3.5 * stroke);
    if (view.is_dense()) {
        std::vector<Point> centres;
        for (const DetectedDot& dot : dots)
            centres.push_back(view.at_dot(dot));
        svg.discs(centres, view.spacing() / 2, R"(stroke-opacity="0.7")");
    } else {
        for (const DetectedDot& dot : dots)
            svg.circle(view.at_dot(dot), radius_of(dot, view) + 2 * stroke, {});
    }
    svg.add("</g>");
}

}  // namespace

void draw_detection(const FrameView& view, Svg& svg) {
    const Trace& trace = view.trace();
    const double stroke = view.stroke();
    draw_connections(view, svg);
    draw_dots(view, svg);
    if (view.reached().axes) {
        svg.circle(view.at(from_q16(trace.lattice.origin_q16)), 0.42 * view.spacing(),
                   fmt::format(R"(class="origin" fill="none" stroke="{}" stroke-width="{:.2f}")",
                               colour::kBad, 7 * stroke));
    }
}

void draw_edges(const FrameView& view, double side, Svg& svg) {
    const Point middle{side / 2, side / 2};
    svg.add(R"(<rect width="{0:.0f}" height="{0:.0f}" fill="#f7f9fb" stroke="{1}"/>)", side,
            colour::kFrame);
    if (!view.reached().edges) {
        svg.text(middle + Point{0, 10}, 28, "no connections",
                 R"(text-anchor="middle" fill="#6b7885")");
        return;
    }
    svg.add(R"(<g stroke="{}" stroke-width="1.5">)", colour::kFrame);
    svg.line({0, middle.y}, {side, middle.y}, {});
    svg.line({middle.x, 0}, {middle.x, side}, {});
    svg.add("</g>");
    // The square extends 1.7 spacings from its centre to each side, because the longest edges are
    // about 1.5 spacings long.
    const double scale = side / 2 / (1.7 * view.spacing() / view.scale());
    svg.add(R"(<g class="edges" fill="{0}" stroke="{0}" stroke-width="1" stroke-opacity="0.25">)",
            colour::kEdge);
    // Maximum number of edges to draw. If there are more, only every `step`-th edge is drawn. The
    // clusters are still visible.
    constexpr std::size_t kMaxEdges = 1000;
    const std::span<const SeedEdge> edges = view.trace().edges;
    const std::size_t step = 1 + edges.size() / kMaxEdges;
    for (std::size_t i = 0; i < edges.size(); i += step) {
        const SeedEdge& edge = edges[i];
        const Point end = middle + scale * from_q8(edge.step_q8);
        if (end.x < 0 || end.x > side || end.y < 0 || end.y > side) continue;
        svg.line(middle, end, {});
        svg.circle(end, 3.5, {});
    }
    svg.add("</g>");
    if (!view.reached().axes) return;
    const Point u = scale * from_q16(view.trace().lattice.u_q16);
    const Point v = scale * from_q16(view.trace().lattice.v_q16);
    svg.add(R"(<g stroke="{}" stroke-width="3" stroke-dasharray="3 7">)", colour::kInk);
    svg.line(middle, middle - u, {});
    svg.line(middle, middle - v, {});
    svg.add("</g>");
    draw_axis(middle, middle + u, "u", svg);
    draw_axis(middle, middle + v, "v", svg);
}

}  // namespace dotpose::draw
