#include "core/decode/sample_cells.hpp"

#include <array>
#include <utility>

#include "core/decode/likelihood.hpp"
#include "core/decode/nominal.hpp"
#include "core/decode/tuning.hpp"
#include "core/detect/level_at.hpp"
#include "core/detect/level_sums.hpp"
#include "core/detect/paper.hpp"
#include "core/detect/undistort.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::sample_cells;

FixedVec place_60th(Symbol symbol) {
    return {10 * dx(symbol), 10 * dy(symbol)};
}

/// Measurements at one of the four dot positions of a cell.
struct PlaceView {
    bool is_seen = false;
    int darkness_q8 = 0;  ///< darkness relative to the paper level, in units of 1/256
    /// Mean darkness of a square around the dot position, relative to the paper level, in units of
    /// 1/256. The square is 2/5 of a spacing wide.
    int shade_q8 = 0;
};

struct CellView {
    FixedVec centre_q8;               ///< image point of the intersection, in 2^-8 px
    FixedVec u_q8;                    ///< step to the next column, in 2^-8 px
    FixedVec v_q8;                    ///< step to the next row, in 2^-8 px
    int half_px = 0;                  ///< half-width of the `shade_q8` square, in px
    std::array<PlaceView, 4> places;  ///< indexed by Symbol

    CellView(const ImageView& image, FixedVec centre, FixedVec right, FixedVec below)
        : centre_q8(centre), u_q8(right - centre), v_q8(below - centre) {
        for (std::size_t i = 0; i < places.size(); ++i)
            places[i].is_seen = shows_level(image, at(place_60th(static_cast<Symbol>(i))));
    }

    int places_seen() const {
        return static_cast<int>(std::count_if(
            places.begin(), places.end(), [](const PlaceView& place) { return place.is_seen; }));
    }

    FixedVec at(FixedVec offset_60th) const {
        return centre_q8 + FixedVec{(u_q8.x * offset_60th.x + v_q8.x * offset_60th.y) / 60,
                                    (u_q8.y * offset_60th.x + v_q8.y * offset_60th.y) / 60};
    }
};

class CellSampler {
  public:
    CellSampler(const ImageView& image, const PaperMap& paper, const FixedLens& lens,
                const PlaneFromImage& plane)
        : image_(image), paper_(paper), lens_(lens), plane_(plane) {}

    /// Calls `use(cell, view)` for each cell that has at least one dot position in the image. The
    /// dot positions of `view` have not been sampled yet.
    template <typename Use>
    void visit(const Grid& grid, Use use) const;
    /// Sets `half_px`, and the darkness and shade of each dot position in the image.
    void sample(CellView& view) const;
    /// Returns the paper level at the cell divided by the paper level at the image centre, in units
    /// of 1/256.
    int light_q8(const CellView& view) const;
    /// Returns, for each dot position, the maximum shade of the eight squares around it. The centre
    /// of each square is about 2/15 of a spacing from the dot position. The result is 0 for dot
    /// positions outside the image.
    std::array<int, 4> darkest_around_q8(const CellView& view) const;

  private:
    FixedVec image_of(int i, int j) const {
        return distorted_point_q8(lens_, plane_, {i * 65536, j * 65536});
    }
    /// Returns the mean darkness of a square, relative to the paper level, in units of 1/256.
    /// Subsamples large squares.
    int shade_q8(FixedVec centre_q8, int half_px) const;
    /// Returns the mean darkness of a square relative to the paper level, in units of 1/256. `sum`
    /// is the sum of the grey levels of `pixels` pixels. Returns 0 if `pixels` is 0.
    int darkness_q8(FixedVec centre_q8, int sum, int pixels) const;
    template <typename Shade>
    static std::array<int, 4> darkest_around_q8(const CellView& view, Shade shade_q8);

    const ImageView& image_;
    const PaperMap& paper_;
    const FixedLens& lens_;
    const PlaneFromImage& plane_;
};

/// Returns the sampling step within a square, in px. Large squares are subsampled to save time.
int step_px(int half_px) {
    return std::max(half_px / 3, 1);
}

int CellSampler::darkness_q8(FixedVec point_q8, int sum, int pixels) const {
    if (pixels == 0) return 0;
    const int paper = paper_at(paper_, (point_q8.x + 128) >> 8, (point_q8.y + 128) >> 8);
    return (paper * pixels - sum) * 256 / (paper * pixels);
}

