#include "core/detect/light.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/detect/inverses.hpp"
#include "core/detect/tiles.hpp"
#include "core/detect/words.hpp"

namespace dotpose::core {
namespace {

constexpr int kBandsKept = 4;  // three are needed; a power of two is quicker
constexpr unsigned kContrastBins = 64;

std::span<Tile> tiles_of(const Light& light, int band) {
    const auto n = static_cast<std::size_t>(light.tiles_per_band);
    return light.tiles.subspan(static_cast<std::size_t>(band & (kBandsKept - 1)) * n, n);
}

/// Copies as many blocks as fit, and moves both pointers on.
template <std::size_t kBlock>
void copy_blocks(const std::uint8_t*& from, const std::uint8_t* end, std::uint8_t*& to) {
    for (; end - from >= static_cast<std::ptrdiff_t>(kBlock); from += kBlock, to += kBlock)
        std::memcpy(__builtin_assume_aligned(to, 4), __builtin_assume_aligned(from, 4), kBlock);
}

/// Keeps a row, and fills its last tile with the last pixel.
void keep_row(const std::uint8_t* pixels, const Light& light, std::uint8_t* row) {
    const std::uint8_t* const end = pixels + light.width_px;
    std::uint8_t* const whole = row + whole_width(light);
    if (reinterpret_cast<std::uintptr_t>(pixels) % 4 == 0) {
        // The libraries of small devices copy byte by byte, which is slower.
        copy_blocks<28>(pixels, end, row);
        copy_blocks<12>(pixels, end, row);
        copy_blocks<4>(pixels, end, row);
    }
    while (pixels != end)
        *row++ = *pixels++;
    const std::uint8_t last = end[-1];
    while (reinterpret_cast<std::uintptr_t>(row) % sizeof(Word) != 0)
        *row++ = last;
    const Word words = in_all_bytes(last);
    for (; row != whole; row += sizeof words)
        std::memcpy(__builtin_assume_aligned(row, sizeof words), &words, sizeof words);
}

/// The tiles of a band and of those above and below; at the image's border, the band itself
/// instead.
struct ThreeBands {
    const Tile* above;
    const Tile* here;
    const Tile* below;
};

ThreeBands three_bands(const Light& light, int band) {
    const Tile* here = tiles_of(light, band).data();
    return {band > 0 ? tiles_of(light, band - 1).data() : here, here,
            band + 1 < band_count(light) ? tiles_of(light, band + 1).data() : here};
}

/// Computes the brightest mean and greatest darkness of each tile and those above and below it.
void join_bands(ThreeBands bands, std::size_t count, std::uint8_t* means,
                std::uint8_t* darknesses) {
    for (std::size_t t = 0; t < count; ++t) {
        const int mean = std::max<int>(bands.above[t].mean, bands.here[t].mean);
        const int darkness = std::max<int>(bands.above[t].darkness, bands.here[t].darkness);
        means[t] = static_cast<std::uint8_t>(std::max<int>(mean, bands.below[t].mean));
        darknesses[t] = static_cast<std::uint8_t>(std::max<int>(darkness, bands.below[t].darkness));
    }
}

/// Replaces each number by the greatest of it and its two neighbours.
void join_neighbours(std::uint8_t* number, std::size_t count) {
    std::uint8_t* const last = number + count - 1;
    int here = *number;
    int of_two = here;
    for (; number != last; ++number) {
        const int next = number[1];
        *number = static_cast<std::uint8_t>(std::max(of_two, next));
        of_two = std::max(here, next);
        here = next;
    }
    *last = static_cast<std::uint8_t>(of_two);
}

/// Sets the columns of a tile to a level; returns the columns of the next tile.
inline std::uint8_t* fill(std::uint8_t* column, unsigned level) {
    const Word word = in_all_bytes(1) * level;
    for (std::size_t k = 0; k < kTileWidth_px; k += sizeof word)
        std::memcpy(__builtin_assume_aligned(column + k, sizeof word), &word, sizeof word);
    return column + kTileWidth_px;
}

/// Number of tiles by their contrast relative to their paper, in steps of 1/kContrastBins.
using Histogram = std::array<std::uint16_t, kContrastBins>;

/// Adds each tile with contrast to the histogram, and sets the mean of the others to 0. Returns how
/// many have contrast.
int take_contrasts(std::uint8_t* means, const std::uint8_t* darknesses, std::size_t tiles,
                   int min_contrast, int& greatest_contrast, Histogram& histogram) {
    int blank = 0;
    int greatest = greatest_contrast;
    for (std::size_t t = 0; t < tiles; ++t) {
        const int mean = means[t];
        const int contrast = mean + darknesses[t] - 255;
        greatest = std::max(greatest, contrast);
        if (contrast >= min_contrast) {
            static_assert(kContrastBins == 64);
            const std::uint32_t bins_q16 =
                tabled<inverse_q22, 256>(static_cast<std::uint32_t>(mean));
            ++histogram[(static_cast<std::uint32_t>(contrast) * bins_q16) >> 16];
        } else {
            means[t] = 0;
            ++blank;
        }
    }
    greatest_contrast = greatest;
    return static_cast<int>(tiles) - blank;
}

/// Returns the contrast of dots relative to paper in a band, in 1/256; 0 if there is none.
/// Ink reflects the same share of the light everywhere, so the relative contrast of the dots is the
/// same for all tiles. Strokes of graphics raise that of the tiles around them: the lower third
/// over a band is that of dots even where strokes cross it.
unsigned typical_depth_q8(std::uint8_t* means, const std::uint8_t* darknesses, std::size_t tiles,
                          int min_contrast, int& greatest_contrast) {
    Histogram histogram{};
    const int count =
        take_contrasts(means, darknesses, tiles, min_contrast, greatest_contrast, histogram);
    if (count == 0) return 0;
    unsigned bin = 0;
    for (int below = 0; bin < kContrastBins - 1; ++bin) {
        below += histogram[bin];
        if (10 * below > 3 * count) break;
    }
    return (2 * bin + 1) * (256 / (2 * kContrastBins));
}

/// Sets the levels of all columns from depths relative to paper, in 2^-16.
void set_levels(const std::uint8_t* papers, std::size_t tiles, unsigned to_low_q16,
                unsigned to_high_q16, Light& light) {
    std::uint8_t* half_low_levels = light.half_low_levels.data();
    std::uint8_t* high_levels = light.high_levels.data();
    for (const std::uint8_t* const end = papers + tiles; papers != end; ++papers) {
        const unsigned paper = *papers;
        // The low threshold is even, so that runs may compare seven bits.
        const unsigned half_low = (paper - (paper * to_low_q16 >> 16)) >> 1;
        const unsigned high = std::min(paper - (paper * to_high_q16 >> 16), 2 * half_low);
        half_low_levels = fill(half_low_levels, half_low);
        high_levels = fill(high_levels, high);
    }
}

}  // namespace

int least_contrast(const ThresholdOptions& options, const Light& light) {
    // A larger share would leave more noise out, but also pale dots in uneven light.
    constexpr int kShare = 6;
    return std::clamp(light.greatest_contrast / kShare, options.min_contrast,
                      2 * options.min_contrast);
}

void begin_light(int width_px, int height_px, Light& light) {
    light.width_px = width_px;
    light.height_px = height_px;
    light.band_px =
        std::min(width_px, height_px) <= kLargestWithLowTiles_px ? kLowTile_px : kHighTile_px;
    light.band_shift = std::countr_zero(static_cast<unsigned>(light.band_px));
    light.tiles_per_band = (width_px + kTileWidth_px - 1) / kTileWidth_px;
    light.rows_taken = 0;
    light.has_contrast = false;
    light.greatest_contrast = 0;
    std::fill_n(light.half_low_levels.begin() + whole_width(light), kReadAhead_px, kAlwaysDark);
}

int take_row(const std::uint8_t* pixels, Light& light) {
    const int v = light.rows_taken++;
    keep_row(pixels, light, kept_row(light, v));
    const bool is_last = v + 1 == light.height_px;
    const bool ends_band = ((v + 1) & (light.band_px - 1)) == 0;
    if (!ends_band && !is_last) return 0;
    const int band = v >> light.band_shift;
    measure_tiles(band, light, tiles_of(light, band));
    return (band > 0 ? 1 : 0) + (is_last ? 1 : 0);
}

void measure_levels(int band, const ThresholdOptions& options, Light& light) {
    const auto tiles = static_cast<std::size_t>(light.tiles_per_band);
    // Until the levels of all columns are set, their memory holds values per tile: of paper at its
    // end, which is overwritten last.
    std::uint8_t* const papers = light.half_low_levels.data() + whole_width(light) - tiles;
    std::uint8_t* const darknesses = light.high_levels.data();
    join_bands(three_bands(light, band), tiles, papers, darknesses);
    // Ink is searched in the tiles to both sides, too, because dots may be farther apart than a
    // tile is wide. Paper is not, because each tile shows some, and the brightest of several is too
    // bright.
    join_neighbours(darknesses, tiles);
    // If less than half of a tile is image, it shows little but the repeated last pixel of the row.
    if (whole_width(light) - light.width_px > kTileWidth_px / 2)
        papers[tiles - 1] = std::max(papers[tiles - 2], papers[tiles - 1]);
    const unsigned depth_q8 = typical_depth_q8(
        papers, darknesses, tiles, least_contrast(options, light), light.greatest_contrast);
    if (depth_q8 > 0) light.has_contrast = true;
    set_levels(papers, tiles, depth_q8 * static_cast<unsigned>(options.low_q8),
               depth_q8 * static_cast<unsigned>(options.high_q8), light);
}

}  // namespace dotpose::core
