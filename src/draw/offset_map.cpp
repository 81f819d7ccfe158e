// Draws the offsets of a print map as two images, one for each component.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <vector>

#include "dotpose/files/print_map.hpp"
#include "dotpose/tools/draw.hpp"
#include "draw/svg.hpp"

namespace dotpose {
namespace {

using namespace dotpose::draw;

constexpr double kOffsetMargin = 40;
constexpr double kOffsetHead = 110;
constexpr double kOffsetSide = 620;  ///< longer side of a panel
constexpr double kOffsetGap = 60;
constexpr int kMaxBlocks = 60;  ///< maximum number of blocks along the longer side of the page

/// Sums of the x and y offsets of the dots in a block, and the number of dots.
struct OffsetBlock {
    std::array<double, 2> sum_mm{};
    int dots = 0;
};

class OffsetMap {
  public:
    explicit OffsetMap(const MapPage& page)
        : page_(page),
          side_((std::max(page.columns, page.rows) + kMaxBlocks - 1) / kMaxBlocks),
          columns_((page.columns + side_ - 1) / side_),
          rows_((page.rows + side_ - 1) / side_),
          blocks_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)),
          scale_(kOffsetSide / (side_ * std::max(columns_, rows_))),
          svg_(2 * (kOffsetMargin + side_ * columns_ * scale_) + kOffsetGap,
               kOffsetHead + side_ * rows_ * scale_ + 2 * kOffsetMargin, "Map of a print") {
        add_dots();
    }

    std::string draw() && {
        svg_.text({kOffsetMargin, kOffsetMargin + 24}, 26, "Offsets of the dots of " + page_.name,
                  R"(font-weight="bold" fill="#17202a")");
        svg_.text({kOffsetMargin, kOffsetMargin + 52}, 17,
                  fmt::format("mean of {} x {} dots, blue {:.0f} µm to red +{:.0f} µm; jitter of a "
                              "dot {:.1f} µm; {} frames",
                              side_, side_, -1000 * full_mm_, 1000 * full_mm_,
                              1000 * page_.jitter * page_.spacing_mm, page_.frames),
                  R"(fill="#6b7885")");
        for (const std::size_t axis : {std::size_t{0}, std::size_t{1}})
            draw_panel(axis);
        return std::move(svg_).finish();
    }

  private:
    void add_dots() {
        for (int j = 0; j < page_.rows; ++j) {
            for (int i = 0; i < page_.columns; ++i) {
                const auto dot =
                    static_cast<std::size_t>(j) * static_cast<std::size_t>(page_.columns) +
                    static_cast<std::size_t>(i);
                if (page_.views[dot] == 0) continue;
                OffsetBlock& block = at(i / side_, j / side_);
                block.sum_mm[0] += page_.offsets[dot].x() * page_.spacing_mm;
                block.sum_mm[1] += page_.offsets[dot].y() * page_.spacing_mm;
                ++block.dots;
            }
        }
        constexpr double kMinFull_mm = 0.005;
        full_mm_ = kMinFull_mm;
        for (const OffsetBlock& block : blocks_) {
            if (block.dots == 0) continue;
            for (const double sum : block.sum_mm)
                full_mm_ = std::max(full_mm_, std::abs(sum / block.dots));
        }
    }

    OffsetBlock& at(int i, int j) {
        return blocks_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(i)];
    }

    void draw_panel(std::size_t axis) {
        const double width = side_ * columns_ * scale_;
        const Point corner{kOffsetMargin + (axis == 0 ? 0 : width + kOffsetGap),
                           kOffsetMargin + kOffsetHead};
        svg_.text({corner.x, corner.y - 14}, 19, axis == 0 ? "along x" : "along y (down)",
                  R"(fill="#17202a")");
        const double step = side_ * scale_;
        for (int j = 0; j < rows_; ++j) {
            for (int i = 0; i < columns_; ++i) {
                const OffsetBlock& block = at(i, j);
                if (block.dots == 0) continue;
                // Adjacent blocks overlap slightly to hide the gaps that viewers would otherwise
                // show between them.
                svg_.add(
                    R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}"/>)",
                    corner.x + i * step, corner.y + j * step, step + 0.3, step + 0.3,
                    colour_of(block.sum_mm[axis] / block.dots / full_mm_));
            }
        }
        svg_.add(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="none" )"
                 R"(stroke="{}" stroke-width="1.5"/>)",
                 corner.x, corner.y, width, side_ * rows_ * scale_, colour::kQuiet);
    }

    /// Returns a colour from blue (-1) through white (0) to red (1).
    static std::string colour_of(double fraction) {
        const auto part = [](double value) { return static_cast<int>(std::lround(value)); };
        const double pale = 1 - std::min(std::abs(fraction), 1.0);
        const std::array<double, 3> full =
            fraction < 0 ? std::array<double, 3>{21, 101, 192} : std::array<double, 3>{192, 57, 43};
        return fmt::format("#{:02x}{:02x}{:02x}", part(full[0] + pale * (255 - full[0])),
                           part(full[1] + pale * (255 - full[1])),
                           part(full[2] + pale * (255 - full[2])));
    }

    const MapPage& page_;
    int side_;  ///< side of a block, in dots
    int columns_;
    int rows_;
    std::vector<OffsetBlock> blocks_;
    double scale_;
    double full_mm_ = 0;
    Svg svg_;
};

}  // namespace

void draw_print_map(const std::filesystem::path& path, const MapPage& page) {
    write_file(path, [&](std::ostream& out) { out << OffsetMap(page).draw(); });
}

}  // namespace dotpose
