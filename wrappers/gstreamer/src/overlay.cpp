#include "overlay.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/frame_view.hpp"

namespace dotpose::gstreamer {
namespace {

using draw::Point;

// Grey levels of black and white in the limited range of video signals.
constexpr std::uint8_t kBlack = 16;
constexpr std::uint8_t kWhite = 235;

class Canvas {
  public:
    explicit Canvas(const Luma& luma) : luma_(luma) {}

    void ring(Point centre, double radius, std::uint8_t grey) const {
        const int steps = static_cast<int>(std::ceil(4 * std::numbers::pi * radius));
        for (int i = 0; i < steps; ++i) {
            const double angle = 2 * std::numbers::pi * i / steps;
            put(centre + radius * Point{std::cos(angle), std::sin(angle)}, grey);
        }
    }
    void line(Point from, Point to, double radius, std::uint8_t grey) const {
        const Point step = to - from;
        const int steps = std::max(1, static_cast<int>(std::ceil(2 * draw::length(step))));
        for (int i = 0; i <= steps; ++i)
            disc(from + static_cast<double>(i) / steps * step, radius, grey);
    }

  private:
    void disc(Point centre, double radius, std::uint8_t grey) const {
        const int reach = static_cast<int>(std::ceil(radius));
        for (int dv = -reach; dv <= reach; ++dv) {
            for (int du = -reach; du <= reach; ++du) {
                if (std::hypot(du, dv) <= radius) {
                    put(centre + Point{static_cast<double>(du), static_cast<double>(dv)}, grey);
                }
            }
        }
    }
    /// Sets the pixel that contains a point. Pixel (0, 0) extends from 0 to 1 in both coordinates.
    void put(Point point, std::uint8_t grey) const {
        if (!(point.x >= 0 && point.x < luma_.width_px)) return;
        if (!(point.y >= 0 && point.y < luma_.height_px)) return;
        luma_.pixels[static_cast<std::ptrdiff_t>(point.y) * luma_.stride_bytes +
                     static_cast<std::ptrdiff_t>(point.x)] = grey;
    }

    Luma luma_;
};

void draw_arrow(const Canvas& canvas, Point from, Point direction, double length) {
    const Point to = from + length * direction;
    const Point across{-direction.y, direction.x};
    const auto draw = [&](double radius, std::uint8_t grey) {
        canvas.line(from, to, radius, grey);
        for (const double side : {-1.0, 1.0})
            canvas.line(to, to - 0.3 * length * direction + side * 0.2 * length * across, radius,
                        grey);
    };
    // The light outline keeps the arrow visible on dots and in shadows.
    draw(2.5, kWhite);
    draw(1, kBlack);
}

}  // namespace

void draw_overlay(const Luma& luma, const Trace& trace) {
    const int side_px = std::max(luma.width_px, luma.height_px);
    const ImageView image = {luma.pixels, luma.width_px, luma.height_px, luma.stride_bytes};
    // Scales the drawing so that one unit is one pixel.
    const draw::FrameView view(image, trace, side_px);
    const Canvas canvas(luma);
    const double radius = std::max(2.0, 0.3 * view.spacing());
    for (const DetectedDot& dot : trace.dots)
        canvas.ring(view.at_dot(dot), radius, kBlack);
    if (!view.reached().pose) return;
    draw_arrow(canvas, view.at(view.reference_px()), view.ahead_of_reference(), 0.15 * side_px);
}

}  // namespace dotpose::gstreamer
