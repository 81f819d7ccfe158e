// Draws the residuals before and after a calibration, and a map of the dot density across the
// image.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kMargin = 30;
constexpr double kHead = 74;
constexpr double kMaxSide = 520;
/// Minimum full-scale value of the arrows, in px. This minimum keeps the arrows short if the
/// residuals are only noise.
constexpr double kMinFullScale_px = 0.05;

using Part = ResidualField::Part;

Point point_of(PixelPoint pixel) {
    return {pixel.u, pixel.v};
}

class CalibrationPicture {
  public:
    explicit CalibrationPicture(const LensCalibration& calibration)
        : calibration_(calibration),
          width_px_(calibration.camera.width_px),
          height_px_(calibration.camera.height_px),
          scale_(kMaxSide / std::max(width_px_, height_px_)),
          field_(residual_field(calibration)),
          svg_(3 * width() + 4 * kMargin, height() + kHead + 2 * kMargin, "Calibration of a lens") {
    }

    std::string draw() && {
        draw_field(0, "Before", calibration_.residual_before_px, &Part::before, colour::kBad);
        draw_field(1, "After", calibration_.residual_px, &Part::after, colour::kGood);
        draw_coverage();
        return std::move(svg_).finish();
    }

  private:
    double width() const { return width_px_ * scale_; }
    double height() const { return height_px_ * scale_; }
    Point corner(int panel) const {
        return {kMargin + panel * (width() + kMargin), kMargin + kHead};
    }

    void draw_frame(int panel, const std::string& title, const std::string& legend) {
        const Point at = corner(panel);
        svg_.text({at.x, at.y - 44}, 24, title, R"(font-weight="bold" fill="#17202a")");
        svg_.text({at.x, at.y - 14}, 17, legend, R"(fill="#6b7885")");
        svg_.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="none" )"
                 R"(stroke="{}" stroke-width="2"/>)",
                 at.x, at.y, width(), height(), colour::kFrame);
    }

    /// Calls `use(part, middle)` for each part of the image that contains dots. `middle` is the
    /// centre of the part in the drawing.
    template <typename Use>
    void visit(int panel, Use use) const {
        for (int j = 0; j < field_.rows; ++j) {
            for (int i = 0; i < field_.columns; ++i) {
                const Part& part = field_.parts[static_cast<std::size_t>(j * field_.columns + i)];
                if (part.dots == 0) continue;
                use(part, corner(panel) + scale_ * field_.part_px * Point{i + 0.5, j + 0.5});
            }
        }
    }

    void draw_field(int panel, const std::string& title, double rms_px, PixelPoint Part::*residual,
                    const char* ink) {
        double full_px = kMinFullScale_px;
        visit(panel, [&](const Part& part, Point) {
            full_px = std::max(full_px, length(1.0 / part.dots * point_of(part.*residual)));
        });
        draw_frame(panel, title,
                   fmt::format("{:.3f} px rms per dot; longest arrow {:.2f} px", rms_px, full_px));
        const double per_px = 0.95 * field_.part_px * scale_ / full_px;
        visit(panel, [&](const Part& part, Point at) {
            svg_.arrow(at, at + per_px / part.dots * point_of(part.*residual), 1.4, ink);
        });
    }

    void draw_coverage() {
        int max_dots = 1;
        for (const Part& part : field_.parts)
            max_dots = std::max(max_dots, part.dots);
        draw_frame(2, "Coverage",
                   fmt::format("{} dots of {} frames; {:.0f} % of the image", calibration_.dots,
                               calibration_.located, 100 * calibration_.coverage));
        const double side = field_.part_px * scale_;
        visit(2, [&](const Part& part, Point at) {
            svg_.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}" )"
                     R"(opacity="{:.2f}"/>)",
                     at.x - side / 2, at.y - side / 2, std::min(side, right() - at.x + side / 2),
                     std::min(side, bottom() - at.y + side / 2), colour::kEdge,
                     0.08 + 0.8 * part.dots / max_dots);
        });
    }
    double right() const { return corner(2).x + width(); }
    double bottom() const { return corner(2).y + height(); }

    const LensCalibration& calibration_;
    int width_px_;
    int height_px_;
    double scale_;
    ResidualField field_;
    Svg svg_;
};

}  // namespace

void draw_calibration(const std::filesystem::path& path, const LensCalibration& calibration) {
    const std::string picture = CalibrationPicture(calibration).draw();
    write_file(path, [&picture](std::ostream& stream) { stream << picture; });
}

}  // namespace dotpose
