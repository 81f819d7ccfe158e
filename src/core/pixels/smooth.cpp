#include "core/pixels/smooth.hpp"

#include <algorithm>
#include <cstddef>

#include "core/pixels/paper.hpp"

namespace dotpose::core {
namespace {

constexpr int kReach = 2;
constexpr int kRows = 2 * kReach + 1;

std::uint16_t* line(const Smoothing& smoothing, int v, int width_px) {
    return smoothing.lines.data() + static_cast<std::ptrdiff_t>(v % kRows) * width_px;
}

/// Limits pixels to the range of their neighbours: an impulse has none like it.
void clip_impulses(const ImageView& image, int v, std::uint8_t* out) {
    const std::uint8_t* above = image.row(std::max(v - 1, 0));
    const std::uint8_t* here = image.row(v);
    const std::uint8_t* below = image.row(std::min(v + 1, image.height_px - 1));
    for (int u = 0; u < image.width_px; ++u) {
        const int left = std::max(u - 1, 0);
        const int right = std::min(u + 1, image.width_px - 1);
        const auto [low_above, high_above] = std::minmax({above[left], above[u], above[right]});
        const auto [low_below, high_below] = std::minmax({below[left], below[u], below[right]});
        const auto [low_here, high_here] = std::minmax({here[left], here[right]});
        out[u] = std::clamp(here[u], std::min({low_above, low_below, low_here}),
                            std::max({high_above, high_below, high_here}));
    }
}

void weight_along(const std::uint8_t* pixels, int width_px, std::uint16_t* out) {
    const auto at = [&](int u) { return int{pixels[std::clamp(u, 0, width_px - 1)]}; };
    for (int u = 0; u < width_px; ++u) {
        out[u] = static_cast<std::uint16_t>(at(u - 2) + at(u + 2) + 4 * (at(u - 1) + at(u + 1)) +
                                            6 * at(u));
    }
}

/// Half the side of the surroundings: they reach over two spacings wherever 8 dots are in view.
/// Towards the border they shrink, and so stay even around the pixel: a gradient of the light does
/// no harm.
int half_side(int at, int length, int largest) {
    constexpr int kSmallest = 4;
    return std::max(std::min({largest, at, length - 1 - at}), kSmallest);
}

/// Adds a row to the sums of the columns, or takes it off again. What is much darker than the paper
/// around counts as paper: strokes of graphics are no shadow.
void add_row(const ImageView& image, int v, bool add, Smoothing& smoothing) {
    const std::uint8_t* row = image.row(v);
    const int block_px = smoothing.paper.block_px;
    for (int begin = 0; begin < image.width_px; begin += block_px) {
        const int paper = brightest_paper_near(smoothing.paper, begin, v);
        const int end = std::min(begin + block_px, image.width_px);
        for (int u = begin; u < end; ++u) {
            const auto level =
                static_cast<std::uint32_t>(10 * row[u] < 7 * paper ? paper : int{row[u]});
            std::uint32_t& sum = smoothing.column_sums[static_cast<std::size_t>(u)];
            sum = add ? sum + level : sum - level;
        }
    }
}

/// Moves the window of rows that the column sums are taken over.
void move_sums(const ImageView& image, int begin, int end, Smoothing& smoothing) {
    while (smoothing.sums_end < end)
        add_row(image, smoothing.sums_end++, true, smoothing);
    while (smoothing.sums_begin < begin)
        add_row(image, smoothing.sums_begin++, false, smoothing);
}

/// Level below which all is the same: graphics look no darker than a weak dot, and so do not hide
/// the contrast of the dots near them.
constexpr std::uint32_t kDarkest = kEvenLevel * 4 / 5;

/// Divides each pixel by the mean of its surroundings.
void even_out(const ImageView& image, int v, Smoothing& smoothing) {
    const int largest = smoothing.paper.block_px;
    const int half_height = half_side(v, image.height_px, largest);
    move_sums(image, std::max(v - half_height, 0), std::min(v + half_height + 1, image.height_px),
              smoothing);
    const auto rows = static_cast<std::uint32_t>(smoothing.sums_end - smoothing.sums_begin);
    std::uint32_t sum = 0;
    int begin = 0;
    int end = 0;
    for (int u = 0; u < image.width_px; ++u) {
        const int half_width = half_side(u, image.width_px, largest);
        while (end < std::min(u + half_width + 1, image.width_px)) {
            sum += smoothing.column_sums[static_cast<std::size_t>(end++)];
        }
        while (begin < u - half_width)
            sum -= smoothing.column_sums[static_cast<std::size_t>(begin++)];
        const std::uint32_t mean =
            std::max(sum / (rows * static_cast<std::uint32_t>(end - begin)), 1U);
        std::uint8_t& pixel = smoothing.row[static_cast<std::size_t>(u)];
        pixel = static_cast<std::uint8_t>(
            std::clamp(pixel * std::uint32_t{kEvenLevel} / mean, kDarkest, 255U));
    }
}

}  // namespace

void begin_smoothing(const ImageView& image, Smoothing& smoothing) {
    smoothing.lines_ready = 0;
    smoothing.rows_given = 0;
    measure_paper(image, smoothing.paper);
    smoothing.sums_begin = 0;
    smoothing.sums_end = 0;
    std::fill_n(smoothing.column_sums.begin(), image.width_px, 0U);
}

const std::uint8_t* next_smooth_row(const ImageView& image, Smoothing& smoothing) {
    const int v = smoothing.rows_given++;
    std::uint8_t* out = smoothing.row.data();
    while (smoothing.lines_ready < std::min(v + kReach + 1, image.height_px)) {
        clip_impulses(image, smoothing.lines_ready, out);
        weight_along(out, image.width_px, line(smoothing, smoothing.lines_ready, image.width_px));
        ++smoothing.lines_ready;
    }
    const auto at = [&](int row) {
        return line(smoothing, std::clamp(row, 0, image.height_px - 1), image.width_px);
    };
    const std::uint16_t* const rows[kRows] = {at(v - 2), at(v - 1), at(v), at(v + 1), at(v + 2)};
    for (int u = 0; u < image.width_px; ++u) {
        const int sum = rows[0][u] + rows[4][u] + 4 * (rows[1][u] + rows[3][u]) + 6 * rows[2][u];
        out[u] = static_cast<std::uint8_t>((sum + 128) >> 8);
    }
    even_out(image, v, smoothing);
    return out;
}

}  // namespace dotpose::core
