#include "raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/core.h>

#include "geometry.hpp"
#include "symbol_rows.hpp"
#include "writers.hpp"

namespace dotpose {
namespace print {
namespace {

// Offset that is added before rounding to a pixel. Without it, floating-point errors would
// determine in which direction a centre halfway between two pixels is rounded.
constexpr double kTie_px = 1e-6;

int diameter_px(const Sheet& sheet, double dpi) {
    return std::max(1, static_cast<int>(std::lround(sheet.pattern.dot_mm * dpi / kInch_mm)));
}

/// Returns the first pixel that a dot covers along one axis. The dot has a diameter of `dot_px`
/// pixels. Its centre is as close to `centre_mm` as possible without moving a part of the dot off
/// the page. Pixel k extends from k to k + 1.
int first_px(double centre_mm, double dpi, int dot_px, int page_px) {
    const double first = centre_mm * dpi / kInch_mm - 0.5 * dot_px;
    return std::clamp(static_cast<int>(std::floor(first + 0.5 + kTie_px)), 0, page_px - dot_px);
}

/// First pixel of a dot along one axis, for each of the displacements -1, 0 and 1.
using Firsts = std::array<int, 3>;

/// Pixels `first` to `end` - 1 of one row of a dot, relative to the left edge of the dot.
struct Run {
    int first = 0;
    int end = 0;
};

/// Returns the rows of a disc: the pixels whose centres are in the circle inscribed in a square of
/// `dot_px` x `dot_px` pixels. Discs of 1, 2 and 3 px are full squares, and a disc of 4 px lacks
/// the four corners.
std::vector<Run> disc(int dot_px) {
    std::vector<Run> runs;
    const double radius = 0.5 * dot_px;
    for (int row = 0; row < dot_px; ++row) {
        const double v = row + 0.5 - radius;
        const double half_width = std::sqrt(radius * radius - v * v);
        const int first = static_cast<int>(std::ceil(radius - half_width - 0.5 - kTie_px));
        runs.push_back({first, dot_px - first});
    }
    return runs;
}

/// Pixel rows that a row of dots can cover.
class Band {
  public:
    Band(const Sheet& sheet, double dpi, RasterSize size)
        : dot_px_(diameter_px(sheet, dpi)),
          stride_bytes_((static_cast<std::size_t>(size.width_px) + 7) / 8),
          runs_(disc(dot_px_)) {
        for (int i = 0; i < sheet.columns; ++i) {
            Firsts& lefts = lefts_.emplace_back();
            for (const int shift : {-1, 0, 1}) {
                lefts[static_cast<std::size_t>(shift + 1)] =
                    first_px(dot_x_mm(sheet, i, shift), dpi, dot_px_, size.width_px);
            }
        }
    }

    void draw(const std::vector<Symbol>& symbols, const Firsts& tops) {
        height_px_ = tops[2] + dot_px_ - tops[0];
        bits_.assign(stride_bytes_ * static_cast<std::size_t>(height_px_), 0);
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            const int left = lefts_[i][static_cast<std::size_t>(dx(symbols[i]) + 1)];
            const int top = tops[static_cast<std::size_t>(dy(symbols[i]) + 1)] - tops[0];
            draw_dot(left, top);
        }
    }

    int height_px() const { return height_px_; }
    int dot_px() const { return dot_px_; }
    std::size_t stride_bytes() const { return stride_bytes_; }
    std::span<const std::uint8_t> row(int v) const {
        return std::span(bits_).subspan(static_cast<std::size_t>(v) * stride_bytes_, stride_bytes_);
    }

  private:
    void draw_dot(int left, int top) {
        std::uint8_t* row = bits_.data() + static_cast<std::size_t>(top) * stride_bytes_;
        for (const Run& run : runs_) {
            for (int u = left + run.first; u < left + run.end; ++u) {
                row[u / 8] = static_cast<std::uint8_t>(row[u / 8] | (0x80 >> (u % 8)));
            }
            row += stride_bytes_;
        }
    }

    int dot_px_;
    int height_px_ = 0;
    std::size_t stride_bytes_;
    std::vector<Run> runs_;
    std::vector<Firsts> lefts_;
    std::vector<std::uint8_t> bits_;
};

}  // namespace

RasterSize raster_size(const Sheet& sheet, double dpi) {
    return {static_cast<int>(std::lround(sheet.width_mm * dpi / kInch_mm)),
            static_cast<int>(std::lround(sheet.height_mm * dpi / kInch_mm))};
}

void rasterize(const Sheet& sheet, double dpi, const Progress& progress, const png::RowSink& sink) {
    const RasterSize size = raster_size(sheet, dpi);
    SymbolRows symbols(sheet);
    Band band(sheet, dpi, size);
    const std::vector<std::uint8_t> blank(band.stride_bytes(), 0);
    int next_row = 0;
    for (int j = 0; j < sheet.rows; ++j) {
        Firsts tops{};
        for (const int shift : {-1, 0, 1}) {
            tops[static_cast<std::size_t>(shift + 1)] =
                first_px(dot_y_mm(sheet, j, shift), dpi, band.dot_px(), size.height_px);
        }
        band.draw(symbols.row(j), tops);
        // Bands do not overlap, because `validate_resolution` requires a white pixel between
        // neighbouring dots.
        for (; next_row < tops[0]; ++next_row)
            sink(blank);
        for (int v = 0; v < band.height_px(); ++v, ++next_row)
            sink(band.row(v));
        report(progress, j + 1, sheet.rows);
    }
    for (; next_row < size.height_px; ++next_row)
        sink(blank);
}

}  // namespace print

void validate_resolution(const Sheet& sheet, double dpi) {
    if (!(dpi > 0 && dpi <= kMaxResolution_dpi)) {
        throw BadArgument(
            fmt::format("a resolution of {:g} dpi: it must be over 0 and at most {:.0f} "
                        "dpi",
                        dpi, kMaxResolution_dpi));
    }
    const double px_per_mm = dpi / print::kInch_mm;
    const double displacement_px = sheet.pattern.displacement_mm * px_per_mm;
    if (displacement_px < 1 - print::kTie_px) {
        throw BadArgument(fmt::format(
            "{:g} dpi is too low: the displacement of {:.4g} mm is {:.3g} printer pixels, and at "
            "least one is needed ({:.0f} dpi or more)",
            dpi, sheet.pattern.displacement_mm, displacement_px,
            std::ceil(print::kInch_mm / sheet.pattern.displacement_mm - print::kTie_px)));
    }
    // The position of each dot is rounded to whole pixels independently, so the gap between two
    // dots can be up to one pixel narrower.
    const int dot_px = print::diameter_px(sheet, dpi);
    const double closest_px = sheet.pattern.spacing_mm * px_per_mm - 2 * displacement_px;
    if (closest_px < dot_px + 1 - print::kTie_px) {
        throw BadArgument(fmt::format(
            "{:g} dpi is too low: neighbouring dots of {} printer pixels can come as close "
            "as {:.3g} pixels, centre to centre, and would touch",
            dpi, dot_px, closest_px));
    }
}

}  // namespace dotpose
