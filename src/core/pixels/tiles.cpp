#include "core/pixels/tiles.hpp"

#include <algorithm>
#include <array>

#include "core/pixels/light.hpp"
#include "core/pixels/words.hpp"
#include "core/wide.hpp"
#include "dotpose/locate.hpp"

namespace dotpose::core {
namespace {

/// Dots are sought in every n-th row: they are higher than that; paper in fewer.
constexpr int kDotsEvery = 2;
constexpr int kPaperEvery = 4;

/// The kept rows of a band, from their first pixels on.
struct Rows {
    const std::uint8_t* begin;
    std::ptrdiff_t stride;
    std::ptrdiff_t size;         ///< of all rows
    std::ptrdiff_t paper_begin;  ///< of those rows that count for paper
    std::ptrdiff_t paper_size;
    std::uint32_t paper_count;

    Rows(int band, const Light& light)
        : begin(kept_row(light, band_begin(light, band))), stride(kept_stride(light)) {
        const int count = band_end(light, band) - band_begin(light, band);
        // Rows evenly about the middle; of a narrow last band, its first.
        const int first = count > kPaperEvery / 2 ? kPaperEvery / 2 : 0;
        size = count * stride;
        paper_begin = first * stride;
        paper_size = size - paper_begin;
        paper_count = static_cast<std::uint32_t>((count - first + kPaperEvery - 1) / kPaperEvery);
    }
};

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
                                         std::ptrdiff_t size) {
    Word darkest = ~Word{0};
    // From the word before on, as the smallest devices address no bytes before a pointer.
    pixels -= sizeof(Word);
    for (const std::uint8_t* const end = pixels + size; pixels < end; pixels += stride) {
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
                                              std::ptrdiff_t size) {
    constexpr Word kHalves = static_cast<Word>(0x00FF00FF00FF00FF);
    Word halves = 0;
    for (const std::uint8_t* const end = pixels + size; pixels < end; pixels += stride) {
#pragma GCC unroll 2
        for (std::size_t k = 0; k < kSmallestTile_px; k += sizeof(Word)) {
            const Word word = word_at(pixels + k);
            halves += (word & kHalves) + (word >> 8 & kHalves);
        }
    }
    return sum_of_halves(halves);
}

/// Sums of tiles to their means.
class Means {
  public:
    Means(const Rows& rows, const Light& light) {
        const auto pixels = rows.paper_count * static_cast<std::uint32_t>(light.tile_px);
        inverse_q20_ = ((1U << 20) + pixels - 1) / pixels;
    }
    std::uint8_t operator()(std::uint32_t sum) const {
        return static_cast<std::uint8_t>((sum * inverse_q20_) >> 20);
    }

  private:
    std::uint32_t inverse_q20_;
};

/// A number for each column, and some that are read with the last.
template <typename Number>
using Columns = std::array<Number, kMaxFrameSide_px + kLargestTile_px + kSmallestTile_px>;

/// Joins to each column the next seven.
template <typename Number, typename Join>
void join_groups(std::size_t columns, Columns<Number>& numbers, Join join) {
    for (std::size_t distance = 1; distance < kSmallestTile_px; distance *= 2) {
        const Number* const right = numbers.data() + distance;
        for (std::size_t u = 0; u < columns; ++u)
            numbers[u] = static_cast<Number>(join(numbers[u], right[u]));
    }
}

/// Into each column the darkest, as above, from there to the seventh after it.
void find_darkest(const Rows& rows, std::size_t columns, Columns<std::uint8_t>& darkest) {
    const auto darker = [](std::uint8_t a, std::uint8_t b) { return a < b ? a : b; };
    const auto lighter = [](std::uint8_t a, std::uint8_t b) { return a > b ? a : b; };
    std::fill_n(darkest.begin(), columns + kSmallestTile_px, std::uint8_t{255});
    const std::uint8_t* const end = rows.begin + rows.size;
    for (const std::uint8_t* row = rows.begin; row < end; row += kDotsEvery * rows.stride) {
        const std::uint8_t* const left = row - 1;
        for (std::size_t u = 0; u < columns; ++u)
            darkest[u] = darker(darkest[u], lighter(row[u], left[u]));
    }
    join_groups(columns, darkest, darker);
}

/// Into each column the sum of paper from there to the seventh after it.
void sum_paper(const Rows& rows, std::size_t columns, Columns<std::uint16_t>& sums) {
    std::fill_n(sums.begin(), columns + kSmallestTile_px, std::uint16_t{0});
    const std::uint8_t* const end = rows.begin + rows.size;
    for (const std::uint8_t* row = rows.begin + rows.paper_begin; row < end;
         row += kPaperEvery * rows.stride) {
        for (std::size_t u = 0; u < columns; ++u)
            sums[u] = static_cast<std::uint16_t>(sums[u] + row[u]);
    }
    join_groups(columns, sums, [](std::uint16_t a, std::uint16_t b) { return a + b; });
}

/// Row by row: compilers make vectors of this.
void measure_tiles_by_row(int band, const Light& light, std::span<Tile> tiles) {
    const Rows rows(band, light);
    const Means means(rows, light);
    const std::size_t columns = tiles.size() << light.tile_shift;
    Columns<std::uint8_t> darkest;
    find_darkest(rows, columns, darkest);
    Columns<std::uint16_t> sums;
    sum_paper(rows, columns, sums);
    std::size_t u = 0;
    for (Tile& tile : tiles) {
        std::uint32_t sum = 0;
        unsigned least = 255;
        for (const std::size_t end = u + static_cast<std::size_t>(light.tile_px); u < end;
             u += kSmallestTile_px) {
            sum += sums[u];
            least = std::min<unsigned>(least, darkest[u]);
        }
        tile.mean = means(sum);
        tile.darkness = static_cast<std::uint8_t>(255 - least / 2 * 2);
    }
}

}  // namespace

void measure_tiles_by_word(int band, const Light& light, std::span<Tile> tiles) {
    const Rows rows(band, light);
    const Means means(rows, light);
    const std::uint8_t* column = rows.begin;
    for (Tile& tile : tiles) {
        std::uint32_t sum = 0;
        unsigned darkest = 0x7F;
        for (const std::uint8_t* const end = column + light.tile_px; column != end;
             column += kSmallestTile_px) {
            sum += sum_of_column(column + rows.paper_begin, kPaperEvery * rows.stride,
                                 rows.paper_size);
            darkest = std::min(darkest, least_byte(darkest_in_column(
                                            column, kDotsEvery * rows.stride, rows.size)));
        }
        tile.mean = means(sum);
        tile.darkness = static_cast<std::uint8_t>(255 - 2 * darkest);
    }
}

void measure_tiles(int band, const Light& light, std::span<Tile> tiles) {
    if constexpr (kIsWide) {
        measure_tiles_by_row(band, light, tiles);
    } else {
        measure_tiles_by_word(band, light, tiles);
    }
}

}  // namespace dotpose::core
