#include "device/sheet_search.hpp"

#include <algorithm>

#include "code/rolls.hpp"
#include "core/known_sheets.hpp"

namespace dotpose::core {
namespace {

constexpr int kTurns = 4;
/// Maximum number of pairs of lines, on each axis, that are tried. Pairs are disjoint, so a bit
/// error spoils only one pair. The second and the third pair are rarely needed.
constexpr int kMaxPairs = 3;

/// The rolls at which all bits of a line agree with the main sequence: one roll for a line of at
/// least six bits in a row without error.
class AgreeingRolls {
  public:
    explicit AgreeingRolls(const HardLine& line) {
        for (std::size_t roll = 0; roll < kSections; ++roll) {
            if (((code::kMainWords[roll] ^ line.bits) & line.seen) != 0) continue;
            if (count_ == rolls_.size()) {
                // The line has too few bits to be useful.
                count_ = 0;
                return;
            }
            rolls_[count_++] = static_cast<std::uint8_t>(roll);
        }
    }
    const std::uint8_t* begin() const { return rolls_.data(); }
    const std::uint8_t* end() const { return rolls_.data() + count_; }

  private:
    std::array<std::uint8_t, 8> rolls_;
    std::size_t count_ = 0;
};

std::uint32_t difference(std::uint32_t a, std::uint32_t b) {
    return a >= b ? a - b : a + kSections - b;
}

/// A pair of adjacent lines of an axis, in one orientation of the block.
struct LinePair {
    int line;  ///< index of the first line
    AgreeingRolls first;
    AgreeingRolls second;
};

/// Returns the first line of pair `rank` of `count` lines. Pair 0 is in the middle, where lines are
/// longest in rotated views. Returns -1 if there are not enough lines.
int line_of_pair(int rank, int count) {
    const int from_middle = (rank + 1) / 2 * 2;
    const int line = (count - 2) / 2 + (rank % 2 == 1 ? from_middle : -from_middle);
    return line >= 0 && line + 2 <= count ? line : -1;
}

/// The pairs of lines of one axis, in all orientations of the block.
class PairsOfLines {
  public:
    PairsOfLines(const HardBlock& block, Axis axis, int rank) {
        for (int quarters = 0; quarters < kTurns; ++quarters) {
            const HardLines lines = block.lines(axis, quarters);
            const int line = line_of_pair(rank, lines.count);
            auto& pair = pairs_[static_cast<std::size_t>(quarters)];
            if (line < 0) continue;
            pair = LinePair{line, AgreeingRolls(lines[line]), AgreeingRolls(lines[line + 1])};
            for (const std::uint32_t first : pair->first) {
                for (const std::uint32_t second : pair->second)
                    turns_[difference(second, first)] |= static_cast<std::uint8_t>(1 << quarters);
            }
        }
    }
    /// Returns the orientations in which some agreeing rolls of the two lines differ by `step`, as
    /// a bit set.
    unsigned turns_with(std::uint32_t step) const { return turns_[step]; }
    const LinePair& operator[](int quarters) const {
        return *pairs_[static_cast<std::size_t>(quarters)];
    }

  private:
    std::array<std::uint8_t, kSections> turns_{};
    std::array<std::optional<LinePair>, kTurns> pairs_;
};

/// The positions of one axis of a region, and the section of this axis.
struct RegionAxis {
    std::uint32_t first;
    std::uint32_t size;
    std::uint32_t section;

    RegionAxis(const KnownRegion& region, Axis axis)
        : first(axis == Axis::x ? region.first.x : region.first.y),
          size(axis == Axis::x ? region.columns : region.rows),
          section(axis == Axis::x ? region.section.u : region.section.v) {}
};

class SheetSearch {
  public:
    SheetSearch(const HardBlock& block, CodeVariant code, const IntegrityOptions& options)
        : block_(block),
          code_(code),
          max_wrong_(block.dots() * options.max_bit_error_q8 / 256),
          fewest_wrong_(2 * max_wrong_ + 1) {}

    /// Tests the places on a region at which all bits of a pair of lines agree.
    void search(const KnownRegion& region, Axis axis, const PairsOfLines& pairs);

    const std::optional<SheetPlace>& best() const { return best_; }

