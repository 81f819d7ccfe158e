// Draws a frame in two panels side by side. Below the panels are the plot of the edges, the pose
// and the legend.
#include <algorithm>
#include <ostream>
#include <string>

#include "dotpose/tools/draw.hpp"
#include "draw/embedded_image.hpp"
#include "draw/frame_panels.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kFrameMargin = 36;
constexpr double kPanelWidth = 1200;
constexpr double kMinPanelHeight = 240;
constexpr double kFrameHead = 64;
constexpr double kStripHeight = 360;
constexpr double kWidth = 2 * kPanelWidth + 3 * kFrameMargin;

/// Estimates the width of a string in the widest font that an SVG viewer may use.
double text_width(std::string_view text, double size) {
    return 0.64 * size * static_cast<double>(std::max<std::size_t>(text.size(), 1));
}

class Sketch {
  public:
    Sketch(ImageView image, const Trace& trace, const DrawOptions& draw_options)
        : view_(image, trace, kPanelWidth),
          draw_options_(draw_options),
          panel_height_(std::max(view_.height(), kMinPanelHeight)),
          svg_(kWidth, height(), draw_options.title) {
        define_frame(image);
    }

    std::string draw() && {
        begin_panel(kFrameMargin, "Dots and their neighbours", draw_options_.title, 1);
        draw_detection(view_, svg_);
        end_panel();
        begin_panel(2 * kFrameMargin + kPanelWidth, "The code read from them", reading_note(), 0.3);
        draw_reading(view_, svg_);
        end_panel();
        draw_strip();
        return std::move(svg_).finish();
    }

  private:
    double height() const { return 3 * kFrameMargin + kFrameHead + panel_height_ + kStripHeight; }

    std::string reading_note() const {
        if (view_.reached().place) {
            const Trace& trace = view_.trace();
            const Cell cell = place_of(trace, window_corner(trace)).cell;
            return fmt::format("window decoded at {}, {}", cell.x, cell.y);
        }
        return view_.reached().cells ? "turn unknown: letters as on the grid" : "";
    }

    /// Defines the image once in the SVG, because both panels show it.
    void define_frame(ImageView image) {
        const std::string uri = data_uri(image, static_cast<int>(kPanelWidth));
        svg_.add("<defs>");
        if (!uri.empty()) {
            svg_.add(R"(<image id="frame" width="{:.2f}" height="{:.2f}" )"
                     R"(preserveAspectRatio="none" style="image-rendering:pixelated" )"
                     R"(image-rendering="optimizeSpeed" xlink:href="{}"/>)",
                     view_.width(), view_.height(), uri);
        } else {
            svg_.add(R"(<g id="frame"/>)");
        }
        svg_.add(R"(<clipPath id="panel"><rect width="{:.2f}" height="{:.2f}"/></clipPath>)",
                 view_.width(), view_.height());
        svg_.add("</defs>");
    }

    void begin_panel(double x, std::string_view head, std::string_view note, double opacity) {
        constexpr double kHeadSize = 38;
        constexpr double kNoteSize = 30;
        const double room = kPanelWidth - text_width(head, kHeadSize) - kFrameMargin;
        svg_.text({x, kFrameMargin + 38}, kHeadSize, head, R"(font-weight="bold" fill="#17202a")");
        svg_.text({x + kPanelWidth, kFrameMargin + 38},
                  std::min(kNoteSize, kNoteSize * room / text_width(note, kNoteSize)), note,
                  R"(text-anchor="end" fill="#6b7885")");
        const double y = kFrameMargin + kFrameHead;
        svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg",
                 x + (kPanelWidth - view_.width()) / 2, y);
        svg_.add(R"svg(<g clip-path="url(#panel)"><use xlink:href="#frame" opacity="{}"/>)svg",
                 opacity);
    }
    void end_panel() {
        svg_.add(R"(</g><rect width="{:.2f}" height="{:.2f}" fill="none" stroke="{}" )"
                 R"(stroke-width="2"/></g>)",
                 view_.width(), view_.height(), colour::kFrame);
    }

    void draw_strip() {
        const double y = 2 * kFrameMargin + kFrameHead + panel_height_;
        svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg", kFrameMargin, y);
        draw_edges(view_, kStripHeight, svg_);
        svg_.add("</g>");
        const double x = 2.5 * kFrameMargin + kStripHeight;
        const double width = kWidth - kFrameMargin - x;
        svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg", x, y);
        draw_caption(view_, draw_options_, width, svg_);
        svg_.add("</g>");
        svg_.add(R"svg(<g transform="translate({:.2f} {:.2f})">)svg", x, y + kStripHeight - 14);
        draw_legend();
        svg_.add("</g>");
    }

    void draw_legend() {
        struct Item {
            double width;
            const char* text;
            std::string mark;
        };
        const auto ring = [](const char* colour, double radius, double stroke) {
            return fmt::format(
                R"(<circle cx="18" cy="-10" r="{}" fill="none" stroke="{}" stroke-width="{}"/>)",
                radius, colour, stroke);
        };
        const auto stroke = [](const char* colour, double width) {
            return fmt::format(
                R"(<line x1="0" y1="-10" x2="36" y2="-10" stroke="{}" stroke-width="{}"/>)", colour,
                width);
        };
        const Item items[] = {
            {112, "dot", ring(colour::kDot, 11, 4)},
            {220, "connection", stroke(colour::kEdge, 5)},
            {218, "grid origin", ring(colour::kBad, 14, 6)},
            {168, "window",
             fmt::format(R"(<rect x="3" y="-25" width="30" height="30" fill="none" stroke="{}" )"
                         R"(stroke-width="6"/>)",
                         colour::kWindow)},
            {214, "its position", ring(colour::kWindow, 14, 6)},
            {180, "image x", stroke(colour::kInk, 8)},
            {204, "pattern x", stroke(colour::kPattern, 8)},
            {182, "bit error", ring(colour::kError, 11, 6)},
            {224, "unread dot", ring(colour::kBad, 10, 3)},
        };
        double x = 0;
        for (const Item& item : items) {
            svg_.add(R"svg(<g transform="translate({:.2f} 0)">{})svg", x, item.mark);
            svg_.text({50, 0}, 27, item.text, R"(fill="#6b7885")");
            svg_.add("</g>");
            x += item.width;
        }
        draw_quality_bar(x);
    }

    void draw_quality_bar(double x) {
        svg_.add(R"(<linearGradient id="quality"><stop offset="0" stop-color="{}"/>)"
                 R"(<stop offset="0.5" stop-color="#d68910"/>)"
                 R"(<stop offset="1" stop-color="{}"/></linearGradient>)",
                 colour::kBad, colour::kGood);
        svg_.add(R"svg(<rect x="{:.2f}" y="-24" width="70" height="26" rx="13" )svg"
                 R"svg(fill="url(#quality)"/>)svg",
                 x);
        svg_.text({x + 84, 0}, 27, "likelihood", R"(fill="#6b7885")");
    }

    FrameView view_;
    const DrawOptions& draw_options_;
    double panel_height_;
    Svg svg_;
};

}  // namespace

void draw_frame(std::ostream& out, ImageView image, const Trace& trace,
                const DrawOptions& draw_options) {
    out << Sketch(image, trace, draw_options).draw();
}

void draw_frame(const std::filesystem::path& path, ImageView image, const Trace& trace,
                const DrawOptions& draw_options) {
    draw::write_file(path, [&](std::ostream& out) { draw_frame(out, image, trace, draw_options); });
}

}  // namespace dotpose
