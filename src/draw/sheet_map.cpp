// Draws the sheets in a sheet file. On the left is a map of the sheets in the world. On the right
// are the sheets without a world pose, each scaled so that its longer side has a fixed length.
#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/bounds.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kSide = 900;
constexpr double kSheetMargin = 50;
constexpr double kSheetHead = 70;
constexpr double kFoot = 60;
constexpr double kBox = 190;  // drawn length of the longer side of a sheet without a world pose
constexpr double kBoxPitch_x = 230;
constexpr double kBoxPitch_y = 300;
constexpr std::size_t kBoxRows = 3;
/// Maximum extent of the map. In a larger map, the numbers in the drawing would not be precise
/// enough to show a page.
constexpr double kMaxExtent_m = 1e7;
constexpr const char* kCentred = R"(text-anchor="middle" fill="#17202a")";
constexpr const char* kCentredQuiet = R"(text-anchor="middle" fill="#6b7885")";

/// Returns the corners of a page in the world, in metres and clockwise from the top left corner.
/// The page must have a world pose.
std::array<Point, 4> corners_m(const SheetEntry& entry) {
    const auto corner = [&entry](double x_mm, double y_mm) {
        const WorldPlace place = world_place({&entry, x_mm, y_mm, 0, {}}).value();
        return Point{place.x_m, place.y_m};
    };
    const Sheet& sheet = entry.sheet;
    return {corner(0, 0), corner(sheet.width_mm, 0), corner(sheet.width_mm, sheet.height_mm),
            corner(0, sheet.height_mm)};
}

/// Returns the bounding box of the world's origin and of all pages with a world pose. Omits the
/// origin if it would make the box more than kMaxRatioForOrigin times as large. Throws Error if the
/// box is too large to draw.
Bounds world_bounds(std::span<const SheetEntry> sheets) {
    constexpr double kMaxRatioForOrigin = 3;
    Bounds bounds;
    for (const SheetEntry& entry : sheets) {
        if (!entry.world) continue;
        for (const Point corner : corners_m(entry))
            bounds.add(corner);
    }
    Bounds with_origin = bounds;
    with_origin.add({0, 0});
    const bool is_near = with_origin.extent() <= kMaxRatioForOrigin * bounds.extent();
    const Bounds shown = is_near ? with_origin : bounds;
    if (!bounds.is_empty() && !(shown.extent() < kMaxExtent_m)) {
        throw Error(
            fmt::format("the sheets extend over {:g} km of the world: too far apart to draw",
                        shown.extent() / 1000));
    }
    return shown;
}

/// Rounds down to 1, 2 or 5 times a power of ten.
double round_length_m(double longest_m) {
    const double power = std::pow(10, std::floor(std::log10(longest_m)));
    for (const double digit : {5.0, 2.0}) {
        if (digit * power <= longest_m) return digit * power;
    }
    return power;
}

class SheetMap {
  public:
    explicit SheetMap(std::span<const SheetEntry> sheets)
        : sheets_(sheets),
          placed_(static_cast<std::size_t>(
              std::ranges::count_if(sheets, [](const SheetEntry& e) { return bool(e.world); }))),
          bounds_(world_bounds(sheets)),
          per_m_(placed_ > 0 ? kSide / bounds_.extent() : 1),
          svg_(width(), kSide + 2 * kSheetMargin + kSheetHead + kFoot, "Sheets") {}

