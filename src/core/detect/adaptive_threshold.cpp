#include "core/detect/adaptive_threshold.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/detect/inverses.hpp"
#include "core/detect/tiles.hpp"
#include "core/detect/words.hpp"

namespace dotpose::core {
namespace {

/// Half of 256, a threshold above all grey levels. It is stored after the last column as a
/// sentinel, so that the search for dark pixels always ends.
constexpr std::uint8_t kAlwaysDark = 128;

constexpr int kBandsKept = 4;  // three bands suffice, but indexing is faster with a power of two
constexpr unsigned kContrastBins = 64;

std::span<Tile> tiles_of(const AdaptiveThreshold& threshold, int band) {
    const auto n = static_cast<std::size_t>(threshold.tiles_per_band);
    return threshold.tiles.subspan(static_cast<std::size_t>(band & (kBandsKept - 1)) * n, n);
}

/// Copies whole blocks of kBlock bytes until fewer than kBlock bytes remain. Advances both pointers
/// past the copied bytes.
template <std::size_t kBlock>
void copy_blocks(const std::uint8_t*& from, const std::uint8_t* end, std::uint8_t*& to) {
    for (; end - from >= static_cast<std::ptrdiff_t>(kBlock); from += kBlock, to += kBlock)
        std::memcpy(__builtin_assume_aligned(to, 4), __builtin_assume_aligned(from, 4), kBlock);
}

/// Stores a row, and repeats its last pixel to fill the last tile.
void keep_row(const std::uint8_t* pixels, const AdaptiveThreshold& threshold, std::uint8_t* row) {
    const std::uint8_t* const end = pixels + threshold.width_px;
    std::uint8_t* const whole = row + whole_width(threshold);
    if (reinterpret_cast<std::uintptr_t>(pixels) % 4 == 0) {
        // Compilers inline copies of constant size. On small devices, the library's `memcpy` is
        // slower, because it copies byte by byte.
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

/// The tiles of three adjacent bands. At the image border, the middle band replaces the missing
/// band.
struct ThreeBands {
    const Tile* above;
    const Tile* here;
    const Tile* below;
};

ThreeBands three_bands(const AdaptiveThreshold& threshold, int band) {
    const Tile* here = tiles_of(threshold, band).data();
    return {band > 0 ? tiles_of(threshold, band - 1).data() : here, here,
            band + 1 < band_count(threshold) ? tiles_of(threshold, band + 1).data() : here};
}

/// For each column of tiles, stores the maximum mean and the maximum darkness over three bands.
void join_bands(ThreeBands bands, std::size_t count, std::uint8_t* means,
                std::uint8_t* darknesses) {
    for (std::size_t t = 0; t < count; ++t) {
        const int mean = std::max<int>(bands.above[t].mean, bands.here[t].mean);
        const int darkness = std::max<int>(bands.above[t].darkness, bands.here[t].darkness);
        means[t] = static_cast<std::uint8_t>(std::max<int>(mean, bands.below[t].mean));
        darknesses[t] = static_cast<std::uint8_t>(std::max<int>(darkness, bands.below[t].darkness));
    }
}

/// Replaces each number with the maximum of itself and its two neighbours.
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

/// Sets all columns of a tile to a level. Returns a pointer to the first column of the next tile.
inline std::uint8_t* fill(std::uint8_t* column, unsigned level) {
    const Word word = in_all_bytes(1) * level;
    for (std::size_t k = 0; k < kTileWidth_px; k += sizeof word)
        std::memcpy(__builtin_assume_aligned(column + k, sizeof word), &word, sizeof word);
    return column + kTileWidth_px;
}

/// Histogram of tile contrasts. A contrast is a fraction of the paper level, and the bin width is
/// 1/kContrastBins.
using Histogram = std::array<std::uint16_t, kContrastBins>;

/// Adds each tile whose contrast is at least `min_contrast` grey levels to the histogram, and
/// returns the number of these tiles. All other tiles are blank, and their means are set to 0.
/// Raises `max_contrast` to the largest contrast of a tile, if that is larger.
int take_contrasts(std::uint8_t* means, const std::uint8_t* darknesses, std::size_t tiles,
                   int min_contrast, int& max_contrast, Histogram& histogram) {
    int blank = 0;
    int largest = max_contrast;
    for (std::size_t t = 0; t < tiles; ++t) {
        const int mean = means[t];
        const int contrast = mean + darknesses[t] - 255;
        largest = std::max(largest, contrast);
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
    max_contrast = largest;
    return static_cast<int>(tiles) - blank;
}

/// Returns the typical contrast of dots in a band relative to the paper level, in units of 1/256,
/// or 0 if no tile has contrast. The relative contrast does not depend on the illumination, because
/// ink reflects the same fraction of the light everywhere. The 30 % quantile over the tiles is
/// typical of dots even if graphics, which have more contrast, cross the band.
unsigned typical_contrast_q8(std::uint8_t* means, const std::uint8_t* darknesses, std::size_t tiles,
                             int min_contrast, int& max_contrast) {
    Histogram histogram{};
    const int count =
        take_contrasts(means, darknesses, tiles, min_contrast, max_contrast, histogram);
    if (count == 0) return 0;
    unsigned bin = 0;
    for (int below = 0; bin < kContrastBins - 1; ++bin) {
        below += histogram[bin];
        if (10 * below > 3 * count) break;
    }
    return (2 * bin + 1) * (256 / (2 * kContrastBins));
}

/// Sets the thresholds of all columns. The low threshold is the paper level times (1 - `to_low_q16`
/// / 2^16). The high threshold is the paper level times (1 - `to_high_q16` / 2^16), but at most the
/// low threshold.
void set_levels(const std::uint8_t* papers, std::size_t tiles, unsigned to_low_q16,
                unsigned to_high_q16, AdaptiveThreshold& threshold) {
    std::uint8_t* half_low_levels = threshold.half_low_levels.data();
    std::uint8_t* high_levels = threshold.high_levels.data();
    for (const std::uint8_t* const end = papers + tiles; papers != end; ++papers) {
        const unsigned paper = *papers;
        // Makes the low threshold even, because the search for runs compares only the upper seven
        // bits of each level.
        const unsigned half_low = (paper - (paper * to_low_q16 >> 16)) >> 1;
        const unsigned high = std::min(paper - (paper * to_high_q16 >> 16), 2 * half_low);
        half_low_levels = fill(half_low_levels, half_low);
        high_levels = fill(high_levels, high);
    }
}

}  // namespace

int min_tile_contrast(const ThresholdOptions& options, const AdaptiveThreshold& threshold) {
    // Before clamping, the minimum contrast is the largest contrast so far divided by this number.
    // A smaller divisor would reject more noise, but it would also reject pale dots in uneven
    // light.
    constexpr int kContrastPart = 6;
    return std::clamp(threshold.max_contrast / kContrastPart, options.min_contrast,
                      2 * options.min_contrast);
}

void begin_threshold(int width_px, int height_px, AdaptiveThreshold& threshold) {
    threshold.width_px = width_px;
    threshold.height_px = height_px;
    threshold.band_px =
        std::min(width_px, height_px) <= kMaxSideWithLowTiles_px ? kLowTile_px : kHighTile_px;
    threshold.band_shift = std::countr_zero(static_cast<unsigned>(threshold.band_px));
    threshold.tiles_per_band = (width_px + kTileWidth_px - 1) / kTileWidth_px;
    threshold.rows_taken = 0;
    threshold.has_contrast = false;
    threshold.max_contrast = 0;
    std::fill_n(threshold.half_low_levels.begin() + whole_width(threshold), kReadAhead_px,
                kAlwaysDark);
}

int take_row(const std::uint8_t* pixels, AdaptiveThreshold& threshold) {
    const int v = threshold.rows_taken++;
    keep_row(pixels, threshold, kept_row(threshold, v));
    const bool is_last = v + 1 == threshold.height_px;
    const bool ends_band = ((v + 1) & (threshold.band_px - 1)) == 0;
    if (!ends_band && !is_last) return 0;
    const int band = v >> threshold.band_shift;
    measure_tiles(band, threshold, tiles_of(threshold, band));
    return (band > 0 ? 1 : 0) + (is_last ? 1 : 0);
}

void measure_levels(int band, const ThresholdOptions& options, AdaptiveThreshold& threshold) {
    const auto tiles = static_cast<std::size_t>(threshold.tiles_per_band);
    // The threshold buffers temporarily store one value per tile. The paper levels are at the end
    // of `half_low_levels`, because `set_levels` overwrites the end last.
    std::uint8_t* const papers = threshold.half_low_levels.data() + whole_width(threshold) - tiles;
    std::uint8_t* const darknesses = threshold.high_levels.data();
    join_bands(three_bands(threshold, band), tiles, papers, darknesses);
    // Takes the maximum darkness over each tile and its two neighbours, because a tile may contain
    // no dot if the dot spacing exceeds the tile width. This is not necessary for the paper level,
    // because every tile contains paper.
    join_neighbours(darknesses, tiles);
    // If the last tile is mostly padding, raises its paper level to at least that of the preceding
    // tile.
    if (whole_width(threshold) - threshold.width_px > kTileWidth_px / 2)
        papers[tiles - 1] = std::max(papers[tiles - 2], papers[tiles - 1]);
    const unsigned contrast_q8 = typical_contrast_q8(
        papers, darknesses, tiles, min_tile_contrast(options, threshold), threshold.max_contrast);
    if (contrast_q8 > 0) threshold.has_contrast = true;
    set_levels(papers, tiles, contrast_q8 * static_cast<unsigned>(options.low_q8),
               contrast_q8 * static_cast<unsigned>(options.high_q8), threshold);
}

}  // namespace dotpose::core
