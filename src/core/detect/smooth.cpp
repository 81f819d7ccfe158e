#include "core/detect/smooth.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/detect/paper.hpp"
#include "core/detect/tuning.hpp"
#include "core/math/tabled.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::smooth;

constexpr int kReach = 2;
constexpr int kRows = 2 * kReach + 1;

std::uint16_t* line(const Smoothing& smoothing, int v, int width_px) {
    return smoothing.lines.data() + static_cast<std::ptrdiff_t>(v % kRows) * width_px;
}

/// Clamps each pixel of row `v` to the range of its eight neighbours, to remove isolated bright or
/// dark pixels. Pixels at the image border keep their levels.
void clip_impulses(const ImageView& image, int v, std::uint8_t* out) {
    const std::uint8_t* above = image.row(std::max(v - 1, 0));
    const std::uint8_t* here = image.row(v);
    const std::uint8_t* below = image.row(std::min(v + 1, image.height_px - 1));
    const auto clipped = [=](int left, int u, int right) {
        const std::uint8_t low_beside = std::min(here[left], here[right]);
        const std::uint8_t low_above = std::min(std::min(above[left], above[u]), above[right]);
        const std::uint8_t low_below = std::min(std::min(below[left], below[u]), below[right]);
        const std::uint8_t high_beside = std::max(here[left], here[right]);
        const std::uint8_t high_above = std::max(std::max(above[left], above[u]), above[right]);
        const std::uint8_t high_below = std::max(std::max(below[left], below[u]), below[right]);
        const std::uint8_t low = std::min(std::min(low_above, low_below), low_beside);
        const std::uint8_t high = std::max(std::max(high_above, high_below), high_beside);
        return std::min(std::max(here[u], low), high);
    };
    const int last = image.width_px - 1;
    out[0] = clipped(0, 0, 1);
    for (int u = 1; u < last; ++u)
        out[u] = clipped(u - 1, u, u + 1);
    out[last] = clipped(last - 1, last, last);
}

void weight_along(const std::uint8_t* pixels, int width_px, std::uint16_t* out) {
    const auto weighted = [](int far_left, int left, int own, int right, int far_right) {
        return static_cast<std::uint16_t>(far_left + far_right + 4 * (left + right) + 6 * own);
    };
    const auto at_border = [&](int u) {
        const auto at = [&](int i) { return int{pixels[std::clamp(i, 0, width_px - 1)]}; };
        out[u] = weighted(at(u - 2), at(u - 1), at(u), at(u + 1), at(u + 2));
    };
    at_border(0);
    at_border(1);
    for (int u = 2; u < width_px - 2; ++u) {
        out[u] = weighted(pixels[u - 2], pixels[u - 1], pixels[u], pixels[u + 1], pixels[u + 2]);
    }
    at_border(width_px - 2);
    at_border(width_px - 1);
}

void weight_down(const std::array<const std::uint16_t*, kRows>& rows, int width_px,
                 std::uint8_t* out) {
    const auto [top, above, own, below, bottom] = rows;
    for (int u = 0; u < width_px; ++u) {
        const int sum = top[u] + bottom[u] + 4 * (above[u] + below[u]) + 6 * own[u];
        out[u] = static_cast<std::uint8_t>((sum + 128) >> 8);
    }
}

/// Returns the half-width of the window over which the local mean level is computed, along one
/// axis. The window is smaller near the image border, because only a window that is centred on the
/// pixel cancels light gradients. The result is at least kMinHalf_px.
int half_side(int at, int length, int max_half) {
    return std::max(std::min({max_half, at, length - 1 - at}), tuned::kMinHalf_px);
}

/// Adds a row to the column sums, or subtracts the row if `add` is false. Pixels much darker than
/// the paper are replaced with the paper level, because the local mean represents the illumination
/// and must not depend on graphics.
void add_row(const ImageView& image, int v, bool add, Smoothing& smoothing) {
    const std::uint8_t* row = image.row(v);
    std::uint32_t* sums = smoothing.column_sums.data();
    const int block_px = smoothing.paper.block_px;
    // (x ^ flip) - flip is x if flip is 0, and -x if all bits of flip are set.
    const std::uint32_t flip = add ? 0 : UINT32_MAX;
    for (int begin = 0; begin < image.width_px; begin += block_px) {
        const auto paper =
            static_cast<std::uint32_t>(brightest_paper_near(smoothing.paper, begin, v));
        const int end = std::min(begin + block_px, image.width_px);
        for (int u = begin; u < end; ++u) {
            const std::uint32_t pixel = row[u];
            const std::uint32_t level = 10 * pixel < tuned::kStroke_10ths * paper ? paper : pixel;
            sums[u] += (level ^ flip) - flip;
        }
    }
}

