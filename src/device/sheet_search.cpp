#include "device/sheet_search.hpp"

#include <algorithm>

#include "code/rolls.hpp"
#include "core/known_sheets.hpp"

namespace dotpose::core {
namespace {

constexpr int kTurns = 4;
/// Maximum number of pairs of lines that the search tries on each axis. The pairs are disjoint, so
/// a wrong bit affects at most one pair.
constexpr int kMaxPairs = 3;

/// The rolls at which all bits of a line agree with the main sequence. Empty if there are more than
/// four such rolls, because the line then has too few bits. If a line has six consecutive bits,
/// there is at most one such roll.
class AgreeingRolls {
  public:
    AgreeingRolls() = default;
    explicit AgreeingRolls(const HardLine& line) {
        for (std::size_t roll = 0; roll < kSections; ++roll) {
            if (((code::kMainWords[roll] ^ line.bits) & line.seen) != 0) continue;
            if (count_ == rolls_.size()) {
                // The line has too few bits to restrict the roll.
                count_ = 0;
                return;
            }
            rolls_[count_++] = static_cast<std::uint8_t>(roll);
        }
    }
    const std::uint8_t* begin() const { return rolls_.data(); }
    const std::uint8_t* end() const { return rolls_.data() + count_; }

  private:
    std::array<std::uint8_t, 4> rolls_{};
    std::size_t count_ = 0;
};

std::uint32_t difference(std::uint32_t a, std::uint32_t b) {
    return a >= b ? a - b : a + kSections - b;
}

/// A pair of adjacent lines along an axis, in one orientation of the block.
struct LinePair {
    int line = 0;  ///< index of the first line
    AgreeingRolls first;
    AgreeingRolls second;
};

/// Returns the first line of the best pair of adjacent lines. Pairs are ranked by the number of
/// bits in the line with fewer bits. Skips pairs with a line in the bit set `tried`, and adds both
/// lines of the result to this set. Returns nullopt if no remaining pair has bits in both lines.
std::optional<int> longest_pair(const HardLines& lines, std::uint32_t& tried) {
    std::optional<int> longest;
    int max_bits = 0;
    for (int line = 0; line + 1 < lines.count; ++line) {
        if ((tried >> line & 3) != 0) continue;
        const int bits = std::min(bits_in(lines[line].seen), bits_in(lines[line + 1].seen));
        if (bits <= max_bits) continue;
        max_bits = bits;
        longest = line;
    }
    if (longest) tried |= std::uint32_t{3} << *longest;
    return longest;
}

/// Pairs of lines along one axis, one pair for each orientation of the block.
class PairsOfLines {
  public:
    explicit PairsOfLines(Axis axis) : axis_(axis) {}

    void take_next(const HardBlock& block) {
        turns_ = {};
        for (int quarters = 0; quarters < kTurns; ++quarters) {
            const HardLines lines = block.lines(axis_, quarters);
            const auto turn = static_cast<std::size_t>(quarters);
            const auto line = longest_pair(lines, tried_[turn]);
            if (!line) continue;
            pairs_[turn] = {*line, AgreeingRolls(lines[*line]), AgreeingRolls(lines[*line + 1])};
            for (const std::uint32_t first : pairs_[turn].first) {
                for (const std::uint32_t second : pairs_[turn].second)
                    turns_[difference(second, first)] |= static_cast<std::uint8_t>(1 << quarters);
            }
        }
    }
    Axis axis() const { return axis_; }
    /// Returns a bit set of the orientations in which an agreeing roll of the second line exceeds
    /// an agreeing roll of the first line by `step`, modulo 63.
    unsigned turns_with(std::uint32_t step) const { return turns_[step]; }
    const LinePair& operator[](int quarters) const {
        return pairs_[static_cast<std::size_t>(quarters)];
    }

  private:
    Axis axis_;
    std::array<std::uint8_t, kSections> turns_{};
    std::array<std::uint32_t, kTurns> tried_{};  ///< lines of earlier pairs, as bit sets
    std::array<LinePair, kTurns> pairs_{};
};

/// The range of positions that a region covers on one axis, and the section of the region on this
/// axis.
struct RegionAxis {
    std::uint32_t first;
    std::uint32_t size;
    std::uint32_t section;

    RegionAxis(const KnownRegion& region, Axis axis)
        : first(axis == Axis::x ? region.first.x : region.first.y),
          size(axis == Axis::x ? region.columns : region.rows),
          section(axis == Axis::x ? region.section.u : region.section.v) {}
};

/// Rolls, in section 0, of the lines at consecutive positions on an axis.
struct Rolls {
    std::uint32_t first;
    std::array<std::uint8_t, 128> all;

    const std::uint8_t* at(std::uint32_t position) const { return &all[position - first]; }
};

class SheetSearch {
  public:
    SheetSearch(const HardBlock& block, CodeVariant code, int max_wrong)
        : block_(block), code_(code), max_wrong_(max_wrong) {}

    /// Tests each place in a region at which all bits of a pair of lines agree with the code.
    void search(const KnownRegion& region, const PairsOfLines& pairs);

    const std::optional<SheetPlace>& best() const { return best_; }

