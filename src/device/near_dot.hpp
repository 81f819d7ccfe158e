// Near dot: measures the dot near an intersection whose image point is known. The measurement does
// not depend on the code, so its result can be compared with the code. Most functions are inline,
// because calls would account for a third of the time per dot on small processors.
#pragma once

#include <array>

#include "core/detect/inverses.hpp"
#include "core/kernels/portable/dark_sums.hpp"
#include "core/noinline.hpp"
#include "device/newest_rows.hpp"
#include "device/tracking.hpp"
#include "dotpose/code.hpp"

namespace dotpose::core {

/// Half-widths of the squares in which dots are read, in px. A square with half-width n has 2 n + 1
/// px per side. The square with half-width kHalf_px is centred on an intersection. At spacings of 7
/// to 14 px, it contains the dot regardless of its symbol. If the displacement of the dots is
/// small, symbols are read in the square with half-width kSmallHalf_px instead, because a smaller
/// square allows reading dots closer to the image border. The square with half-width kDotHalf_px is
/// centred on the dot itself.
inline constexpr int kHalf_px = 4;
inline constexpr int kSmallHalf_px = 3;
inline constexpr int kDotHalf_px = 2;

/// Sets the half-width of the square in which symbols are read.
void set_half_side(int half_px, Tracking& tracking);

/// Returns the pixel nearest to an image point.
constexpr FixedVec pixel_at(FixedVec place_q16) {
    return {(place_q16.x + 32768) >> 16, (place_q16.y + 32768) >> 16};
}

/// Returns true if all pixels of the square around `pixel` are stored. `half` is the half-width of
/// the square.
[[gnu::always_inline]] inline bool is_kept(const Tracking& tracking, FixedVec pixel, int half) {
    return static_cast<unsigned>(pixel.x - half) <
               static_cast<unsigned>(tracking.width_px - 2 * half) &&
           static_cast<unsigned>(pixel.y - half - tracking.first_kept) <
               static_cast<unsigned>(tracking.rows_taken - tracking.first_kept - 2 * half);
}

/// Returns the paper level around an intersection: the mean of the four corner pixels of the square
/// around it. No dot extends to these pixels. `at` points to the pixel that contains the
/// intersection.
[[gnu::always_inline]] inline std::int32_t paper_around(const Tracking& tracking,
                                                        const std::uint8_t* at) {
    const std::uint8_t* const top = at + tracking.corner_offset;
    const std::uint8_t* const bottom = top + tracking.corners_apart;
    const int side_px = 2 * tracking.half_side_px;
    return (top[0] + top[side_px] + bottom[0] + bottom[side_px]) >> 2;
}

/// Sets `Tracking::dot_pixels` to the offsets of the pixels that `read_symbol` reads. Also sets the
/// half-width of the square around an intersection, so that the square contains these pixels.
/// Returns false if any of these pixels is outside the square with half-width kHalf_px.
bool lay_dot_pixels(Tracking& tracking);

/// The symbol read at an intersection and the threshold of its dot, packed into one register.
class ReadSymbol {
  public:
    static constexpr ReadSymbol unclear() { return ReadSymbol(-1); }
    /// Constructs a clear result. Pixels darker than `level` (0 to 255) belong to the dot.
    constexpr ReadSymbol(int symbol, std::int32_t level) : bits_(level * 4 + symbol) {}

    /// Returns true if one of the four possible centres of the dot was clearly the darkest, and
    /// dark enough for a dot.
    bool is_clear() const { return bits_ >= 0; }
    int symbol() const { return bits_ & 3; }
    std::int32_t level() const { return bits_ >> 2; }

  private:
    constexpr explicit ReadSymbol(std::int32_t bits) : bits_(bits) {}
    std::int32_t bits_;
};

/// Reads the symbol of the dot at an intersection, by finding the darkest of the four possible
/// centres of the dot. The result is unclear if none of the centres is clearly the darkest and dark
/// enough for a dot. The square around the intersection must be stored, with a border of one pixel
/// around it. This function is not inlined, because small processors would otherwise not have
/// enough registers.
DOTPOSE_NOINLINE inline ReadSymbol read_symbol(const Tracking& tracking,
                                               const FixedVec& intersection_q16) {
    const std::int32_t stride = tracking.stride_px;
    const std::uint8_t* const at =
        kept_row(tracking, intersection_q16.y >> 16) + (intersection_q16.x >> 16);
    const int quarter = (intersection_q16.x >> 15 & 1) + (intersection_q16.y >> 14 & 2);
    const std::int16_t* offset = tracking.dot_pixels[static_cast<std::size_t>(quarter)].data();
    // `darkest` and `second` contain 4 * (sum of four pixels) + symbol, to keep each sum together
    // with its symbol.
    std::int32_t darkest = INT32_MAX;
    std::int32_t second = INT32_MAX;
#pragma GCC unroll 4
    for (int s = 0; s < 4; ++s) {
        const std::uint8_t* const above = at + *offset++;
        const std::uint8_t* const below = above + stride;
        const std::int32_t sum = above[0] + above[1] + below[0] + below[1];
        const std::int32_t here = sum * 4 + s;
        if (here < darkest) {
            second = darkest;
            darkest = here;
        } else if (here < second) {
            second = here;
        }
    }
    const std::int32_t paper = paper_around(tracking, at);
    const std::int32_t depth = (paper * tracking.cut_q8) >> 8;
    // `depth` is the minimum contrast of a single dark pixel, whereas each sum covers four pixels.
    // The symbol is clear if the darkest sum is at least 2 `depth` below the sum of four paper
    // pixels, and at least `depth` below the other three sums. The expected differences are about
    // 6 `depth` and 4 `depth`, because a dot reduces the sums at adjacent centres by about
    // 2 `depth`.
    const bool is_clear =
        paper * 4 - (darkest >> 2) >= 2 * depth && (second >> 2) - (darkest >> 2) >= depth;
    return is_clear ? ReadSymbol(darkest & 3, paper - depth) : ReadSymbol::unclear();
}

struct NearDot {
    /// Offset of the centroid from the point around which the dot was measured, in 2^-8 px.
    FixedVec offset_q8;
    std::int32_t mass = 0;
};

/// Measures the centroid of the pixels darker than `level` in a square around an image point. The
/// square has 2 Half + 1 px per side. Returns false if any pixel of the square is not stored, or if
/// the mass is not between Tracking::min_mass and Tracking::max_mass.
template <int Half>
[[gnu::always_inline]] inline bool measure_square(const Tracking& tracking, FixedVec place_q16,
                                                  std::int32_t level, NearDot& dot) {
    const FixedVec pixel = pixel_at(place_q16);
    if (!is_kept(tracking, pixel, Half)) return false;
    const std::uint8_t* const first = kept_row(tracking, pixel.y - Half) + pixel.x - Half;
    const DarkSums sums = dark_sums<Half>(first, tracking.stride_px, level);
    if (sums.mass < tracking.min_mass || sums.mass > tracking.max_mass) return false;
    dot.mass = sums.mass;
    const Inverse inverse(sums.mass);
    dot.offset_q8 = {inverse.quotient_q8(sums.x) + pixel.x * 256 - (place_q16.x >> 8),
                     inverse.quotient_q8(sums.y) + pixel.y * 256 - (place_q16.y >> 8)};
    return true;
}

/// Measures the dot in the square with half-width kHalf_px around an intersection, with the
/// threshold `Tracking::cut_q8`. Returns false if `measure_square` returns false or if the paper
/// level is 0.
bool measure_around(const Tracking& tracking, FixedVec intersection_q16, NearDot& dot);

}  // namespace dotpose::core