/// Updates the column sums to cover the rows [begin, end).
void move_sums(const ImageView& image, int begin, int end, Smoothing& smoothing) {
    while (smoothing.sums_end < end)
        add_row(image, smoothing.sums_end++, true, smoothing);
    while (smoothing.sums_begin < begin)
        add_row(image, smoothing.sums_begin++, false, smoothing);
}

/// Minimum level of the normalised image. Darker pixels are set to this level.
constexpr std::uint32_t kMinLevel = kNormalLevel * tuned::kMinLevel_5ths / 5;

/// Divides by multiplication and rounds down. `factor_` exceeds 2^kBits / d by at most 1, which
/// increases the quotient by at most n / 2^48 before rounding. If n / d < 256 and d < 2^20, this
/// increase is less than 1 / d, so the result is exact.
class Divider {
  public:
    std::uint32_t quotient(std::uint32_t n, std::uint32_t d) {
        if (d != divisor_) {
            divisor_ = d;
            factor_ = (std::uint64_t{1} << kBits) / d + 1;
        }
        return static_cast<std::uint32_t>(n * factor_ >> kBits);
    }

  private:
    static constexpr int kBits = 48;
    std::uint32_t divisor_ = 0;
    std::uint64_t factor_ = 0;
};

/// Returns kNormalLevel / mean in units of 2^-24, rounded up. The product with a grey level is
/// therefore too large by less than 2^-16. The result for a mean of 0 is never used.
constexpr std::uint32_t normalising_factor_q24(std::uint32_t mean) {
    return mean == 0 ? 0 : ((std::uint32_t{kNormalLevel} << 24) - 1) / mean + 1;
}

/// Multiplies each pixel of row `v` by kNormalLevel / mean, where mean is the mean level of a
/// window around the pixel. Clamps the result to [kMinLevel, 255].
void normalise_light(const ImageView& image, int v, Smoothing& smoothing) {
    const int max_half = smoothing.paper.block_px;
    const int half_height = half_side(v, image.height_px, max_half);
    move_sums(image, std::max(v - half_height, 0), std::min(v + half_height + 1, image.height_px),
              smoothing);
    const auto rows = static_cast<std::uint32_t>(smoothing.sums_end - smoothing.sums_begin);
    const std::uint32_t* columns = smoothing.column_sums.data();
    std::uint8_t* pixels = smoothing.row.data();
    Divider divider;
    const int width_px = image.width_px;
    std::uint32_t sum = 0;
    const auto normalise = [&](int u, int columns_in_sum) {
        const std::uint32_t area = rows * static_cast<std::uint32_t>(columns_in_sum);
        const std::uint32_t mean = std::max<std::uint32_t>(divider.quotient(sum, area), 1U);
        const std::uint64_t normalised =
            std::uint64_t{pixels[u]} * tabled<normalising_factor_q24, 256>(mean) >> 24;
        pixels[u] = static_cast<std::uint8_t>(
            std::clamp<std::uint32_t>(static_cast<std::uint32_t>(normalised), kMinLevel, 255U));
    };
    int begin = 0;
    int end = 0;
    const auto normalise_near_border = [&](int u) {
        const int half_width = half_side(u, width_px, max_half);
        while (end < std::min(u + half_width + 1, width_px))
            sum += columns[end++];
        while (begin < u - half_width)
            sum -= columns[begin++];
        normalise(u, end - begin);
    };
    for (int u = 0; u <= max_half; ++u)
        normalise_near_border(u);
    for (int u = max_half + 1; u < width_px - max_half; ++u) {
        sum += columns[end++] - columns[begin++];
        normalise(u, 2 * max_half + 1);
    }
    for (int u = width_px - max_half; u < width_px; ++u)
        normalise_near_border(u);
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
    weight_down({at(v - 2), at(v - 1), at(v), at(v + 1), at(v + 2)}, image.width_px, out);
    normalise_light(image, v, smoothing);
    return out;
}

}  // namespace dotpose::core
