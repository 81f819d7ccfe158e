#include "locate/earlier_bits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/integrity/known_lines.hpp"
#include "core/math/exponential.hpp"
#include "locate/after_motion.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::joined;

constexpr float kPi = std::numbers::pi_v<float>;

/// Shifts a word by `by` cells towards higher bits, or towards lower bits if `by` is negative.
std::uint64_t shifted(std::uint64_t word, int by) {
    if (std::abs(by) >= BitBlock::kSide) return 0;
    return by >= 0 ? word << by : word >> -by;
}

/// Returns the lines, shifted by `across` lines and by `along` cells within each line.
BitLines shifted(const BitLines& lines, int across, int along) {
    BitLines result;
    for (int line = std::max(0, across); line < BitBlock::kSide + std::min(0, across); ++line) {
        const auto to = static_cast<std::size_t>(line);
        const auto from = static_cast<std::size_t>(line - across);
        result.valid[to] = shifted(lines.valid[from], along);
        result.bits[to] = shifted(lines.bits[from], along);
    }
    return result;
}

BitBlock shifted(const BitBlock& block, FixedVec by) {
    return {shifted(block.columns, by.x, by.y), shifted(block.rows, by.y, by.x)};
}

/// Comparison of the bits in the cells where two blocks overlap.
struct Overlap {
    int shared = 0;     ///< number of bits that both blocks contain
    int different = 0;  ///< number of shared bits that differ between the blocks
};

void count_overlap(const BitLines& a, const BitLines& b, int across, int along, Overlap& overlap) {
    for (int line = std::max(0, across); line < BitBlock::kSide + std::min(0, across); ++line) {
        const auto to = static_cast<std::size_t>(line);
        const auto from = static_cast<std::size_t>(line - across);
        const std::uint64_t both = a.valid[to] & shifted(b.valid[from], along);
        overlap.shared += std::popcount(both);
        overlap.different += std::popcount(both & (a.bits[to] ^ shifted(b.bits[from], along)));
    }
}

/// Returns log2 of the likelihood ratio of the overlapping bits: their likelihood if both blocks
/// show the same cells, divided by their likelihood if the blocks show unrelated parts of the
/// pattern.
float log2_ratio(const Overlap& overlap) {
    return tuned::kEqualBit_log2 * static_cast<float>(overlap.shared - overlap.different) +
           tuned::kDifferentBit_log2 * static_cast<float>(overlap.different);
}

/// Adds the cells of `more` to a block. Drops a cell if its x bits or its y bits differ between the
/// blocks.
void add_cells(const BitBlock& more, BitBlock& block) {
    std::array<std::uint64_t, BitBlock::kSide> contradicted{};  // by column
    for (std::size_t i = 0; i < BitBlock::kSide; ++i) {
        contradicted[i] |= block.columns.valid[i] & more.columns.valid[i] &
                           (block.columns.bits[i] ^ more.columns.bits[i]);
        std::uint64_t in_row =
            block.rows.valid[i] & more.rows.valid[i] & (block.rows.bits[i] ^ more.rows.bits[i]);
        for (; in_row != 0; in_row &= in_row - 1)
            contradicted[static_cast<std::size_t>(std::countr_zero(in_row))] |= std::uint64_t{1}
                                                                                << i;
    }
    const auto add = [](const BitLines& from, BitLines& to) {
        for (std::size_t i = 0; i < to.valid.size(); ++i) {
            to.bits[i] |= from.bits[i] & ~to.valid[i];
            to.valid[i] |= from.valid[i];
        }
    };
    add(more.columns, block.columns);
    add(more.rows, block.rows);
    for (std::size_t column = 0; column < BitBlock::kSide; ++column) {
        block.columns.valid[column] &= ~contradicted[column];
        for (std::uint64_t cells = contradicted[column]; cells != 0; cells &= cells - 1)
            block.rows.valid[static_cast<std::size_t>(std::countr_zero(cells))] &=
                ~(std::uint64_t{1} << column);
    }
    const auto clear = [](BitLines& lines) {
        for (std::size_t i = 0; i < lines.valid.size(); ++i)
            lines.bits[i] &= lines.valid[i];
    };
    clear(block.columns);
    clear(block.rows);
}

/// Returns the angle of the image x axis in the grid, in rad.
float angle_of(const FloatPlane& grid_from_image) {
    return std::atan2(grid_from_image.du_y, grid_from_image.du_x);
}

float power_of_two(float exponent) {
    return natural_exp(std::numbers::ln2_v<float> * exponent);
}

/// The most likely match between two grids, and the summed weight of all possible matches. The
/// weight of a match is the product of its likelihood ratio (see `log2_ratio`) and the probability
/// density of its angle and shift, given the measured motion. The density is relative to its
/// maximum.
struct Match {
    int quarters = 0;
    /// Shift from the earlier grid, after rotation by `quarters`, to the current grid, in cells.
    FixedVec shift;
    float best_log2 = -1e9F;
    float sum = 0;  ///< summed weight, relative to the best weight

    void add(float weight_log2, int at_quarters, FixedVec at_shift) {
        if (weight_log2 <= best_log2) {
            sum += power_of_two(weight_log2 - best_log2);
            return;
        }
        sum = 1 + sum * power_of_two(best_log2 - weight_log2);
        best_log2 = weight_log2;
        quarters = at_quarters;
        shift = at_shift;
    }
    /// Returns an upper bound on the probability of a wrong match: the summed weight of all other
    /// matches and of a blunder, relative to the best weight. A blunder is a measured motion whose
    /// error is far larger than its standard deviation. `blunder_log2` is log2 of the weight of a
    /// blunder.
    float p_wrong(float blunder_log2) const {
        return std::max(sum - 1, 0.0F) + power_of_two(std::min(blunder_log2 - best_log2, 99.0F));
    }
};