int CellSampler::shade_q8(FixedVec centre_q8, int half_px) const {
    const PixelBox box(image_, centre_q8, half_px);
    const int step = step_px(half_px);
    int sum = 0;
    int count = 0;
    for (int v = box.top; v <= box.bottom; v += step) {
        const std::uint8_t* row = image_.row(v);
        for (int u = box.left; u <= box.right; u += step) {
            sum += row[u];
            ++count;
        }
    }
    return darkness_q8(centre_q8, sum, count);
}

template <typename Use>
void CellSampler::visit(const Grid& grid, Use use) const {
    // Adjacent rows of cells share a row of intersections, which is computed only once.
    std::array<FixedVec, kMaxGridSide + 1> here;
    std::array<FixedVec, kMaxGridSide + 1> below;
    const auto find_row = [&](int j, std::array<FixedVec, kMaxGridSide + 1>& row) {
        for (int i = 0; i <= grid.columns; ++i)
            row[static_cast<std::size_t>(i)] = image_of(grid.i0 + i, j);
    };
    find_row(grid.j0, below);
    for (int j = grid.j0; j < grid.j0 + grid.rows; ++j) {
        std::swap(here, below);
        find_row(j + 1, below);
        for (int i = 0; i < grid.columns; ++i) {
            const auto at = static_cast<std::size_t>(i);
            CellView view(image_, here[at], here[at + 1], below[at]);
            if (view.places_seen() > 0) use(FixedVec{grid.i0 + i, j}, view);
        }
    }
}

void CellSampler::sample(CellView& view) const {
    const auto spacing_q8 =
        static_cast<std::int32_t>(square_root(static_cast<std::uint64_t>(squared(view.u_q8))));
    view.half_px = std::max<std::int32_t>((spacing_q8 / tuned::kShadePart + 128) >> 8, 1);
    for (std::size_t i = 0; i < view.places.size(); ++i) {
        PlaceView& place = view.places[i];
        if (!place.is_seen) continue;
        const FixedVec place_q8 = view.at(place_60th(static_cast<Symbol>(i)));
        const int paper = paper_at(paper_, place_q8.x >> 8, place_q8.y >> 8);
        place.darkness_q8 = (paper * 256 - level_at_q8(image_, place_q8)) / paper;
        place.shade_q8 = shade_q8(place_q8, view.half_px);
    }
}

template <typename Shade>
std::array<int, 4> CellSampler::darkest_around_q8(const CellView& view, Shade shade_q8) {
    constexpr int kFar = tuned::kBeside_60th;
    constexpr int kDiagonal = tuned::kBesideDiagonally_60th;
    std::array<int, 4> darkest{};
    for (std::size_t i = 0; i < darkest.size(); ++i) {
        if (!view.places[i].is_seen) continue;
        const FixedVec place = place_60th(static_cast<Symbol>(i));
        for (const FixedVec d :
             {FixedVec{kFar, 0}, FixedVec{-kFar, 0}, FixedVec{0, kFar}, FixedVec{0, -kFar},
              FixedVec{kDiagonal, kDiagonal}, FixedVec{-kDiagonal, kDiagonal},
              FixedVec{kDiagonal, -kDiagonal}, FixedVec{-kDiagonal, -kDiagonal}}) {
            darkest[i] = std::max(darkest[i], shade_q8(view.at(place + d)));
        }
    }
    return darkest;
}

std::array<int, 4> CellSampler::darkest_around_q8(const CellView& view) const {
    // Maximum distance along an image axis from the intersection to a pixel of any square. The
    // offsets of a square's centre along the two grid axes add up to at most a third of a spacing.
    // Along an image axis, the offset of the centre is therefore at most a third of the largest
    // component of `u_q8` and `v_q8`.
    const int reach_px =
        std::max(larger_component(view.u_q8), larger_component(view.v_q8)) / (3 * 256) + 1 +
        view.half_px;
    if (step_px(view.half_px) > 1 || 2 * reach_px >= LevelSums::kMaxSide_px) {
        return darkest_around_q8(
            view, [&](FixedVec point_q8) { return shade_q8(point_q8, view.half_px); });
    }
    const LevelSums sums(image_, PixelBox(image_, view.centre_q8, reach_px));
    return darkest_around_q8(view, [&](FixedVec point_q8) {
        const PixelBox box(image_, point_q8, view.half_px);
        const int pixels = box.pixels();
        return darkness_q8(point_q8, pixels > 0 ? sums.of(box) : 0, pixels);
    });
}