    std::string draw() && {
        svg_.text({kSheetMargin, kSheetMargin + 24}, 28, "Sheets in the world",
                  R"(font-weight="bold" fill="#17202a")");
        if (placed_ == 0) {
            svg_.text({kSheetMargin, kSheetMargin + kSheetHead + 30}, 20,
                      "No sheet has a pose in the world: dotpose sheets place NAME ...",
                      R"(fill="#6b7885")");
        } else {
            for (const SheetEntry& entry : sheets_) {
                if (entry.world) draw_placed(entry);
            }
            draw_origin();
            draw_scale();
        }
        draw_unplaced();
        return std::move(svg_).finish();
    }

  private:
    double width() const {
        const std::size_t rest = sheets_.size() - placed_;
        const std::size_t columns = (rest + kBoxRows - 1) / kBoxRows;
        const double right = std::max(static_cast<double>(columns) * kBoxPitch_x, 330.0);
        return kSide + 2 * kSheetMargin + (rest > 0 ? kSheetMargin + right : 0);
    }

    Point at(Point world_m) const {
        return {kSheetMargin + (world_m.x - bounds_.low.x) * per_m_,
                kSheetMargin + kSheetHead + (bounds_.high.y - world_m.y) * per_m_};
    }

    void draw_outline(std::span<const Point> corners) {
        std::string points;
        for (const Point corner : corners)
            points += fmt::format("{:.2f},{:.2f} ", corner.x, corner.y);
        svg_.add(R"(<polygon class="sheet" points="{}" fill="{}" fill-opacity="0.07" )"
                 R"(stroke="{}" stroke-width="1.2"/>)",
                 points, colour::kEdge, colour::kInk);
        // The pose of the page refers to its top left corner and upper edge, so both are marked.
        svg_.circle(corners[0], 5, fmt::format(R"(fill="{}")", colour::kBad));
        svg_.arrow(corners[0], corners[0] + 0.4 * (corners[1] - corners[0]), 2, colour::kBad);
    }

    void draw_placed(const SheetEntry& entry) {
        std::array<Point, 4> corners = corners_m(entry);
        for (Point& corner : corners)
            corner = at(corner);
        draw_outline(corners);
        const double widest =
            std::max(length(corners[1] - corners[0]), length(corners[3] - corners[0]));
        const double letters = static_cast<double>(std::max<std::size_t>(entry.name.size(), 6));
        const double size = std::clamp(1.5 * widest / letters, 9.0, 24.0);
        const Point middle = 0.5 * (corners[0] + corners[2]);
        svg_.text(middle, size, entry.name, kCentred);
        svg_.text(middle + Point{0, 1.2 * size}, 0.7 * size,
                  fmt::format("{:.3f}, {:.3f} m", entry.world->x_m, entry.world->y_m),
                  kCentredQuiet);
    }

    void draw_origin() {
        const Point origin = at({0, 0});
        const double reach = 70;
        const bool is_shown = origin.x >= kSheetMargin - 1 &&
                              origin.x <= kSheetMargin + kSide + 1 &&
                              origin.y >= kSheetMargin + kSheetHead - 1 &&
                              origin.y <= kSheetMargin + kSheetHead + kSide + 1;
        if (!is_shown) return;
        svg_.arrow(origin, origin + Point{reach, 0}, 3, colour::kGood, R"(class="axis")");
        svg_.arrow(origin, origin - Point{0, reach}, 3, colour::kGood, R"(class="axis")");
        const std::string ink = fmt::format(R"(fill="{}" font-weight="bold")", colour::kGood);
        svg_.text(origin + Point{reach + 6, 6}, 20, "x", ink);
        svg_.text(origin + Point{-6, -reach - 8}, 20, "y", ink);
    }

    void draw_scale() {
        const double length_m = round_length_m(0.4 * bounds_.extent());
        const double y =
            kSheetMargin + kSheetHead + (bounds_.high.y - bounds_.low.y) * per_m_ + kFoot;
        const Point end{kSheetMargin + length_m * per_m_, y};
        svg_.line({kSheetMargin, y}, end, R"(class="scale" stroke="#17202a" stroke-width="3")");
        svg_.text(end + Point{10, 6}, 18,
                  length_m < 1 ? fmt::format("{:g} mm", 1000 * length_m)
                               : fmt::format("{:g} m", length_m),
                  R"(fill="#17202a")");
    }

    void draw_unplaced() {
        if (placed_ == sheets_.size()) return;
        const double left = kSide + 2 * kSheetMargin;
        svg_.text({left, kSheetMargin + 24}, 28, "Without a pose",
                  R"(font-weight="bold" fill="#17202a")");
        svg_.text({left, kSheetMargin + 50}, 17, "not to scale", R"(fill="#6b7885")");
        std::size_t index = 0;
        for (const SheetEntry& entry : sheets_) {
            if (entry.world) continue;
            const auto column = static_cast<double>(index / kBoxRows);
            const auto row = static_cast<double>(index % kBoxRows);
            draw_box(entry,
                     {left + column * kBoxPitch_x, kSheetMargin + kSheetHead + row * kBoxPitch_y});
            ++index;
        }
    }

    void draw_box(const SheetEntry& entry, Point corner) {
        const Sheet& sheet = entry.sheet;
        const double per_mm = kBox / std::max(sheet.width_mm, sheet.height_mm);
        const double right = corner.x + per_mm * sheet.width_mm;
        const double below = corner.y + per_mm * sheet.height_mm;
        draw_outline(
            std::array<Point, 4>{{corner, {right, corner.y}, {right, below}, {corner.x, below}}});
        const double letters = static_cast<double>(std::max<std::size_t>(entry.name.size(), 8));
        svg_.text({corner.x, below + 26}, std::min(20.0, 1.7 * kBox / letters), entry.name,
                  R"(fill="#17202a")");
        svg_.text({corner.x, below + 48}, 15,
                  fmt::format("{:g} x {:g} mm", sheet.width_mm, sheet.height_mm),
                  R"(fill="#6b7885")");
    }

    std::span<const SheetEntry> sheets_;
    std::size_t placed_;
    Bounds bounds_;
    double per_m_;
    Svg svg_;
};

}  // namespace

void draw_sheets(const std::filesystem::path& path, std::span<const SheetEntry> sheets) {
    const std::string picture = SheetMap(sheets).draw();
    write_file(path, [&picture](std::ostream& stream) { stream << picture; });
}

}  // namespace dotpose
