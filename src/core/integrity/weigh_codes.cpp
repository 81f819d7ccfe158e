#include "core/integrity/weigh_codes.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <span>

#include "code/rolls.hpp"
#include "code/unshared_codes.hpp"
#include "core/integrity/unshared_lines.hpp"

namespace dotpose::core {
namespace {

/// Index of a4, the only sequence in which the codes differ.
constexpr std::size_t kA4 = 3;
/// Upper bound on the odds of each skipped place, as log2 in units of 2^-8 and as a plain value.
constexpr int kSkippedOdds_q8 = -52 * 256;
constexpr float kSkippedOdds = 2.3e-16F;
/// Limit on the summed odds. If an upper bound on the sum is at most this limit, no tighter bound
/// is computed.
constexpr float kNegligibleOdds = 1e-12F;

/// Lower bounds on the losses of a place in another code. A place loses at least `of[line]` in each
/// line that it does not share with the reading.
struct Losses {
    explicit Losses(const LikelihoodRatios& ratios)
        : loss_limit(ratios.loss_for(kSkippedOdds_q8) + ratios.max_gain()) {
        for (int line = 0; line < ratios.count(); ++line) {
            const int min_loss = ratios.min_loss(line);
            const int eighths = std::max(min_loss, 0) / kUnit;
            of[static_cast<std::size_t>(line)] = static_cast<std::uint16_t>(eighths);
            all += eighths;
            at_best += min_loss;
        }
    }

    /// Returns the step losses in units of 1/`StepLosses::kLimitParts` of the loss limit, rounded
    /// down. A place whose step losses add up to at least kLimitParts units loses at least the
    /// limit.
    StepLosses of_steps(const LikelihoodRatios& ratios) const {
        StepLosses steps;
        steps.count = ratios.count() - 1;
        // Float division gives the same integers as integer division, because the quotients are
        // below 16 and are never rounded up to the next integer.
        const auto part = static_cast<float>((loss_limit + StepLosses::kLimitParts - 1) /
                                             StepLosses::kLimitParts);
        for (int step = 0; step < steps.count; ++step) {
            const int lost = std::min(ratios.min_loss_of_step(step), loss_limit);
            steps.parts[static_cast<std::size_t>(step)] =
                static_cast<std::uint8_t>(static_cast<float>(lost) / part);
        }
        return steps;
    }

    /// Returns true if a place certainly loses more than `loss_limit` at a shift. `shared` is the
    /// sum of `of` over the lines that the place shares at this shift, or an upper bound on this
    /// sum, in units of kUnit.
    bool exceed_limit(int shared) const { return kUnit * (all - shared) > loss_limit; }

    /// Unit of `all` and `of`, in score units. Losses are rounded down to this unit, because their
    /// sums must fit in 16 bits.
    static constexpr int kUnit = 8;
    int loss_limit;  ///< loss above which a place is skipped, in score units
    int all = 0;     ///< sum of `of` over all lines, in units of kUnit
    /// Minimum loss of a place at a shift where it shares no line, in score units. This is the sum
    /// of the minimum losses of all lines, including negative losses (gains).
    int at_best = 0;
    std::array<std::uint16_t, kMaxLines> of;  ///< loss of each line, in units of kUnit
};

/// Sums the odds of the places in one other code, along one axis. The *same place* is the place in
/// a4 of the other code with the same index as the place of the reading, at the shift
/// `shift_here_`. Every other combination of a place and a shift is an *other place*.
class OtherPlaces {
  public:
    OtherPlaces(const LikelihoodRatios& ratios, const Losses& losses, CodeVariant read,
                CodeVariant other)
        : ratios_(ratios),
          losses_(losses),
          count_(static_cast<std::size_t>(ratios.count())),
          theirs_(code::basis(other)[kA4]),
          shift_here_(code::roll_further(read, other, ratios.position, ratios.places[kA4])),
          here_(offsets_of(ratios.places[kA4])) {
        // Lines in which both codes have the same roll cause no loss.
        const int shared = modulo(here_[0] - shift_here_);
        int lost = 0;
        for (std::size_t line = 0; line < count_ && !ratios_.is_hopeless(lost); ++line) {
            if (here_[line] == shared) continue;
            has_same_rolls_ = false;
            lost += ratios_.loss(static_cast<int>(line), here_[line] - shared);
        }
        result_.here = ratios_.odds(lost);
    }

    /// Returns the odds of the same place in the other code.
    float here() const { return result_.here; }
    /// Returns the summed odds of all other places. After `bound`, returns an upper bound on this
    /// sum until `begin_count` is called.
    float elsewhere() const { return result_.elsewhere; }

    /// Sets the summed odds of all other places to an upper bound from a table.
    void bound(const UnsharedLines& unshared, CodeVariant read, CodeVariant other) {
        const auto& table =
            code::kUnsharedInOther[static_cast<std::size_t>(read)][static_cast<std::size_t>(other)];
        const int lost = unshared.min_loss(table) - ratios_.max_gain();
        // A place is counted once for each shift at which it shares a line. There are at most
        // `count_` such shifts.
        result_.elsewhere =
            static_cast<float>(theirs_.length * count_) * ratios_.odds(std::max(lost, 0)) +
            sharing_none();
    }