int CellSampler::light_q8(const CellView& view) const {
    const int here = paper_at(paper_, view.centre_q8.x >> 8, view.centre_q8.y >> 8);
    return here * 256 / paper_at(paper_, image_.width_px / 2, image_.height_px / 2);
}

/// Returns the median darkness and the median shade of a dot, each at least 1. Samples up to
/// kMedianSample cells that are completely in the image, and uses the darkest dot position of each
/// cell.
PlaceView typical_place(const CellSampler& sampler, const Grid& grid) {
    std::array<std::int32_t, tuned::kMedianSample> darkness;
    std::array<std::int32_t, tuned::kMedianSample> shade;
    std::size_t count = 0;
    int seen = 0;
    const int every = grid.columns * grid.rows / static_cast<int>(tuned::kMedianSample) + 1;
    sampler.visit(grid, [&](FixedVec, CellView& view) {
        if (view.places_seen() < 4) return;
        if (seen++ % every != 0) return;
        sampler.sample(view);
        const PlaceView& darkest = *std::max_element(
            view.places.begin(), view.places.end(),
            [](const PlaceView& a, const PlaceView& b) { return a.darkness_q8 < b.darkness_q8; });
        darkness[count] = darkest.darkness_q8;
        shade[count++] = darkest.shade_q8;
    });
    return {true, std::max<std::int32_t>(median(std::span(darkness).first(count)), 1),
            std::max<std::int32_t>(median(std::span(shade).first(count)), 1)};
}

/// Converts the darkness at the four dot positions of a cell to bit weights.
class Ink {
  public:
    Ink(const CellSampler& sampler, const Grid& grid) : sampler_(sampler) {
        const PlaceView typical = typical_place(sampler, grid);
        contrast_q8_ = typical.darkness_q8;
        // A dot position is considered to be under graphics if its shade, or the shade beside it,
        // exceeds this value. The value is the geometric mean of the shades of a typical dot and of
        // solid ink.
        graphics_q8_ = static_cast<int>(
            square_root(static_cast<std::uint64_t>(typical.shade_q8 * tuned::kSolidInk_q8)));
    }

    /// Darkness at the four dot positions of a cell. `reliability_q4` is a factor applied to the
    /// cell's bit weights, in units of 1/16. `light_q8` is the result of `CellSampler::light_q8`,
    /// but at most kMaxLight_q8.
    struct Sample {
        std::array<int, 4> darkness_q8;  ///< indexed by Symbol
        int reliability_q4 = 16;
        int light_q8 = 256;
    };
    /// Returns the sample of a cell. If graphics cover some of its dot positions, records the
    /// covered positions in `cell`.
    Sample sample(const CellView& view, GridCell& cell) const {
        Sample sample;
        unsigned hidden = 0;
        int darkest_q8 = 0;
        int beside_q8 = 0;
        const std::array<int, 4> darkest_around_q8 = sampler_.darkest_around_q8(view);
        for (std::size_t i = 0; i < view.places.size(); ++i) {
            const PlaceView& place = view.places[i];
            // A dot position outside the image or under graphics gets half the darkness of a
            // typical dot, which favours neither bit value.
            sample.darkness_q8[i] = contrast_q8_ / 2;
            if (!place.is_seen) continue;
            const int around_q8 = darkest_around_q8[i];
            if (std::max(place.shade_q8, around_q8) > graphics_q8_) {
                hidden |= 1U << i;
                continue;
            }
            sample.darkness_q8[i] = place.darkness_q8;
            darkest_q8 = std::max(darkest_q8, place.darkness_q8);
            beside_q8 = std::max(beside_q8, around_q8);
        }
        if (hidden != 0) cell.dot = static_cast<std::uint16_t>(GridCell::kHidden + hidden);
        sample.light_q8 = std::min(sampler_.light_q8(view), tuned::kMaxLight_q8);
        sample.reliability_q4 =
            tuned::kReliabilityBySeen_q4[static_cast<std::size_t>(view.places_seen())];
        const auto limit = [&](bool applies, int reliability_q4) {
            if (applies) sample.reliability_q4 = std::min(sample.reliability_q4, reliability_q4);
        };
        limit(hidden != 0, tuned::kReliabilityCovered_q4);
        limit(5 * beside_q8 > tuned::kNearGraphics_5ths * graphics_q8_,
              tuned::kReliabilityNearGraphics_q4);
        limit(10 * darkest_q8 > tuned::kDark_10ths * contrast_q8_, tuned::kReliabilityDark_q4);
        limit(10 * darkest_q8 > tuned::kTooDark_10ths * contrast_q8_,
              tuned::kReliabilityTooDark_q4);
        return sample;
    }

