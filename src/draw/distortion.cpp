// Draws the distortion of a print as a map with one enlarged arrow for each part of the page.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "dotpose/tools/check_print.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kMapMargin = 40;
constexpr double kMapHead = 110;
constexpr double kMaxMapSide = 1000;
/// Limits of the arrow length: at most kMaxArrow drawing units, and at most kMaxStep times the
/// distance between arrows.
constexpr double kMaxArrow = 45;
constexpr double kMaxStep = 0.95;
/// Minimum full-scale value of the arrows, in mm. This minimum keeps the arrows short if the
/// distortions are only noise.
constexpr double kMinMapScale_mm = 0.01;

/// Rounds down to 1, 2 or 5 times a power of ten.
double round_down(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= value) return factor * power;
    }
    return power;
}

class DistortionMap {
  public:
    DistortionMap(const ImageView& scan, const PrintCheck& check)
        : check_(check),
          scale_(kMaxMapSide / std::max(scan.width_px, scan.height_px)),
          width_(scan.width_px * scale_),
          height_(scan.height_px * scale_),
          svg_(std::max(width_, 560.0) + 2 * kMapMargin, height_ + kMapHead + 2 * kMapMargin,
               "Distortion of a print") {
        full_mm_ = kMinMapScale_mm;
        double longest = kMaxArrow;
        for (const PrintField& field : check.fields) {
            full_mm_ = std::max(full_mm_, field.largest_distortion_mm);
            longest = std::min(longest, kMaxStep * kDistortionCells * field.spacing_px * scale_);
        }
        per_mm_ = longest / full_mm_;
    }

    std::string draw() && {
        draw_head();
        svg_.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="none" )"
                 R"(stroke="{}" stroke-width="2"/>)",
                 kMapMargin, kMapMargin + kMapHead, width_, height_, colour::kFrame);
        for (const PrintField& field : check_.fields) {
            for (const DistortionBin& bin : field.distortion)
                draw_bin(bin);
        }
        return std::move(svg_).finish();
    }

  private:
    void draw_head() {
        const double shown_mm = round_down(full_mm_);
        const double y = kMapMargin + 80;
        svg_.text({kMapMargin, kMapMargin + 28}, 30, "Dot places relative to the fitted page",
                  R"(font-weight="bold" fill="#17202a")");
        svg_.arrow({kMapMargin, y}, {kMapMargin + shown_mm * per_mm_, y}, 2.5, colour::kEdge);
        svg_.text({kMapMargin + shown_mm * per_mm_ + 14, y + 7}, 20,
                  fmt::format("{:g} mm; largest {:.3f} mm, one arrow for about {} x {} dots",
                              shown_mm, full_mm_, kDistortionCells, kDistortionCells),
                  R"(fill="#6b7885")");
    }

    void draw_bin(const DistortionBin& bin) {
        const Point at{kMapMargin + (bin.u_px + 0.5) * scale_,
                       kMapMargin + kMapHead + (bin.v_px + 0.5) * scale_};
        const Point tip = at + per_mm_ * Point{bin.du_mm, bin.dv_mm};
        const double fraction = std::min(std::hypot(bin.du_mm, bin.dv_mm) / full_mm_, 1.0);
        // The colour ranges from blue for small distortions to red for large ones.
        const auto strength = [](double part) { return static_cast<int>(std::lround(210 * part)); };
        const std::string colour =
            fmt::format("#{:02x}40{:02x}", strength(fraction), strength(1 - fraction));
        svg_.circle(at, 2.2, fmt::format(R"(fill="{}")", colour));
        svg_.arrow(at, tip, 2, colour);
    }

    const PrintCheck& check_;
    double scale_;
    double width_;
    double height_;
    double per_mm_ = 1;
    double full_mm_ = 0;
    Svg svg_;
};

}  // namespace

void draw_distortion(const std::filesystem::path& path, const ImageView& scan,
                     const PrintCheck& check) {
    write_file(path, [&](std::ostream& out) { out << DistortionMap(scan, check).draw(); });
}

}  // namespace dotpose
