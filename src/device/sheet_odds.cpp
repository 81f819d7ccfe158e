#include "device/sheet_odds.hpp"

#include <algorithm>

#include "core/integrity/confidence.hpp"

namespace dotpose::core {
namespace {

int number_of_bits(const HardLines& lines) {
    int bits = 0;
    for (int i = 0; i < lines.count; ++i)
        bits += bits_in(lines[i].seen);
    return bits;
}

/// Returns an upper bound on log2(n) in units of 2^-8, for any n > 0.
int log2_of_places_q8(std::uint64_t n) {
    int halvings = 0;
    for (; n >= 1U << 24; ++halvings)
        n = n / 2 + 1;
    return log2_at_most_q8(static_cast<std::uint32_t>(n)) + 256 * halvings;
}

/// Consecutive lines along one axis, at a place in the code. `position` is the position of the
/// first line.
struct PlacedLines {
    HardLines lines;
    std::uint32_t position;
    std::uint32_t section;
    int wrong;  ///< number of bits that disagree with the code
};

/// Returns the difference between the roll of a line and its roll in section 0, modulo 63. The
/// difference is the same for all lines along an axis: the section of this axis plus the position
/// on the other axis.
std::uint32_t added_to_rolls(std::uint32_t section, std::uint32_t position_across) {
    return code::modulo_sections(section + code::modulo_sections(position_across));
}

/// Sums the odds of all alternatives to a given place. The alternatives are the other places on the
/// known sheets that have the same lines as the given place on one axis. Only the lines of the
/// other axis distinguish them from the given place.
class OddsOfOthers {
  public:
    OddsOfOthers(CodeVariant code, int odds_per_bit_q8)
        : code_(code),
          odds_per_bit_q8_(odds_per_bit_q8),
          max_lost_(kNegligible_q8 / odds_per_bit_q8) {}

    /// Adds the alternatives in one region. `same` contains the lines of the axis on which the
    /// alternatives agree with the given place, and `other` contains the lines of the other axis.
    /// `same_section` and `same_range` are the region's section and positions on the axis of
    /// `same`. `section` and `range` are its section and positions on the axis of `other`.
    void add(const PlacedLines& same, std::uint32_t same_section, const PositionRange& same_range,
             const PlacedLines& other, std::uint32_t section, const PositionRange& range) {
        if (!same_range.contains(same.position)) return;
        const bool is_same_section = same_section == same.section && section == other.section;
        const std::uint32_t wanted_class = code::modulo_sections(
            added_to_rolls(same.section, other.position) + kSections - same_section);
        const std::uint32_t first_class = code::modulo_sections(range.first);
        const std::uint32_t added = added_to_rolls(section, same.position);
        std::uint32_t i = code::modulo_sections(wanted_class + kSections - first_class);
        code::RollsAhead rolls(code_, range.first + i);
        for (; i < range.count; i += kSections, rolls.advance()) {
            const std::uint32_t position = range.first + i;
            if (is_same_section && position == other.position) continue;
            // Stops counting wrong bits once the odds are negligible. Missing some wrong bits can
            // only increase the computed odds, so the sum remains an upper bound.
            const int lost =
                other.lines.wrong_at(rolls, added, other.wrong + max_lost_) - other.wrong;
            log2_q8_ = add_log2(log2_q8_, -lost * odds_per_bit_q8_);
        }
    }
    int log2_q8() const { return log2_q8_; }

