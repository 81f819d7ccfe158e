// Draws the figures in docs/speed.md.
#include <algorithm>
#include <ostream>

#include "benchmarks.hpp"
#include "evaluate/plot.hpp"

namespace dotpose::bench {
namespace {

using namespace dotpose::plot;

constexpr double kWidth = 900;
constexpr double kHeight = 560;
constexpr Axes::Area kArea{80, 150, kWidth - 120, 320};

constexpr const char* kOnce = "#1e8449";
constexpr const char* kDevice = "#8e24aa";
constexpr const char* kTag = "#ef6c00";
constexpr const char* kFloor = draw::colour::kQuiet;

using Value = double (*)(const FrameTimes&);

/// Accessors for the times in FrameTimes, in µs. A time is 0 if it was not measured.
constexpr Value kLocate_us = [](const FrameTimes& t) { return t.locate_us; };
constexpr Value kOnce_us = [](const FrameTimes& t) { return t.once_us; };
constexpr Value kDevice_us = [](const FrameTimes& t) { return t.device_us; };
constexpr Value kFloor_us = [](const FrameTimes& t) { return t.floor_us; };
constexpr Value kTag1_us = [](const FrameTimes& t) { return t.tag_us[0]; };
constexpr Value kTag2_us = [](const FrameTimes& t) { return t.tag_us[1]; };

struct Curve {
    std::string_view words;
    Axes::Line line;
    Value value;
};

struct Picture {
    const char* title;
    const char* under;
    const char* x_label;
    Value x;
    std::vector<Curve> curves;
};

std::vector<Point> data_of(const std::vector<FrameTimes>& times, Value x, Value y) {
    std::vector<Point> data;
    for (const FrameTimes& t : times) {
        if (y(t) > 0) data.push_back({x(t), y(t)});
    }
    return data;
}

Scale time_scale(const std::vector<FrameTimes>& times, const std::vector<Curve>& curves) {
    double min_us = 1e300;
    double max_us = 0;
    for (const Curve& curve : curves) {
        for (const Point p : data_of(times, curve.value, curve.value)) {
            min_us = std::min(min_us, p.y);
            max_us = std::max(max_us, p.y);
        }
    }
    return log_scale(min_us, max_us);
}

void draw(std::ostream& out, const std::vector<FrameTimes>& times, const Picture& picture) {
    Svg svg(kWidth, kHeight, picture.title);
    draw_title(svg, kArea.left, picture.title, picture.under);
    const Scale x{0.9 * picture.x(times.front()), 1.1 * picture.x(times.back()), true};
    const Axes axes(svg, kArea, x, time_scale(times, picture.curves));
    axes.draw_y("µs per frame");
    axes.draw_x(picture.x_label);
    double legend_x = kArea.left;
    for (const Curve& curve : picture.curves) {
        axes.curve(data_of(times, picture.x, curve.value), curve.line);
        legend_x = legend_entry(svg, {legend_x, 98}, curve.line, curve.words);
    }
    out << std::move(svg).finish();
}

}  // namespace

void draw_pixels(std::ostream& out, const std::vector<FrameTimes>& times) {
    draw(out, times,
         {"Time against pixels",
          "one thread; nominal frames of 188 x 120 to 4096 x 4096 px, 11 px per spacing",
          "megapixels",
          [](const FrameTimes& t) { return t.megapixels(); },
          {{"apriltag 1", {kTag, true}, kTag1_us},
           {"apriltag 2", {kTag}, kTag2_us},
           {"locate", {style::kAll}, kLocate_us},
           {"effort device", {kDevice, true}, kDevice_us},
           {"one pass", {kFloor}, kFloor_us}}});
}

void draw_dots(std::ostream& out, const std::vector<FrameTimes>& times) {
    // The curve of the default effort is drawn wide to remain visible beneath the curve of
    // `Effort::once`. The two curves coincide where no frame needs a second attempt.
    draw(out, times,
         {"Time against dots",
          "one thread; nominal frames of 640 x 480 px, 40 to 7 px per spacing",
          "dots in view",
          [](const FrameTimes& t) { return t.dots; },
          {{"locate", {style::kAll, false, false, true}, kLocate_us},
           {"effort once", {kOnce}, kOnce_us},
           {"effort device", {kDevice, true}, kDevice_us}}});
}

}  // namespace dotpose::bench
