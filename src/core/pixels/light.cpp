#include "core/pixels/light.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "core/pixels/words.hpp"

namespace dotpose::core {
namespace {

constexpr int kBandsKept = 4;  // three are needed
constexpr unsigned kContrastBins = 64;
/// Dots are sought in every n-th row: they are higher than that; paper in fewer.
constexpr int kDotsEvery = 2;
constexpr int kPaperEvery = 4;

std::span<Tile> tiles_of(const Light& light, int band) {
    const auto n = static_cast<std::size_t>(light.tiles_per_band);
    return light.tiles.subspan(static_cast<std::size_t>(band & (kBandsKept - 1)) * n, n);
}

/// Copies as many blocks as fit into `size` bytes from `done` on; returns how far it got.
template <std::size_t kBlock>
std::size_t copy_blocks(const std::uint8_t* from, std::uint8_t* to, std::size_t done,
                        std::size_t size) {
    for (; done + kBlock <= size; done += kBlock)
        std::memcpy(__builtin_assume_aligned(to + done, 4),
                    __builtin_assume_aligned(from + done, 4), kBlock);
    return done;
}

/// Keeps a row, and repeats its last pixel to the end of its tile.
void keep_row(const std::uint8_t* pixels, const Light& light, std::uint8_t* row) {
    const auto width = static_cast<std::size_t>(light.width_px);
    const auto whole = static_cast<std::size_t>(light.tiles_per_band) << light.tile_shift;
    std::size_t u = 0;
    if (reinterpret_cast<std::uintptr_t>(pixels) % 4 == 0) {
        // The libraries of small devices copy byte by byte.
        u = copy_blocks<16>(pixels, row, u, width);
        u = copy_blocks<4>(pixels, row, u, width);
    }
    if (u < width) std::copy(pixels + u, pixels + width, row + u);
    for (u = width; u < whole; ++u)
        row[u] = pixels[width - 1];
}

/// The least of all bytes, seven bits each; tops are set.
constexpr unsigned least_byte(Word bytes) {
    for (std::size_t shift = 4 * sizeof bytes; shift >= 8; shift /= 2)
        bytes -= excess(bytes, bytes >> shift & ~kTops);
    return static_cast<unsigned>(bytes) & 0x7F;
}

/// The sum of 16-bit numbers.
constexpr std::uint32_t sum_of_halves(Word halves) {
    for (std::size_t shift = 4 * sizeof halves; shift >= 16; shift /= 2)
        halves += halves >> shift;
    return static_cast<std::uint32_t>(halves) & 0xFFFF;
}

/// The darkest in a column of eight pixels, for each byte of a word, in seven bits; tops are set.
/// Dark is what two pixels side by side agree on: a defect pixel is no ink.
// Not inlined, nor is the next: small devices have registers for one loop.
[[gnu::noinline]] Word darkest_in_column(const std::uint8_t* pixels, std::ptrdiff_t stride,
                                         const std::uint8_t* end) {
    Word darkest = ~Word{0};
    // From the word before on, as the smallest devices address no bytes before a pointer.
    for (pixels -= sizeof(Word), end -= sizeof(Word); pixels < end; pixels += stride) {
#pragma GCC unroll 2
        for (std::size_t k = 0; k < kSmallestTile_px; k += sizeof(Word)) {
            const Word word = word_at(pixels + k + sizeof(Word));
            const Word here = word >> 1 | kTops;
            const Word left = (word << 8 | pixels[k + sizeof(Word) - 1]) >> 1 & ~kTops;
            darkest -= excess(darkest, left + excess(here, left));
        }
    }
    return darkest;
}

/// The sum of a column of eight pixels.
[[gnu::noinline]] std::uint32_t sum_of_column(const std::uint8_t* pixels, std::ptrdiff_t stride,
                                              const std::uint8_t* end) {
    constexpr Word kHalves = static_cast<Word>(0x00FF00FF00FF00FF);
    Word halves = 0;
    for (; pixels < end; pixels += stride) {
#pragma GCC unroll 2
        for (std::size_t k = 0; k < kSmallestTile_px; k += sizeof(Word)) {
            const Word word = word_at(pixels + k);
            halves += (word & kHalves) + (word >> 8 & kHalves);
        }
    }
    return sum_of_halves(halves);
}

/// Sets the tiles of a band that ends with the newest row.
void measure_tiles(int band, const Light& light, std::span<Tile> tiles) {
    const std::ptrdiff_t stride = kept_stride(light);
    const int rows = band_end(light, band) - band_begin(light, band);
    const std::uint8_t* column = kept_row(light, band_begin(light, band));
    const std::uint8_t* end = column + rows * stride;
    // Rows evenly about the middle; of a narrow last band, its first.
    const std::ptrdiff_t to_paper = rows > kPaperEvery / 2 ? kPaperEvery / 2 * stride : 0;
    const int paper_rows = std::max((rows - 1 + kPaperEvery / 2) / kPaperEvery, 1);
    const auto pixels = static_cast<std::uint32_t>(paper_rows * light.tile_px);
    const std::uint32_t inverse_q20 = ((1U << 20) + pixels - 1) / pixels;
    for (Tile& tile : tiles) {
        std::uint32_t sum = 0;
        unsigned darkest = 0x7F;
        for (int u = 0; u < light.tile_px; u += kSmallestTile_px) {
            sum += sum_of_column(column + to_paper, kPaperEvery * stride, end);
            darkest =
                std::min(darkest, least_byte(darkest_in_column(column, kDotsEvery * stride, end)));
            column += kSmallestTile_px;
            end += kSmallestTile_px;
        }
        tile.mean = static_cast<std::uint8_t>((sum * inverse_q20) >> 20);
        tile.darkest = static_cast<std::uint8_t>(2 * darkest);
    }
}

/// Brightest mean and darkest pixel of some tiles.
struct Extremes {
    int mean = 0;
    int darkest = 255;