/// Returns log2 of a normal density at `distance` from the mean, relative to the maximum of the
/// density.
float normal_log2(float distance, float variance) {
    return -0.5F * std::numbers::log2e_v<float> * distance * distance / variance;
}

/// Expected shift between two grids, in cells, with its variance along each axis.
struct ExpectedShift {
    FloatVec by;
    float variance = 0;
};

/// Adds the possible matches between `now` and `earlier`, which has been turned by `quarters`
/// quarter turns. `turn_log2` is log2 of the weight of this turn.
void add_matches(const BitBlock& now, const BitBlock& earlier, const ExpectedShift& expected,
                 int quarters, float turn_log2, Match& match) {
    const float reach =
        std::min(tuned::kReach_sigmas * std::sqrt(expected.variance), tuned::kMaxReach);
    const auto first = [&](float at) { return static_cast<int>(std::ceil(at - reach)); };
    const auto last = [&](float at) { return static_cast<int>(std::floor(at + reach)); };
    for (int y = first(expected.by.y); y <= last(expected.by.y); ++y) {
        for (int x = first(expected.by.x); x <= last(expected.by.x); ++x) {
            Overlap overlap;
            count_overlap(now.columns, earlier.columns, x, y, overlap);
            count_overlap(now.rows, earlier.rows, y, x, overlap);
            const float off_x = static_cast<float>(x) - expected.by.x;
            const float off_y = static_cast<float>(y) - expected.by.y;
            match.add(turn_log2 + log2_ratio(overlap) + normal_log2(off_x, expected.variance) +
                          normal_log2(off_y, expected.variance),
                      quarters, {x, y});
        }
    }
}

}  // namespace

void EarlierBits::clear() {
    is_in_frame_ = is_joining = false;
    earlier_.frames = current_.frames = 0;
    motion_ = {};
}

void EarlierBits::begin_frame(const MeasuredMotion& motion, const DeviceOptions& options) {
    is_in_frame_ = true;
    is_joining = is_confirmed_ = false;
    current_.frames = current_.bits = 0;
    spacing_mm_ = spacing_mm(options);
    reference_px_ = {static_cast<float>(options.reference_dx_q8) / 256,
                     static_cast<float>(options.reference_dy_q8) / 256};
    max_p_mismatch_log2_ = options.integrity.max_p_wrong_log2 - 1;
    motion_ = followed_by(motion_, motion);
}

void EarlierBits::end_frame() {
    if (current_.frames > 0) {
        const auto joined = join(current_.block, current_.grid_from_image);
        if (joined) {
            current_.block = joined->block;
            current_.frames = joined->frames;
        }
        earlier_ = current_;
        motion_ = {};
    }
    is_in_frame_ = is_joining = false;
}

void EarlierBits::note(const BitBlock& block, const FloatPlane& grid_from_image,
                       bool is_confirmed) {
    const int bits = number_of_bits(block.columns) + number_of_bits(block.rows);
    if (!is_confirmed && (is_confirmed_ || bits <= current_.bits)) return;
    current_ = {block, grid_from_image, bits, 1};
    is_confirmed_ = is_confirmed;
}

std::optional<JoinedBits> EarlierBits::join(const BitBlock& block,
                                            const FloatPlane& grid_from_image) const {
    if (!has_earlier()) return {};
    const float variance_rad2 =
        motion_.sigma_rad * motion_.sigma_rad + tuned::kGridAngle_rad * tuned::kGridAngle_rad;
    const float sigma = motion_.sigma_mm / spacing_mm_;
    const FloatVec reference = plane_point(grid_from_image, reference_px_);
    Match match;
    for (int quarters = 0; quarters < kTurns; ++quarters) {
        const FloatPlane before = turned(quarters, earlier_.grid_from_image);
        const float off_rad = std::remainder(
            angle_of(grid_from_image) - angle_of(before) - motion_.turn_rad, 2 * kPi);
        if (std::abs(off_rad) > tuned::kReach_sigmas * std::sqrt(variance_rad2)) continue;
        // Point in the earlier image that corresponds to the reference point in the current image,
        // that is, to the same point on the paper.
        const float scale = spacing_px(before) / spacing_mm_;
        const FloatVec reached{reference_px_.x + scale * motion_.right_mm,
                               reference_px_.y + scale * motion_.down_mm};
        const FloatVec there = plane_point(before, reached);
        const FloatVec shift{reference.x - there.x, reference.y - there.y};
        if (!(std::max(std::abs(shift.x), std::abs(shift.y)) < BitBlock::kSide)) continue;
        add_matches(block, turned(quarters, earlier_.block),
                    {shift, sigma * sigma + tuned::kGridPhase * tuned::kGridPhase}, quarters,
                    normal_log2(off_rad, variance_rad2), match);
    }
    const float p_wrong = match.p_wrong(tuned::kBlunder_log2);
    int p_mismatch_log2 = 0;
    std::frexp(p_wrong, &p_mismatch_log2);  // p_wrong < 2^p_mismatch_log2
    if (p_mismatch_log2 > max_p_mismatch_log2_) return {};
    JoinedBits joined{block, earlier_.frames + 1, p_mismatch_log2};
    add_cells(shifted(turned(match.quarters, earlier_.block), match.shift), joined.block);
    return joined;
}

}  // namespace dotpose::core