  private:
    /// Tests the places at which the first line of the pair is at `position` and has an agreeing
    /// roll. `roll` is the roll of the line in section 0, and `step` is the difference to the roll
    /// of the next line.
    void test_pair(const KnownRegion& region, Axis axis, int quarters, const LinePair& pair,
                   std::uint32_t position, std::uint32_t roll, std::uint32_t step);
    /// Tests the places at which the first line of the axis is at `position` and the roll of each
    /// line is its roll in section 0 plus `added`.
    void test_lines(const KnownRegion& region, Axis axis, int quarters, std::uint32_t position,
                    std::uint32_t added);

    const HardBlock& block_;
    CodeVariant code_;
    int max_wrong_;  ///< on each axis
    int fewest_wrong_;
    std::optional<SheetPlace> best_;
};

void SheetSearch::search(const KnownRegion& region, Axis axis, const PairsOfLines& pairs) {
    constexpr std::uint32_t kChunk = 64;
    std::array<std::uint8_t, kChunk + 1> rolls;
    const RegionAxis along(region, axis);
    // Positions of the first line of a pair, if any line of the block is on the region.
    const PositionRange around(along.first, along.size, kMaxComparedLines);
    const std::uint32_t end = around.first + around.count + kMaxComparedLines;
    for (std::uint32_t first = around.first; first < end; first += kChunk) {
        code::follow_rolls(code_, first, dotpose::roll(code_, first), rolls);
        for (std::uint32_t i = 0; i < kChunk; ++i) {
            const std::uint32_t step = difference(rolls[i + 1], rolls[i]);
            unsigned turns = pairs.turns_with(step);
            for (int quarters = 0; turns != 0; ++quarters, turns >>= 1) {
                if ((turns & 1) != 0)
                    test_pair(region, axis, quarters, pairs[quarters], first + i, rolls[i], step);
            }
        }
    }
}

void SheetSearch::test_pair(const KnownRegion& region, Axis axis, int quarters,
                            const LinePair& pair, std::uint32_t position, std::uint32_t roll,
                            std::uint32_t step) {
    const auto ahead = static_cast<std::uint32_t>(pair.line);
    if (position < ahead) return;
    for (const std::uint32_t first : pair.first) {
        for (const std::uint32_t second : pair.second) {
            if (difference(second, first) == step)
                test_lines(region, axis, quarters, position - ahead, difference(first, roll));
        }
    }
}

void SheetSearch::test_lines(const KnownRegion& region, Axis axis, int quarters,
                             std::uint32_t position, std::uint32_t added) {
    const Axis other = axis == Axis::x ? Axis::y : Axis::x;
    const RegionAxis along(region, axis);
    const RegionAxis across(region, other);
    const HardLines lines = block_.lines(axis, quarters);
    const HardLines crossing = block_.lines(other, quarters);
    if (!PositionRange(along.first, along.size, lines.count).contains(position)) return;
    const int wrong = lines.wrong_at(code_, position, added, max_wrong_);
    if (wrong > max_wrong_) return;
    // `added` is the section plus the position on the other axis, modulo 63.
    const PositionRange range(across.first, across.size, crossing.count);
    const std::uint32_t first_class = code::modulo_sections(range.first);
    const std::uint32_t wanted_class = difference(added, along.section);
    for (std::uint32_t i = difference(wanted_class, first_class); i < range.count; i += kSections) {
        const std::uint32_t position_across = range.first + i;
        const int limit = std::min(max_wrong_, fewest_wrong_ - wrong - 1);
        const int wrong_across = crossing.wrong_at(
            code_, position_across,
            code::modulo_sections(across.section + code::modulo_sections(position)), limit);
        if (wrong_across > limit) continue;
        fewest_wrong_ = wrong + wrong_across;
        best_ = axis == Axis::x
                    ? SheetPlace{quarters,
                                 {{position, position_across}, region.section},
                                 {wrong, wrong_across}}
                    : SheetPlace{quarters,
                                 {{position_across, position}, region.section},
                                 {wrong_across, wrong}};
    }
}

}  // namespace

std::optional<SheetPlace> find_on_sheets(const HardBlock& block, CodeVariant code,
                                         std::span<const KnownRegion> regions,
                                         const IntegrityOptions& options) {
    SheetSearch search(block, code, options);
    for (int rank = 0; rank < kMaxPairs; ++rank) {
        for (const Axis axis : {Axis::x, Axis::y}) {
            const PairsOfLines pairs(block, axis, rank);
            for (const KnownRegion& region : regions) {
                if (region.code == code) search.search(region, axis, pairs);
            }
            if (search.best()) return search.best();
        }
    }
    return {};
}

}  // namespace dotpose::core