    void take(int other_mean, int other_darkest) {
        mean = std::max(mean, other_mean);
        darkest = std::min(darkest, other_darkest);
    }
    void take(const Tile& tile) { take(tile.mean, tile.darkest); }
    void take(const Extremes& other) { take(other.mean, other.darkest); }
};

/// The tiles of a band and of those above and below; at the image's rims, the band itself instead.
struct ThreeBands {
    const Tile* above;
    const Tile* here;
    const Tile* below;

    Extremes column(std::size_t tile) const {
        Extremes column{above[tile].mean, above[tile].darkest};
        column.take(here[tile]);
        column.take(below[tile]);
        return column;
    }
};

ThreeBands three_bands(const Light& light, int band) {
    const Tile* here = tiles_of(light, band).data();
    return {band > 0 ? tiles_of(light, band - 1).data() : here, here,
            band + 1 < band_count(light) ? tiles_of(light, band + 1).data() : here};
}

/// 1 / (paper + 1), to tell contrasts relative to the paper's level in `kContrastBins`-ths.
constexpr auto kInverses_q16 = [] {
    std::array<std::uint32_t, 256> inverses{};
    for (std::uint32_t paper = 0; paper < inverses.size(); ++paper)
        inverses[paper] = (kContrastBins << 16) / (paper + 1);
    return inverses;
}();

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
    for (int v = 0; v < 2 * light.tile_px; ++v)
        std::fill_n(kept_row(light, v) - kKeptMargin_px, kKeptMargin_px, std::uint8_t{255});
}

int take_row(const std::uint8_t* pixels, Light& light) {
    const int v = light.rows_taken++;
    keep_row(pixels, light, kept_row(light, v));
    const bool is_last = v + 1 == light.height_px;
    const bool ends_band = ((v + 1) & (light.tile_px - 1)) == 0;
    if (!ends_band && !is_last) return 0;
    const int band = v >> light.tile_shift;
    measure_tiles(band, light, tiles_of(light, band));
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
    Extremes left;
    Extremes here = bands.column(0);
    for (std::size_t t = 0; t < levels.size(); ++t) {
        const Extremes right = t + 1 < levels.size() ? bands.column(t + 1) : Extremes{};
        Extremes near = here;
        near.take(left);
        near.take(right);
        left = here;
        here = right;
        const int contrast = near.mean - near.darkest;
        levels[t] = Levels{};
        if (contrast < options.min_contrast) continue;
        const std::uint32_t inverse_q16 = kInverses_q16[static_cast<std::size_t>(near.mean)];
        ++histogram[(static_cast<std::uint32_t>(contrast) * inverse_q16) >> 16];
        levels[t].paper = static_cast<std::uint8_t>(near.mean);
        light.has_contrast = true;
        ++count;
    }
    int bin = 0;
    for (int below = 0; bin < static_cast<int>(kContrastBins) - 1; ++bin) {
        below += histogram[static_cast<std::size_t>(bin)];
        if (10 * below > 3 * count) break;
    }
    const int depth_q8 = (2 * bin + 1) * static_cast<int>(256 / (2 * kContrastBins));
    const int to_extent_q16 = depth_q8 * options.extent_q8;
    const int to_core_q16 = depth_q8 * options.core_q8;
    Word* half_level = light.half_levels.data();
    for (Levels& level : levels) {
        if (level.paper != 0) {
            const int to_extent = (level.paper * to_extent_q16) >> 16;
            const int to_core = (level.paper * to_core_q16) >> 16;
            // Even, so that blobs may compare seven bits.
            level.extent = static_cast<std::uint8_t>((level.paper - to_extent) & ~1);
            level.core = static_cast<std::uint8_t>(level.paper - to_core);
        }
        for (int u = 0; u < light.tile_px; u += kSmallestTile_px)
            *half_level++ = in_all_bytes(level.extent / 2);
    }
}

}  // namespace dotpose::core