  private:
    /// Tests the places at which the first line of a pair is at `position` and all bits of the pair
    /// agree with the code. `step` is the roll of the second line minus the roll of the first line.
    void test_pair(const KnownRegion& region, const PairsOfLines& pairs, int quarters,
                   const Rolls& rolls, std::uint32_t position, std::uint32_t step);
    /// Tests the places at which the first line of `axis` is at `position`. `wrong` is the number
    /// of bits along this axis that disagree with the code. The roll of each line along this axis
    /// is its roll in section 0 plus `added`, modulo 63.
    void test_crossing(const KnownRegion& region, Axis axis, int quarters, std::uint32_t position,
                       std::uint32_t added, int wrong);

    const HardBlock& block_;
    CodeVariant code_;
    /// Maximum number of wrong bits, summed over both axes. Once a place has been found, the
    /// maximum is one less than the number of wrong bits at this place.
    int max_wrong_;
    std::optional<SheetPlace> best_;
};

void SheetSearch::search(const KnownRegion& region, const PairsOfLines& pairs) {
    const RegionAxis along(region, pairs.axis());
    const auto margin = static_cast<std::uint32_t>(
        std::max(block_.lines(pairs.axis(), 0).count, block_.lines(pairs.axis(), 1).count));
    // Range of positions of the pair's first line at which the block may overlap the region.
    const std::uint32_t begin = along.first < margin ? 0 : along.first - margin;
    const std::uint32_t end = along.first + along.size + margin;
    Rolls rolls;
    for (std::uint32_t position = begin; position < end;) {
        rolls.first = position < margin ? 0 : position - margin;
        code::follow_rolls(code_, rolls.first, dotpose::roll(code_, rolls.first), rolls.all);
        const auto size = static_cast<std::uint32_t>(rolls.all.size());
        const std::uint32_t chunk_end = std::min(end, rolls.first + size - margin);
        const std::uint8_t* roll = rolls.at(position);
        for (; position < chunk_end; ++position, ++roll) {
            const std::uint32_t step = difference(roll[1], roll[0]);
            unsigned turns = pairs.turns_with(step);
            for (int quarters = 0; turns != 0; ++quarters, turns >>= 1) {
                if ((turns & 1) != 0) test_pair(region, pairs, quarters, rolls, position, step);
            }
        }
    }
}

void SheetSearch::test_pair(const KnownRegion& region, const PairsOfLines& pairs, int quarters,
                            const Rolls& rolls, std::uint32_t position, std::uint32_t step) {
    const LinePair& pair = pairs[quarters];
    const auto ahead = static_cast<std::uint32_t>(pair.line);
    if (position < ahead) return;
    const HardLines lines = block_.lines(pairs.axis(), quarters);
    const std::uint8_t* const first_roll = rolls.at(position - ahead);
    for (const std::uint32_t first : pair.first) {
        for (const std::uint32_t second : pair.second) {
            if (difference(second, first) != step) continue;
            const std::uint32_t added = difference(first, *rolls.at(position));
            const int wrong = lines.wrong_with(first_roll, added, max_wrong_);
            if (wrong <= max_wrong_)
                test_crossing(region, pairs.axis(), quarters, position - ahead, added, wrong);
        }
    }
}

void SheetSearch::test_crossing(const KnownRegion& region, Axis axis, int quarters,
                                std::uint32_t position, std::uint32_t added, int wrong) {
    const Axis other = axis == Axis::x ? Axis::y : Axis::x;
    const RegionAxis along(region, axis);
    const RegionAxis across(region, other);
    const HardLines crossing = block_.lines(other, quarters);
    if (!PositionRange(along.first, along.size, block_.lines(axis, quarters).count)
             .contains(position))
        return;
    // `added` is the section plus the position on the other axis, modulo 63. All positions in a
    // region have the same section, so `added` determines the position on the other axis modulo 63,
    // and only every 63rd position is tested.
    const PositionRange range(across.first, across.size, crossing.count);
    const std::uint32_t first_class = code::modulo_sections(range.first);
    const std::uint32_t wanted_class = difference(added, along.section);
    const std::uint32_t added_across =
        code::modulo_sections(across.section + code::modulo_sections(position));
    for (std::uint32_t i = difference(wanted_class, first_class); i < range.count; i += kSections) {
        const std::uint32_t position_across = range.first + i;
        const int limit = max_wrong_ - wrong;
        const int wrong_across = crossing.wrong_at(code_, position_across, added_across, limit);
        if (wrong_across > limit) continue;
        max_wrong_ = wrong + wrong_across - 1;
        best_ = axis == Axis::x ? SheetPlace{quarters,
                                             {{position, position_across}, region.section},
                                             {wrong, wrong_across}}
                                : SheetPlace{quarters,
                                             {{position_across, position}, region.section},
                                             {wrong_across, wrong}};
    }
}

}  // namespace

std::optional<SheetPlace> find_on_sheets(const HardBlock& block, CodeVariant code,
                                         std::span<const KnownRegion> regions, int max_wrong) {
    if (max_wrong < 0) return {};
    SheetSearch search(block, code, max_wrong);
    std::array pairs{PairsOfLines(Axis::x), PairsOfLines(Axis::y)};
    for (int round = 0; round < kMaxPairs; ++round) {
        for (PairsOfLines& of_axis : pairs) {
            of_axis.take_next(block);
            for (const KnownRegion& region : regions) {
                if (region.code == code) search.search(region, of_axis);
            }
            if (search.best()) return search.best();
        }
    }
    return {};
}

}  // namespace dotpose::core
