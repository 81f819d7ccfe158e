#include "core/integrity/codes_in_view.hpp"

#include "code/rolls.hpp"

namespace dotpose::core {
namespace {

/// If the odds of another code are below these limits, they are negligible and are not recomputed
/// from all bits in the block. kMaxOddsHere applies to the place of the reading in the other code,
/// and kMaxOddsElsewhere to the sum over all other places.
constexpr float kMaxOddsHere = 1e-12F;
constexpr float kMaxOddsElsewhere = 1e-10F;

/// Returns true if two codes have different rolls in any of the BitBlock::kSide lines that start at
/// `position`.
bool differ_from(std::uint32_t position, CodeVariant read, CodeVariant other) {
    std::array<std::uint8_t, BitBlock::kSide> own;
    std::array<std::uint8_t, BitBlock::kSide> theirs;
    code::follow_rolls(read, position, roll(read, position), own);
    code::follow_rolls(other, position, roll(other, position), theirs);
    return own != theirs;
}

/// Returns true if the odds of the other codes may change when all bits in the block are used. This
/// is the case if
/// - the odds of other places in another code are not negligible, or
/// - the block has lines that the certainty test did not use, and a code that is not ruled out has
///   different rolls in the block.
bool may_change_odds(CodeVariant read, const Place& place, bool has_more_lines,
                     const OtherCodes& others) {
    const auto have_other_rolls = [&](CodeVariant other) {
        const Place corner = moved(read, place, -BitBlock::kMiddle, -BitBlock::kMiddle);
        return differ_from(corner.cell.x, read, other) || differ_from(corner.cell.y, read, other);
    };
    for (std::size_t i = 0; i < others.of.size(); ++i) {
        const auto other = static_cast<CodeVariant>(i);
        if (other == read) continue;
        if (others.of[i].elsewhere() > kMaxOddsElsewhere) return true;
        if (!has_more_lines || others.of[i].here() < kMaxOddsHere) continue;
        if (have_other_rolls(other)) return true;
    }
    return false;
}

}  // namespace

void weigh_codes_in_view(const Kernels& kernels, CodeVariant read, const Place& place,
                         const BitBlock& block, const std::array<Confidence, 2>& bits,
                         bool has_more_lines, std::span<ScoredLine> storage, OtherCodes& others) {
    if (!may_change_odds(read, place, has_more_lines, others)) return;
    weigh_other_codes(kernels, evidence_of(kernels, read, place, block, bits, storage), read,
                      others);
}

}  // namespace dotpose::core