    /// Discards the bound set by `bound`. Must be called before places are added one by one.
    void begin_count() { result_.elsewhere = 0; }

    /// Adds the odds of the alternatives that the search for similar places does not find: the
    /// place of the reading in a4 at all shifts except `shift_here_`, and every place at shifts
    /// without a shared line.
    void add_unsimilar() {
        // If the rolls are the same in both codes, the place shares all lines at `shift_here_` and
        // no line at any other shift. `add` would skip `shift_here_`, and therefore add nothing.
        if (!has_same_rolls_) add(ratios_.places[kA4], here_, shift_here_);
        add_sharing_none();
    }

    /// Adds the odds of another place in a4, at all shifts with a shared line.
    void add(std::uint32_t place) { add(place, offsets_of(place), kNoShift); }
    /// Adds an upper bound on the odds of `places` skipped places. The bound for each place is
    /// kSkippedOdds times the number of lines, because a place shares lines at no more shifts than
    /// there are lines.
    void add_skipped(int places) {
        result_.elsewhere += static_cast<float>(places * ratios_.count()) * kSkippedOdds;
    }
    /// Returns the odds of the same place and of all other places. Also computes the position of
    /// the likeliest other place, if its odds are large enough to be reported.
    const OtherAxis& result() {
        // Minimum odds for a place to be reported.
        constexpr float kMinReportedOdds = 1e-6F;
        if (result_.best < kMinReportedOdds) return result_;
        auto places = ratios_.places;
        places[kA4] = best_place_;
        result_.position = code::position_at(ratios_.basis, places);
        return result_;
    }

  private:
    static constexpr int kNoShift = -1;
    static constexpr std::uint16_t kCounted = UINT16_MAX;

    static int modulo(int shift) { return shift < 0 ? shift + kSections : shift; }

    RollOffsets offsets_of(std::uint32_t place) const {
        RollOffsets offsets;
        const std::uint8_t* own = ratios_.basis[kA4].rolls + ratios_.places[kA4];
        const std::uint8_t* alternative = theirs_.rolls + place;
        // Sets the offsets of kMaxLines lines, even if fewer lines are in view, because loops of
        // constant length are faster.
        for (std::size_t line = 0; line < offsets.size(); ++line)
            offsets[line] = roll_offset(own[line], alternative[line]);
        return offsets;
    }

    /// Returns an upper bound on the summed odds at all shifts without a shared line. Assumes the
    /// maximum odds for every place and shift.
    float sharing_none() const {
        return static_cast<float>(theirs_.length * (kSections - 1)) * ratios_.odds(losses_.at_best);
    }

    /// Adds the odds of every place at all shifts without a shared line. If the upper bound on
    /// these odds is negligible, adds the bound instead.
    void add_sharing_none() {
        const float all = sharing_none();
        if (all <= kNegligibleOdds) {
            result_.elsewhere += all;
            return;
        }
        for (std::uint32_t place = 0; place < theirs_.length; ++place) {
            const int left_out = place == ratios_.places[kA4] ? shift_here_ : kNoShift;
            add_unshared(place, offsets_of(place), left_out);
        }
    }

    /// Adds the odds of a place at all shifts without a shared line, except `shift_left_out`.
    void add_unshared(std::uint32_t place, const RollOffsets& offsets, int shift_left_out) {
        const auto in_view = std::span(offsets).first(static_cast<std::size_t>(ratios_.count()));
        for (int shift = 0; shift < kSections; ++shift) {
            const int base = modulo(offsets[0] - shift);
            if (shift == shift_left_out ||
                std::find(in_view.begin(), in_view.end(), base) != in_view.end())
                continue;
            int lost = 0;
            for (int line = 0; line < ratios_.count() && !ratios_.is_hopeless(lost); ++line)
                lost += ratios_.loss(line, in_view[static_cast<std::size_t>(line)] - base);
            count(place, shift, ratios_.odds(lost));
        }
    }

    /// Adds the odds of a place at all shifts with a shared line, except `shift_left_out`.
    void add(std::uint32_t place, const RollOffsets& offsets, int shift_left_out) {
        // For each roll offset, the summed losses of the lines with this offset, in units of kUnit.
        // These lines are shared at the same shift.
        std::array<std::uint16_t, kSections + 1> shared{};
        std::uint16_t max_shared = 0;
        for (std::size_t line = 0; line < count_; ++line) {
            std::uint16_t& here = shared[offsets[line]];
            here = static_cast<std::uint16_t>(here + losses_.of[line]);
            max_shared = std::max(max_shared, here);
        }
        if (losses_.exceed_limit(max_shared) && shift_left_out == kNoShift) {
            add_skipped(1);
            return;
        }
        for (int line = 0; line < ratios_.count(); ++line) {
            const int base = offsets[static_cast<std::size_t>(line)];
            std::uint16_t& kept = shared[static_cast<std::size_t>(base)];
            if (kept == kCounted) continue;
            const bool is_skipped = losses_.exceed_limit(kept);
            kept = kCounted;
            const int shift = modulo(offsets[0] - base);
            if (shift == shift_left_out) continue;
            if (is_skipped) {
                result_.elsewhere += kSkippedOdds;
                continue;
            }
            const auto lost = loss_of_offsets(ratios_, offsets, line);
            if (lost) count(place, shift, ratios_.odds(*lost));
        }
    }

