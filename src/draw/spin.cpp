// Draws the rotation of a robot on the spot: the camera positions, and the centre of rotation
// computed from each frame.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <string>

#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/deviation.hpp"
#include "draw/two_panels.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

/// Minimum full-scale value of the panel, in mm. If the residuals are only noise, this minimum
/// keeps them in a small part of the panel.
constexpr double kMinFullScale_mm = 0.001;

class SpinPicture {
  public:
    explicit SpinPicture(const SpinCalibration& spin)
        : spin_(spin), svg_(two_panels("A turn on the spot")) {}

    std::string draw() && {
        draw_turn();
        draw_residuals();
        return std::move(svg_).finish();
    }

  private:
    Point middle(int panel) const {
        return panel_corner(panel) + Point{kPanelSide / 2, kPanelSide / 2};
    }

    void draw_frame(int panel, const std::string& title, const std::string& legend) {
        draw_panel_head(panel, title, legend, svg_);
        const Point at = panel_corner(panel);
        svg_.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="none" )"
                 R"(stroke="{}" stroke-width="2"/>)",
                 at.x, at.y, kPanelSide, kPanelSide, colour::kFrame);
    }

    void draw_cross(Point at, const char* ink) {
        const std::string style = fmt::format(R"(stroke="{}" stroke-width="2.5")", ink);
        svg_.line(at - Point{9, 0}, at + Point{9, 0}, style);
        svg_.line(at - Point{0, 9}, at + Point{0, 9}, style);
    }

    /// Draws the field of view of each frame on the paper, around the centre of rotation.
    void draw_turn() {
        const Camera& camera = spin_.camera;
        const double mm_per_px = camera.paper ? camera.paper->mm_per_px_x : 0;
        const double half_width = camera.width_px * mm_per_px / 2;
        const double half_height = camera.height_px * mm_per_px / 2;
        double reach_mm = 1;
        for (const SpinStation& station : spin_.stations) {
            reach_mm = std::max(reach_mm, std::hypot(station.x_mm, station.y_mm) +
                                              std::hypot(half_width, half_height));
        }
        const double per_mm = kPanelSide / 2 / (1.05 * reach_mm);
        draw_frame(0, "The camera's turn",
                   fmt::format("image centre {:.2f} mm from the centre of the turn",
                               std::hypot(spin_.offset_mm.x_mm, spin_.offset_mm.y_mm)));
        for (const SpinStation& station : spin_.stations) {
            const Point at = middle(0) + per_mm * Point{station.x_mm, station.y_mm};
            svg_.line(middle(0), at, R"(stroke="#d5dbe1" stroke-width="1.5")");
            svg_.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" )"
                     R"svg(transform="translate({:.1f} {:.1f}) rotate({:.2f})" fill="{}" )svg"
                     R"(fill-opacity="0.1" stroke="{}" stroke-width="1.5"/>)",
                     -half_width * per_mm, -half_height * per_mm, 2 * half_width * per_mm,
                     2 * half_height * per_mm, at.x, at.y,
                     station.theta_rad * 180 / std::numbers::pi, colour::kEdge, colour::kEdge);
            const Point ahead{std::cos(station.theta_rad), std::sin(station.theta_rad)};
            svg_.arrow(at, at + 26 * ahead, 2, colour::kEdge);
        }
        draw_cross(middle(0), colour::kBad);
    }

    /// Draws the centre of rotation computed from each individual frame. The centre computed from
    /// all frames is in the middle of the panel.
    void draw_residuals() {
        double full_mm = kMinFullScale_mm;
        for (const SpinStation& station : spin_.stations)
            full_mm = std::max(full_mm, std::hypot(station.off_x_mm, station.off_y_mm));
        const double per_mm = 0.45 * kPanelSide / full_mm;
        draw_frame(1, "What stays put",
                   fmt::format("{:.4f} mm rms; farthest {:.4f}; circle:{} mm", spin_.residual_mm,
                               full_mm, plus_minus(spin_.sigma_mm, 4)));
        for (const SpinStation& station : spin_.stations) {
            const Point off = per_mm * Point{station.off_x_mm, station.off_y_mm};
            svg_.circle(middle(1) + off, 4, fmt::format(R"(fill="{}")", colour::kGood));
        }
        draw_cross(middle(1), colour::kBad);
        svg_.circle(middle(1), per_mm * spin_.sigma_mm,
                    fmt::format(R"(fill="none" stroke="{}" stroke-width="1.5")", colour::kBad));
    }

    const SpinCalibration& spin_;
    Svg svg_;
};

}  // namespace

void draw_spin(const std::filesystem::path& path, const SpinCalibration& calibration) {
    const std::string picture = SpinPicture(calibration).draw();
    write_file(path, [&picture](std::ostream& stream) { stream << picture; });
}

}  // namespace dotpose
