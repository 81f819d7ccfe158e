#include "core/pixels/light.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace dotpose::core {
namespace {

constexpr int kBandsKept = 3;
constexpr unsigned kContrastBins = 64;
/// Dots are sought in every n-th row: they are higher than that; paper in fewer.
constexpr int kDotsEvery = 2;
constexpr int kPaperEvery = 4;

std::span<Tile> tiles_of(const Light& light, int band) {
    const auto n = static_cast<std::size_t>(light.tiles_per_band);
    return light.tiles.subspan(static_cast<std::size_t>(band % kBandsKept) * n, n);
}

std::uint32_t word_at(const std::uint8_t* bytes) {
    std::uint32_t word = 0;
    std::memcpy(&word, __builtin_assume_aligned(bytes, 4), sizeof word);
    return word;
}

// Four pixels at a time, of seven bits each: the eighth is free for comparisons.
constexpr std::uint32_t kTops = 0x80808080;

/// a - b in each byte, or 0 where that is negative.
constexpr std::uint32_t excess(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t difference = (a | kTops) - b;
    const std::uint32_t is_positive = difference & kTops;
    return difference & (is_positive - (is_positive >> 7));
}

/// Dark is what two pixels side by side agree on: a defect pixel is no ink.
void find_darkest(const std::uint8_t* row, std::size_t words, std::uint32_t* darkest) {
    std::uint32_t before = ~kTops;
    for (std::size_t i = 0; i < words; ++i) {
        const std::uint32_t here = word_at(row + 4 * i) >> 1 & ~kTops;
        const std::uint32_t left = here << 8 | before >> 24;
        const std::uint32_t lighter = left + excess(here, left);
        darkest[i] -= excess(darkest[i], lighter);
        before = here;
    }
}

void add_up(const std::uint8_t* row, std::size_t words, std::uint32_t* sums) {
    for (std::size_t i = 0; i < words; ++i) {
        const std::uint32_t word = word_at(row + 4 * i);
        sums[i] += (word & 0x00FF00FF) + (word >> 8 & 0x00FF00FF);
    }
}

void keep_row(const std::uint8_t* pixels, const Light& light, std::uint8_t* row) {
    const auto width = static_cast<std::size_t>(light.width_px);
    const auto whole = static_cast<std::size_t>(light.tile_px * light.tiles_per_band);
    std::size_t u = 0;
    if (reinterpret_cast<std::uintptr_t>(pixels) % 4 == 0) {
        // The libraries of small devices copy byte by byte.
        struct alignas(4) Block {
            std::array<std::uint32_t, 4> words;
        };
        for (; u + sizeof(Block) <= width; u += sizeof(Block)) {
            Block block;
            std::memcpy(&block, __builtin_assume_aligned(pixels + u, 4), sizeof block);
            std::memcpy(__builtin_assume_aligned(row + u, 4), &block, sizeof block);
        }
    }
    std::copy(pixels + u, pixels + width, row + u);
    std::fill(row + width, row + whole, pixels[width - 1]);
}

/// Rows evenly about the middle of a band; of the last one, the first if it has no other.
bool shows_paper(int v, const Light& light) {
    const int in_band = v & (light.tile_px - 1);
    const int rows = std::min(light.height_px - (v - in_band), light.tile_px);
    return in_band % kPaperEvery == kPaperEvery / 2 || (in_band == 0 && rows <= kPaperEvery / 2);
}

/// `last` is the last row in the band.
void close_tiles(int last, const Light& light, std::span<Tile> tiles) {
    const int rows = std::max((last + kPaperEvery / 2) / kPaperEvery, 1);
    const auto words = static_cast<std::size_t>(light.tile_px) / 4;
    const auto pixels = static_cast<std::uint32_t>(rows * light.tile_px);
    const std::uint32_t inverse_q20 = ((1U << 20) + pixels - 1) / pixels;
    std::size_t i = 0;
    for (Tile& tile : tiles) {
        std::uint32_t sum = 0;
        std::uint32_t darkest = ~kTops;
        for (const std::size_t end = i + words; i < end; ++i) {
            sum += (light.sums[i] & 0xFFFF) + (light.sums[i] >> 16);
            darkest -= excess(darkest, light.darkest[i]);
        }
        darkest -= excess(darkest, darkest >> 16 | 0x7F7F0000);
        darkest -= excess(darkest, darkest >> 8 | 0x7F7F7F00);
        tile.mean = static_cast<std::uint8_t>((sum * inverse_q20) >> 20);
        tile.darkest = static_cast<std::uint8_t>(2 * (darkest & 0x7F));
    }
}

/// Brightest mean and darkest pixel.
Tile both(Tile a, Tile b) {
    return {std::max(a.mean, b.mean), std::min(a.darkest, b.darkest)};
}

/// The tiles of a band and of those above and below; at the image's rims, the band itself instead.
struct ThreeBands {
    std::span<const Tile> above;
    std::span<const Tile> here;
    std::span<const Tile> below;