    /// Adds the odds of a place. Stores the place if its odds are the highest so far. `shift` is
    /// the roll of the first line at this place minus the roll of the reading, modulo 63.
    void count(std::uint32_t place, int shift, float odds) {
        result_.elsewhere += odds;
        if (odds <= result_.best) return;
        result_.best = odds;
        result_.roll = static_cast<std::uint8_t>(shift);
        best_place_ = place;
    }

    const LikelihoodRatios& ratios_;
    const Losses& losses_;
    const std::size_t count_;
    const code::Secondary& theirs_;
    const int shift_here_;
    const RollOffsets here_;  ///< roll offsets at the *same place*, in the other code
    /// True if the place of the reading has the same rolls in both codes, for all lines in view.
    bool has_same_rolls_ = true;
    std::uint32_t best_place_ = 0;
    OtherAxis result_;
};

/// Computes the odds of the other codes along one axis.
class AxisWeigher {
  public:
    AxisWeigher(const Kernels& kernels, const UnsharedLines& unshared, CodeVariant read)
        : kernels_(kernels),
          ratios_(unshared.ratios()),
          unshared_(unshared),
          read_(read),
          losses_(ratios_) {}

    /// Returns the odds of the places in the code `other`: the exact odds of the same place, and an
    /// upper bound on the odds of all other places (see `OtherPlaces::bound`).
    OtherPlaces bounded(CodeVariant other) const {
        OtherPlaces others(ratios_, losses_, read_, other);
        others.bound(unshared_, read_, other);
        return others;
    }

    /// Replaces the bound with a sum over all other places, unless the bound times `across` is
    /// negligible. `across` is the summed odds on the other axis.
    void look_closer(CodeVariant other, float across, OtherPlaces& others) {
        if (others.elsewhere() * across <= kNegligibleOdds) return;
        others.begin_count();
        others.add_unsimilar();
        if (!steps_) steps_ = losses_.of_steps(ratios_);
        // Searches a4 of the code `other` for digits that are similar to the digits of the reading
        // in a4 of the code `read`.
        code::Secondary a4 = code::basis(other)[kA4];
        a4.rolls = ratios_.basis[kA4].rolls;
        const PlaceBits similar = kernels_.find_similar_places(a4, ratios_.places[kA4], *steps_);
        int added = 0;
        for (std::uint32_t word = 0; word < similar.size(); ++word) {
            // Visits only set bits, because few places are similar.
            for (std::uint32_t rest = similar[word]; rest != 0; rest &= rest - 1) {
                others.add(32 * word + static_cast<std::uint32_t>(std::countr_zero(rest)));
                ++added;
            }
        }
        others.add_skipped(a4.length - 1 - added);
    }

  private:
    const Kernels& kernels_;
    const LikelihoodRatios& ratios_;
    const UnsharedLines& unshared_;
    const CodeVariant read_;
    const Losses losses_;
    std::optional<StepLosses> steps_;  ///< set on first use
};

}  // namespace

OtherAxis weigh_other_code(const Kernels& kernels, const LikelihoodRatios& ratios, CodeVariant read,
                           CodeVariant other) {
    const UnsharedLines unshared(kernels, ratios);
    AxisWeigher axis(kernels, unshared, read);
    OtherPlaces places = axis.bounded(other);
    axis.look_closer(other, 1, places);
    return places.result();
}

void weigh_other_codes(const Kernels& kernels, const UnsharedLines& columns,
                       const UnsharedLines& rows, CodeVariant read, OtherCodes& others) {
    others.first = {columns.ratios().position, rows.ratios().position};
    AxisWeigher by_x(kernels, columns, read);
    AxisWeigher by_y(kernels, rows, read);
    for (std::size_t i = 0; i < others.of.size(); ++i) {
        const auto other = static_cast<CodeVariant>(i);
        if (other == read) continue;
        OtherPlaces x = by_x.bounded(other);
        OtherPlaces y = by_y.bounded(other);
        // Skips the enumeration for an axis if the other axis rules out the code.
        by_x.look_closer(other, y.here() + y.elsewhere(), x);
        by_y.look_closer(other, x.here() + x.elsewhere(), y);
        others.of[i] = {x.result(), y.result()};
    }
}

}  // namespace dotpose::core
