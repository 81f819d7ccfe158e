#include "core/decode/look.hpp"

#include <array>
#include <optional>

#include "core/decode/likelihood.hpp"
#include "core/pixels/paper.hpp"
#include "core/pixels/undistort.hpp"
#include "core/plane.hpp"

namespace dotpose::core {
namespace {

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

/// Weighted mean around a point, in 1/256 grey level; nothing near the border.
std::optional<int> level_q8(const ImageView& image, Vec point_q8) {
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

/// What shows at one of a cell's four places.
struct PlaceView {
    int darkness_q8 = 0;        ///< relative to the paper
    int shade_q8 = 0;           ///< mean darkness of a square of 2/5 spacing around
    int darkest_around_q8 = 0;  ///< shade of such squares 4/15 spacing away
};

/// What a look at one cell shows.
struct CellView {
    std::array<PlaceView, 4> places;  ///< by Symbol
};

/// Looks at an image through a grid laid over it.
class Eye {
  public:
    Eye(const ImageView& image, const PaperMap& paper, const Lens& lens,
        const PlaneFromImage& plane)
        : image_(image), paper_(paper), lens_(lens), plane_(plane) {}

    std::optional<CellView> look_at(Vec cell) const;

  private:
    /// Where the image shows a point of the plane, in spacings.
    Vec image_of(std::int32_t x_q16, std::int32_t y_q16) const {
        return distorted(lens_, plane_.centre_q8, image_point_q8(plane_, {x_q16, y_q16}));
    }
    /// Mean darkness of a square of 2/5 spacing.
    int shade_q8(Vec centre_q8, int half_px) const;

    const ImageView& image_;
    const PaperMap& paper_;
    const Lens& lens_;
    const PlaneFromImage& plane_;
};

int Eye::shade_q8(Vec centre_q8, int half_px) const {
    const int u0 = (centre_q8.x + 128) >> 8;
    const int v0 = (centre_q8.y + 128) >> 8;
    const int step = std::max(half_px / 3, 1);
    int sum = 0;
    int count = 0;
    for (int v = std::max(v0 - half_px, 0); v <= std::min(v0 + half_px, image_.height_px - 1);
         v += step) {
        const std::uint8_t* row = image_.row(v);
        for (int u = std::max(u0 - half_px, 0); u <= std::min(u0 + half_px, image_.width_px - 1);
             u += step) {
            sum += row[u];
            ++count;
        }
    }
    if (count == 0) return 0;
    const int paper = paper_at(paper_, std::clamp(u0, 0, image_.width_px - 1),
                               std::clamp(v0, 0, image_.height_px - 1));
    return (paper * count - sum) * 256 / (paper * count);
}

std::optional<CellView> Eye::look_at(Vec cell) const {
    const Vec centre_q8 = image_of(cell.x * 65536, cell.y * 65536);
    const Vec u_q8 = image_of(cell.x * 65536 + 65536, cell.y * 65536) - centre_q8;
    const Vec v_q8 = image_of(cell.x * 65536, cell.y * 65536 + 65536) - centre_q8;
    const auto at = [&](int x_60th, int y_60th) {
        return centre_q8 + Vec{(u_q8.x * x_60th + v_q8.x * y_60th) / 60,
                               (u_q8.y * x_60th + v_q8.y * y_60th) / 60};
    };
    const auto spacing_q8 =
        static_cast<std::int32_t>(square_root(static_cast<std::uint64_t>(squared(u_q8))));
    const int half_px = std::max((spacing_q8 / 5 + 128) >> 8, 1);
    CellView view;
    for (std::size_t i = 0; i < view.places.size(); ++i) {
        const auto symbol = static_cast<Symbol>(i);
        const int x = 10 * dx(symbol);
        const int y = 10 * dy(symbol);
        const Vec place_q8 = at(x, y);
        const std::optional<int> level = level_q8(image_, place_q8);
        if (!level) return {};
        const int paper = paper_at(paper_, place_q8.x >> 8, place_q8.y >> 8);
        PlaceView& place = view.places[i];
        place.darkness_q8 = (paper * 256 - *level) / paper;
        place.shade_q8 = shade_q8(place_q8, half_px);
        constexpr int kFar = 16;
        constexpr int kDiagonal = 11;
        for (const Vec d : {Vec{kFar, 0}, Vec{-kFar, 0}, Vec{0, kFar}, Vec{0, -kFar},
                            Vec{kDiagonal, kDiagonal}, Vec{-kDiagonal, kDiagonal},
                            Vec{kDiagonal, -kDiagonal}, Vec{-kDiagonal, -kDiagonal}}) {
            place.darkest_around_q8 =
                std::max(place.darkest_around_q8, shade_q8(at(x + d.x, y + d.y), half_px));
        }
    }
    return view;
}

template <typename Use>
void visit(const Eye& eye, Grid& grid, Use use) {
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        for (int i = grid.i0; i < grid.i0 + grid.columns; ++i) {
            if (const auto view = eye.look_at({i, j})) use(grid.at(i, j), *view);
        }
    }
}

/// What a cell's darkest place typically looks like: the medians over the cells.
PlaceView typical_place(const Eye& eye, Grid& grid) {
    std::array<std::int32_t, kMedianSample> darkness;
    std::array<std::int32_t, kMedianSample> shade;
    std::size_t count = 0;
    int seen = 0;
    const int every = grid.columns * grid.rows / static_cast<int>(kMedianSample) + 1;
    visit(eye, grid, [&](const GridCell&, const CellView& view) {
        if (seen++ % every != 0) return;
        const PlaceView& darkest = *std::max_element(
            view.places.begin(), view.places.end(),
            [](const PlaceView& a, const PlaceView& b) { return a.darkness_q8 < b.darkness_q8; });
        darkness[count] = darkest.darkness_q8;
        shade[count++] = darkest.shade_q8;
    });
    return {std::max(median(std::span(darkness).first(count)), 1),
            std::max(median(std::span(shade).first(count)), 1), 0};
}

/// The cells between the outermost points of the image's border.
void cover_image(const ImageView& image, const Lens& lens, const PlaneFromImage& plane,
                 Grid& grid) {
    Vec least{INT32_MAX, INT32_MAX};
    Vec most{INT32_MIN, INT32_MIN};
    constexpr int kPerSide = 4;
    for (int n = 0; n <= kPerSide; ++n) {
        for (int m = 0; m <= kPerSide; ++m) {
            const Vec point_q8{image.width_px * 256 / kPerSide * n,
                               image.height_px * 256 / kPerSide * m};
            const Vec cell = grid_point(plane, undistorted(lens, plane.centre_q8, point_q8)).cell;
            least = {std::min(least.x, cell.x), std::min(least.y, cell.y)};
            most = {std::max(most.x, cell.x), std::max(most.y, cell.y)};
        }
    }
    lay_out(least, most, grid);
}

}  // namespace

void look_at_cells(const ImageView& image, const PaperMap& paper, const Lens& lens,
                   const PlaneFromImage& plane, Grid& grid) {
    cover_image(image, lens, plane, grid);
    const Eye eye(image, paper, lens, plane);
    const PlaceView typical = typical_place(eye, grid);
    const int contrast = typical.darkness_q8;
    // Between the shade of a dot and that of solid ink.
    constexpr int kInk_q8 = 192;
    const auto graphics_q8 =
        static_cast<int>(square_root(static_cast<std::uint64_t>(typical.shade_q8 * kInk_q8)));
    visit(eye, grid, [&](GridCell& cell, const CellView& view) {
        std::array<int, 4> darkness;
        for (std::size_t i = 0; i < darkness.size(); ++i) {
            const PlaceView& place = view.places[i];
            const bool is_hidden = std::max(place.shade_q8, place.darkest_around_q8) > graphics_q8;
            if (is_hidden) cell.dot = GridCell::kHidden;
            // As likely as not there is a dot under graphics.
            darkness[i] = is_hidden ? contrast / 2 : place.darkness_q8;
        }
        const auto [up, left, right, down] = darkness;
        const auto weight = [&](int one, int zero) {
            // Beyond 7/10 of a dot's contrast a bit gets no surer: what is wrong there is no noise.
            return static_cast<std::int8_t>(std::clamp((one - zero) * 180 / contrast, -127, 127));
        };
        cell.x = weight(std::max(left, down), std::max(up, right));
        cell.y = weight(std::max(right, down), std::max(up, left));
    });
}

}  // namespace dotpose::core
