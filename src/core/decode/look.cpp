#include "core/decode/look.hpp"

#include <array>
#include <optional>

#include "core/decode/likelihood.hpp"
#include "core/plane.hpp"

namespace dotpose::core {
namespace {

constexpr std::int32_t kNominal_q16 = 65536 / 6;
/// Pixels that a look at one place takes in, per axis.
constexpr int kTaps = 6;
constexpr std::size_t kMedianSample = 256;

/// A pixel, limited to the range of its eight neighbours. It has them: looks keep off the border.
int without_impulse(const ImageView& image, int u, int v) {
    int low = 255;
    int high = 0;
    for (int dv = -1; dv <= 1; ++dv) {
        const std::uint8_t* row = image.row(v + dv) + u;
        for (int du = -1; du <= 1; ++du) {
            if (du == 0 && dv == 0) continue;
            low = std::min(low, int{row[du]});
            high = std::max(high, int{row[du]});
        }
    }
    return std::clamp(int{image.row(v)[u]}, low, high);
}

/// The binomial (1 4 6 4 1) moved by a fraction of a pixel, in 1/4096.
std::array<int, kTaps> taps(std::int32_t position_q8) {
    constexpr std::array<int, kTaps + 1> kBinomial{0, 1, 4, 6, 4, 1, 0};
    const int fraction = position_q8 & 255;
    std::array<int, kTaps> weights;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        weights[i] = kBinomial[i + 1] * (256 - fraction) + kBinomial[i] * fraction;
    }
    return weights;
}

/// Weighted mean around a point, in 1/16 grey level; nothing near the border.
std::optional<int> level_q4(const ImageView& image, Vec point_q8) {
    const int u0 = (point_q8.x >> 8) - 2;
    const int v0 = (point_q8.y >> 8) - 2;
    if (u0 < 1 || v0 < 1 || u0 + kTaps >= image.width_px || v0 + kTaps >= image.height_px)
        return {};
    const auto across = taps(point_q8.x);
    const auto down = taps(point_q8.y);
    int sum_q12 = 0;
    for (int v = 0; v < kTaps; ++v) {
        int row_sum_q12 = 0;
        for (int u = 0; u < kTaps; ++u) {
            row_sum_q12 +=
                across[static_cast<std::size_t>(u)] * without_impulse(image, u0 + u, v0 + v);
        }
        sum_q12 += down[static_cast<std::size_t>(v)] * (row_sum_q12 >> 8);
    }
    return sum_q12 >> 8;
}

/// What a look at one cell shows, relative to its brightest place.
struct CellView {
    std::array<int, 4> darkness_q8;  ///< of the four places, by Symbol
    int darkest_around_q8 = 0;       ///< of places twice as far out
};

std::optional<CellView> look_at(const ImageView& image, const PlaneFromImage& plane, Vec cell) {
    std::array<int, 8> levels;
    int paper = 1;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const auto symbol = static_cast<Symbol>(i % 4);
        const std::int32_t way_q16 = i < 4 ? kNominal_q16 : 2 * kNominal_q16;
        const Vec place{cell.x * 65536 + dx(symbol) * way_q16,
                        cell.y * 65536 + dy(symbol) * way_q16};
        const std::optional<int> level = level_q4(image, image_point_q8(plane, place));
        if (!level && i < 4) return {};
        levels[i] = level.value_or(paper);
        paper = std::max(paper, levels[i]);
    }
    CellView view;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const int darkness = (paper - levels[i]) * 256 / paper;
        if (i < 4) {
            view.darkness_q8[i] = darkness;
        } else {
            view.darkest_around_q8 = std::max(view.darkest_around_q8, darkness);
        }
    }
    return view;
}

template <typename Use>
void visit(const ImageView& image, const PlaneFromImage& plane, Grid& grid, Use use) {
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            if (const auto view = look_at(image, plane, {i, j})) use(grid.at(i, j), *view);
        }
    }
}

/// Contrast of a typical dot: the median over the cells of their darkest place.
int typical_contrast_q8(const ImageView& image, const PlaneFromImage& plane, Grid& grid) {
    std::array<std::int32_t, kMedianSample> values;
    std::size_t count = 0;
    int seen = 0;
    const int every = grid.columns * grid.rows / static_cast<int>(kMedianSample) + 1;
    visit(image, plane, grid, [&](const GridCell&, const CellView& view) {
        if (seen++ % every != 0) return;
        values[count++] = *std::max_element(view.darkness_q8.begin(), view.darkness_q8.end());
    });
    return std::max(median(std::span(values).first(count)), 1);
}

/// The cells between the outermost points of the image's border.
void cover_image(const ImageView& image, const PlaneFromImage& plane, Grid& grid) {
    Vec least{INT32_MAX, INT32_MAX};
    Vec most{INT32_MIN, INT32_MIN};
    constexpr int kPerSide = 4;
    for (int n = 0; n <= kPerSide; ++n) {
        for (int m = 0; m <= kPerSide; ++m) {
            const Vec point_q8{image.width_px * 256 / kPerSide * n,
                               image.height_px * 256 / kPerSide * m};
            const Vec cell = grid_point(plane, point_q8).cell;
            least = {std::min(least.x, cell.x), std::min(least.y, cell.y)};
            most = {std::max(most.x, cell.x), std::max(most.y, cell.y)};
        }
    }
    lay_out(least, most, grid);
}

}  // namespace

void look_at_cells(const ImageView& image, const PlaneFromImage& plane, Grid& grid) {
    cover_image(image, plane, grid);
    const int contrast = typical_contrast_q8(image, plane, grid);
    visit(image, plane, grid, [&](GridCell& cell, const CellView& view) {
        const auto [up, left, right, down] = view.darkness_q8;
        // Graphics are darker than dots, whose ink is spread by blur; a cell that they touch says
        // nothing.
        if (std::max({up, left, right, down, view.darkest_around_q8}) > 2 * contrast) {
            cell.dot = GridCell::kHidden;
            return;
        }
        const auto weight = [&](int one, int zero) {
            return static_cast<std::int8_t>(std::clamp((one - zero) * 127 / contrast, -127, 127));
        };
        cell.x = weight(std::max(left, down), std::max(up, right));
        cell.y = weight(std::max(right, down), std::max(up, left));
    });
}

}  // namespace dotpose::core
