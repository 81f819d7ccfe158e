// Draws the sheets before and after stitching, in two panels. For each frame that shows two sheets,
// the position of the image centre is computed from each sheet. An arrow shows the difference
// between the two positions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/two_panels.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kMaxArrow = 70;
/// Minimum full-scale value of the arrows, in mm. This minimum keeps the arrows short if the
/// differences are only noise.
constexpr double kMinArrowScale_mm = 0.002;

/// Image centre of one frame, and the difference between the positions computed from the two
/// sheets. Both members are in world coordinates, in mm, except that y points down.
struct Disagreement {
    Point at;
    Point off;
};

/// Converts a point on a sheet to world coordinates in mm, except that y points down as in the
/// drawing. The sheet must have a world pose.
Point in_world(const SheetEntry& entry, double x_mm, double y_mm) {
    const WorldPlace place = world_place({&entry, x_mm, y_mm, 0, {}}).value();
    return {1000 * place.x_m, -1000 * place.y_m};
}
Point in_world_from_first(const SheetEntry& entry, double x_mm, double y_mm) {
    return in_world(entry, entry.sheet.origin_x_mm + entry.print_scale_x * x_mm,
                    entry.sheet.origin_y_mm + entry.print_scale_y * y_mm);
}

std::vector<Disagreement> disagreements(std::span<const SheetEntry> sheets,
                                        const Stitching& stitching) {
    std::vector<Disagreement> result;
    for (const SeamMeasurement& seen : stitching.measurements) {
        const SheetEntry& first = sheets[seen.first];
        const SheetEntry& second = sheets[seen.second];
        if (!first.world || !second.world) continue;
        const Point a = in_world_from_first(first, seen.first_x_mm, seen.first_y_mm);
        const Point b = in_world_from_first(second, seen.second_x_mm, seen.second_y_mm);
        result.push_back({0.5 * (a + b), a - b});
    }
    return result;
}

std::vector<Point> corners_of(const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    return {in_world(entry, 0, 0), in_world(entry, sheet.width_mm, 0),
            in_world(entry, sheet.width_mm, sheet.height_mm), in_world(entry, 0, sheet.height_mm)};
}

class StitchingPicture {
  public:
    StitchingPicture(std::span<const SheetEntry> before, const Stitching& stitching)
        : stitching_(stitching), svg_(two_panels("Stitched sheets")) {
        Point high{-kFar, -kFar};
        for (const auto& sheets : {before, std::span<const SheetEntry>(stitching.sheets)}) {
            for (const SheetEntry& entry : sheets) {
                if (!entry.world) continue;
                for (const Point corner : corners_of(entry)) {
                    low_ = {std::min(low_.x, corner.x), std::min(low_.y, corner.y)};
                    high = {std::max(high.x, corner.x), std::max(high.y, corner.y)};
                }
            }
        }
        per_mm_ = kPanelSide / std::max({high.x - low_.x, high.y - low_.y, 1.0});
        draw_panel(0, "Before", before, colour::kBad);
        draw_panel(1, "After", stitching.sheets, colour::kGood);
    }

    std::string finish() && { return std::move(svg_).finish(); }

  private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();

    Point on_drawing(int panel, Point world_mm) const {
        return panel_corner(panel) + per_mm_ * (world_mm - low_);
    }

    void draw_panel(int panel, const std::string& title, std::span<const SheetEntry> sheets,
                    const char* ink) {
        for (const SheetEntry& entry : sheets) {
            if (entry.world) draw_sheet(panel, entry);
        }
        const std::vector<Disagreement> all = disagreements(sheets, stitching_);
        double full_mm = kMinArrowScale_mm;
        double squares = 0;
        for (const Disagreement& one : all) {
            full_mm = std::max(full_mm, length(one.off));
            squares += one.off.x * one.off.x + one.off.y * one.off.y;
        }
        for (const Disagreement& one : all) {
            const Point at = on_drawing(panel, one.at);
            svg_.arrow(at, at + kMaxArrow / full_mm * one.off, 1.6, ink);
        }
        draw_panel_head(
            panel, title,
            all.empty()
                ? std::string("not all of these sheets had a world pose")
                : fmt::format("{:.4f} mm rms per axis; longest arrow {:.4f} mm",
                              std::sqrt(squares / 2 / static_cast<double>(all.size())), full_mm),
            svg_);
    }

    void draw_sheet(int panel, const SheetEntry& entry) {
        std::string points;
        for (const Point corner : corners_of(entry)) {
            const Point at = on_drawing(panel, corner);
            points += fmt::format("{:.2f},{:.2f} ", at.x, at.y);
        }
        svg_.add(R"(<polygon points="{}" fill="{}" fill-opacity="0.06" stroke="{}" )"
                 R"(stroke-width="1.2"/>)",
                 points, colour::kEdge, colour::kInk);
        const Sheet& sheet = entry.sheet;
        const Point middle =
            on_drawing(panel, in_world(entry, sheet.width_mm / 2, sheet.height_mm / 2));
        svg_.text(middle, 22, entry.name, R"(text-anchor="middle" fill="#17202a")");
        svg_.text(middle + Point{0, 24}, 15,
                  fmt::format("{:.5f} x {:.5f}", entry.print_scale_x, entry.print_scale_y),
                  R"(text-anchor="middle" fill="#6b7885")");
    }

    const Stitching& stitching_;
    Point low_{kFar, kFar};
    double per_mm_ = 1;
    Svg svg_;
};

}  // namespace

void draw_stitching(const std::filesystem::path& path, std::span<const SheetEntry> before,
                    const Stitching& stitching) {
    const std::string picture = StitchingPicture(before, stitching).finish();
    write_file(path, [&picture](std::ostream& stream) { stream << picture; });
}

}  // namespace dotpose