    Tile column(std::size_t tile) const { return both(both(above[tile], here[tile]), below[tile]); }
};

ThreeBands three_bands(const Light& light, int band) {
    const auto here = tiles_of(light, band);
    return {band > 0 ? tiles_of(light, band - 1) : here, here,
            band + 1 < band_count(light) ? tiles_of(light, band + 1) : here};
}

/// Contrasts relative to the paper's level, in `kContrastBins`-ths.
class RelativeContrast {
  public:
    unsigned bin(unsigned contrast, unsigned paper) {
        // Neighbouring tiles often have the same paper.
        if (paper != paper_) inverse_q16_ = (kContrastBins << 16) / (paper + 1);
        paper_ = paper;
        return (contrast * inverse_q16_) >> 16;
    }

  private:
    unsigned paper_ = UINT32_MAX;
    unsigned inverse_q16_ = 0;
};

}  // namespace

void begin_light(int width_px, int height_px, Light& light) {
    light.width_px = width_px;
    light.height_px = height_px;
    light.tile_px = std::min(width_px, height_px) <= kLargestFinelyTiled_px ? kSmallestTile_px
                                                                            : kLargestTile_px;
    light.tile_shift = std::countr_zero(static_cast<unsigned>(light.tile_px));
    light.tiles_per_band = (width_px + light.tile_px - 1) / light.tile_px;
    light.rows_taken = 0;
    light.has_contrast = false;
}

int take_row(const std::uint8_t* pixels, Light& light) {
    const int v = light.rows_taken++;
    const int in_band = v & (light.tile_px - 1);
    const auto words = static_cast<std::size_t>(light.tile_px * light.tiles_per_band) / 4;
    std::uint8_t* row = kept_row(light, v);
    keep_row(pixels, light, row);
    if (in_band == 0) {
        std::fill_n(light.sums.begin(), words, 0U);
        std::fill_n(light.darkest.begin(), words, ~kTops);
    }
    if (in_band % kDotsEvery == 0) find_darkest(row, words, light.darkest.data());
    if (shows_paper(v, light)) add_up(row, words, light.sums.data());
    const bool is_last = v + 1 == light.height_px;
    if (in_band + 1 < light.tile_px && !is_last) return 0;
    const int band = v >> light.tile_shift;
    close_tiles(in_band, light, tiles_of(light, band));
    return (band > 0 ? 1 : 0) + (is_last ? 1 : 0);
}

void measure_levels(int band, const ThresholdOptions& options, Light& light) {
    const auto levels = light.levels.first(static_cast<std::size_t>(light.tiles_per_band));
    // Ink reflects the same share of the light everywhere, and so the relative contrast of the dots
    // is the same for all tiles. Strokes of graphics raise that of the tiles around them: the lower
    // third over a band is that of dots even where strokes cross it.
    std::array<std::uint16_t, kContrastBins> histogram{};
    int count = 0;
    const ThreeBands bands = three_bands(light, band);
    RelativeContrast relative;
    Tile left{};
    Tile here = bands.column(0);
    for (std::size_t t = 0; t < levels.size(); ++t) {
        const Tile right = t + 1 < levels.size() ? bands.column(t + 1) : Tile{};
        const Tile near = both(both(left, here), right);
        left = here;
        here = right;
        const int contrast = near.mean - near.darkest;
        levels[t] = Levels{};
        if (contrast < options.min_contrast) continue;
        ++histogram[relative.bin(static_cast<unsigned>(contrast), near.mean)];
        levels[t].paper = near.mean;
        light.has_contrast = true;
        ++count;
    }
    int bin = 0;
    for (int below = 0; bin < static_cast<int>(kContrastBins) - 1; ++bin) {
        below += histogram[static_cast<std::size_t>(bin)];
        if (10 * below > 3 * count) break;
    }
    for (Levels& level : levels) {
        if (level.paper == 0) continue;
        const int depth_q8 =
            level.paper * (2 * bin + 1) * static_cast<int>(256 / (2 * kContrastBins));
        const int to_extent = (depth_q8 * options.extent_q8) >> 16;
        const int to_core = (depth_q8 * options.core_q8) >> 16;
        // Even, so that blobs may compare seven bits.
        level.extent = static_cast<std::uint8_t>((level.paper - to_extent) & ~1);
        level.core = static_cast<std::uint8_t>(level.paper - to_core);
    }
    std::size_t chunk = 0;
    for (const Levels& level : levels) {
        for (int u = 0; u < light.tile_px; u += kSmallestTile_px)
            light.half_levels[chunk++] = level.extent / 2U * 0x01010101U;
    }
}

}  // namespace dotpose::core