    /// Returns true if the cell seems to contain two dots.
    bool is_crowded(const Sample& sample) const {
        std::array<int, 4> sorted = sample.darkness_q8;
        std::sort(sorted.begin(), sorted.end());
        return 3 * sorted[2] > tuned::kSecondDot_3rds * contrast_q8_ &&
               4 * sorted[2] > tuned::kSecondDot_4ths * sorted[3];
    }

    /// Returns the weight of a bit, in [-127, 127]. The bit is 1 at two of the four dot positions,
    /// and 0 at the other two. `one_q8` is the greater darkness at the two positions for 1, and
    /// `zero_q8` is the greater darkness at the two positions for 0.
    std::int8_t weight(const Sample& sample, int one_q8, int zero_q8) const {
        // The weight is proportional to the log-likelihood ratio of the bit. With constant sensor
        // noise, this ratio is proportional to the level difference times the contrast. Both
        // factors are proportional to the paper level at the cell, so the weight is proportional to
        // the square of the paper level.
        const int difference = (one_q8 - zero_q8) * tuned::kGain / contrast_q8_;
        const int light_q16 = sample.light_q8 * sample.light_q8;
        // The weight is clamped, because errors in high-contrast bits are rarely caused by noise.
        // Even more contrast does not make such bits more reliable.
        const int weight = static_cast<int>(
            std::clamp<std::int64_t>(std::int64_t{difference} * light_q16 >> 16, -127, 127));
        return static_cast<std::int8_t>(weight * sample.reliability_q4 / 16);
    }

  private:
    const CellSampler& sampler_;
    int contrast_q8_ = 1;  ///< darkness of a typical dot relative to paper, in units of 1/256
    /// Shade above which graphics are assumed to cover a dot position, in units of 1/256.
    int graphics_q8_ = 0;
};

/// Clears the grid and extends it over the whole image. The extent is computed from the cells at an
/// evenly spaced array of 5 x 5 points, which includes the image corners.
void cover_image(const ImageView& image, const FixedLens& lens, const PlaneFromImage& plane,
                 Grid& grid) {
    FixedVec min{INT32_MAX, INT32_MAX};
    FixedVec max{INT32_MIN, INT32_MIN};
    constexpr int kPerSide = 4;
    for (int n = 0; n <= kPerSide; ++n) {
        for (int m = 0; m <= kPerSide; ++m) {
            const FixedVec point_q8{image.width_px * 256 / kPerSide * n,
                                    image.height_px * 256 / kPerSide * m};
            const FixedVec cell =
                grid_point(plane, undistorted(lens, plane.centre_q8, point_q8)).cell;
            min = {std::min(min.x, cell.x), std::min(min.y, cell.y)};
            max = {std::max(max.x, cell.x), std::max(max.y, cell.y)};
        }
    }
    lay_out(min, max, grid);
}

std::int8_t x_weight(const Ink& ink, const Ink::Sample& sample) {
    const auto [up, left, right, down] = sample.darkness_q8;
    return ink.weight(sample, std::max(left, down), std::max(up, right));
}

std::int8_t y_weight(const Ink& ink, const Ink::Sample& sample) {
    const auto [up, left, right, down] = sample.darkness_q8;
    return ink.weight(sample, std::max(right, down), std::max(up, left));
}

}  // namespace

bool sample_cells(const ImageView& image, const PaperMap& paper, const FixedLens& lens,
                  const PlaneFromImage& plane, Grid& grid) {
    cover_image(image, lens, plane, grid);
    const CellSampler sampler(image, paper, lens, plane);
    const Ink ink(sampler, grid);
    int cells = 0;
    int crowded = 0;
    sampler.visit(grid, [&](FixedVec at, CellView& view) {
        GridCell& cell = grid.at(at.x, at.y);
        sampler.sample(view);
        const Ink::Sample sample = ink.sample(view, cell);
        cell.x = x_weight(ink, sample);
        cell.y = y_weight(ink, sample);
        if (view.places_seen() < 4 || cell.is_hidden()) return;
        ++cells;
        crowded += ink.is_crowded(sample);
    });
    return 8 * crowded <= tuned::kMaxCrowded_8ths * cells;
}

}  // namespace dotpose::core
