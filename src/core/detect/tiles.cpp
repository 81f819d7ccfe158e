#include "core/detect/tiles.hpp"

#include <algorithm>

#include "core/detect/adaptive_threshold.hpp"
#include "core/detect/words.hpp"

namespace dotpose::core {
namespace {

/// Distance between the measured rows of a band. It is small enough that these rows cross some of
/// the dots in each tile.
constexpr int kRowsEvery = 4;

struct Rows {
    const std::uint8_t* begin;
    std::ptrdiff_t stride;
    int count;

    Rows(int band, const AdaptiveThreshold& threshold) {
        const int rows = band_end(threshold, band) - band_begin(threshold, band);
        // The measured rows are centred in the band. If the last band has only one or two rows, the
        // first row is measured.
        const int first = rows > kRowsEvery / 2 ? kRowsEvery / 2 : 0;
        begin = kept_row(threshold, band_begin(threshold, band) + first);
        stride = kRowsEvery * whole_width(threshold);
        count = (rows - first + kRowsEvery - 1) / kRowsEvery;
    }
};

/// Converts a sum over the pixels of a tile to a mean.
class Means {
  public:
    explicit Means(int rows) {
        const auto pixels = static_cast<std::uint32_t>(rows * kTileWidth_px);
        inverse_q20_ = ((1U << 20) + pixels - 1) / pixels;
    }
    std::uint8_t operator()(std::uint32_t sum) const {
        return static_cast<std::uint8_t>((sum * inverse_q20_) >> 20);
    }

  private:
    std::uint32_t inverse_q20_;
};

/// Returns the darkness of a pair of pixels. `min` is the sum of their levels.
constexpr std::uint8_t darkness_of_pair(std::uint32_t min) {
    return static_cast<std::uint8_t>(255 - min / 2);
}

/// Masks for the low byte and the top bit of each 16-bit field in a word. A field contains a *pair*
/// (the sum of two adjacent pixels) or a sum of pairs.
constexpr Word kPairs = static_cast<Word>(0x00FF00FF00FF00FF);
constexpr Word kPairTops = static_cast<Word>(0x8000800080008000);

/// Returns max(a - b, 0) in each field. All top bits must be set in `a` and clear in `b`.
constexpr Word excess_of_pairs(Word a, Word b) {
    const Word difference = a - b;
    const Word is_positive = difference & kPairTops;
    return difference & (is_positive - (is_positive >> 15));
}

/// Returns the minimum over all fields, without the top bit. All top bits must be set.
constexpr std::uint32_t min_of_pairs(Word pairs) {
    for (std::size_t shift = 4 * sizeof pairs; shift >= 16; shift /= 2)
        pairs -= excess_of_pairs(pairs, pairs >> shift & ~kPairTops);
    return static_cast<std::uint32_t>(pairs) & 0x7FFF;
}

constexpr std::uint32_t sum_of_pairs(Word pairs) {
    for (std::size_t shift = 4 * sizeof pairs; shift >= 16; shift /= 2)
        pairs += pairs >> shift;
    return static_cast<std::uint32_t>(pairs) & 0xFFFF;
}

}  // namespace

void measure_tiles(int band, const AdaptiveThreshold& threshold, std::span<Tile> tiles) {
    const Rows rows(band, threshold);
    const Means means(rows.count);
    const std::uint8_t* column = rows.begin;
    for (Tile& tile : tiles) {
        Word sums = 0;
        Word min = ~Word{0};
        const std::uint8_t* pixels = column;
        for (int n = rows.count; n > 0; --n, pixels += rows.stride) {
#pragma GCC unroll 4
            for (std::size_t k = 0; k < kTileWidth_px; k += sizeof(Word)) {
                const Word word = word_at(pixels + k);
                const Word pairs = (word & kPairs) + (word >> 8 & kPairs);
                sums += pairs;
                min -= excess_of_pairs(min, pairs);
            }
        }
        tile = {means(sum_of_pairs(sums)), darkness_of_pair(min_of_pairs(min))};
        column += kTileWidth_px;
    }
}

}  // namespace dotpose::core