  private:
    /// Odds below 2^-48 are negligible.
    static constexpr int kNegligible_q8 = 48 * 256;
    CodeVariant code_;
    int odds_per_bit_q8_;
    int max_lost_;  ///< odds are negligible if more than this number of additional bits are wrong
    int log2_q8_ = kNever_q8;
};

/// Returns the number of places that may be in view, as log2 in units of 2^-8. Each orientation of
/// the block counts separately, and places at which the block extends beyond a region are included.
/// The number is at least 2^10, because a tracked attempt tests a single place but chooses among up
/// to 2^10 planes.
int trials_log2_q8(const KnownSheets& sheets, CodeVariant code, int columns, int rows) {
    std::uint64_t places = 0;
    for (const KnownRegion& region : sheets.regions) {
        if (region.code != code) continue;
        places += std::uint64_t{PositionRange(region.first.x, region.columns, columns).count} *
                  PositionRange(region.first.y, region.rows, rows).count;
    }
    return log2_of_places_q8(std::max<std::uint64_t>(4 * places, 1024));
}

/// Returns an upper bound on the probability that an unknown sheet matches by accident, as log2 in
/// units of 2^-8. An accidental match has the columns or the rows of a known sheet, and agrees with
/// the bits on the other axis by chance. On the other axis, only one position in 63 is possible,
/// because the rolls of the matching lines determine this position modulo 63.
int unknown_sheet_log2_q8(const KnownSheets& sheets, CodeVariant code, const PlacedLines& x,
                          const PlacedLines& y, int bits, int odds_per_bit_q8) {
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    for (const KnownRegion& region : sheets.regions) {
        if (region.code != code) continue;
        columns +=
            PositionRange(region.first.x, region.columns, x.lines.count).count / kSections + 1;
        rows += PositionRange(region.first.y, region.rows, y.lines.count).count / kSections + 1;
    }
    const auto of_axis_q8 = [&](std::uint32_t positions, int wrong) {
        return log2_of_places_q8(positions) +
               agreement_log2_q8(Confidence::of_hard_bits(bits, wrong), odds_per_bit_q8);
    };
    return add_log2(of_axis_q8(columns, x.wrong), of_axis_q8(rows, y.wrong));
}

}  // namespace

int max_wrong_bits(const KnownSheets& sheets, CodeVariant code, int dots, int lines,
                   const IntegrityOptions& options) {
    // Maximum number of wrong bits to test. If a place with this number of wrong bits can still be
    // certain, the view is large. The function then returns the total number of bits, so no place
    // is excluded.
    constexpr int kMaxTested = 8;
    const int trials_q8 = trials_log2_q8(sheets, code, lines, lines);
    for (int wrong = 0; wrong <= std::min(kMaxTested, 2 * dots); ++wrong) {
        const Confidence both = Confidence::of_hard_bits(2 * dots, wrong);
        const int chance_q8 =
            trials_q8 + agreement_log2_q8(both, odds_per_bit_q8(both, options.bits_per_error));
        if (chance_q8 > 256 * options.max_p_wrong_log2) return wrong - 1;
    }
    return 2 * dots;
}

bool is_certain_place(const KnownSheets& sheets, CodeVariant code, const HardLines& columns,
                      const HardLines& rows, const Place& corner, const IntegrityOptions& options,
                      Fix& fix) {
    const int bits = number_of_bits(columns);
    if (bits == 0 || !sheets.show(code, corner, columns.count, rows.count)) return false;
    PlacedLines x{columns, corner.cell.x, corner.section.u, 0};
    PlacedLines y{rows, corner.cell.y, corner.section.v, 0};
    x.wrong = columns.wrong_at(code, x.position, added_to_rolls(x.section, y.position), bits);
    y.wrong = rows.wrong_at(code, y.position, added_to_rolls(y.section, x.position), bits);
    fix.bit_errors = x.wrong + y.wrong;
    if (256 * std::max(x.wrong, y.wrong) > bits * options.max_bit_error_q8) return false;
    const Confidence both = Confidence::of_hard_bits(2 * bits, fix.bit_errors);
    const int odds_q8 = odds_per_bit_q8(both, options.bits_per_error);
    if (odds_q8 == 0) return false;

    OddsOfOthers others(code, odds_q8);
    for (const KnownRegion& region : sheets.regions) {
        if (region.code != code) continue;
        const PositionRange of_x(region.first.x, region.columns, columns.count);
        const PositionRange of_y(region.first.y, region.rows, rows.count);
        others.add(x, region.section.u, of_x, y, region.section.v, of_y);
        others.add(y, region.section.v, of_y, x, region.section.u, of_x);
    }
    const int chance_q8 =
        trials_log2_q8(sheets, code, columns.count, rows.count) + agreement_log2_q8(both, odds_q8);
    int sum_q8 = add_log2(others.log2_q8(), chance_q8);
    if (!sheets.are_all())
        sum_q8 = add_log2(sum_q8, unknown_sheet_log2_q8(sheets, code, x, y, bits, odds_q8));
    fix.p_wrong_log2 = std::min((sum_q8 + 255) >> 8, 0);
    if (fix.p_wrong_log2 > options.max_p_wrong_log2) return false;
    fix.prior = sheets.are_all() ? Prior::only_sheets : Prior::sheets;
    return true;
}

}  // namespace dotpose::core
