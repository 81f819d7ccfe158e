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

/// The sequence in which profiles differ.
constexpr std::size_t kA4 = 3;
/// Odds at which places are counted that are not looked at because they have less.
constexpr int kPassedOver_q8 = -52 * 256;
constexpr float kPassedOver = 2.3e-16F;
/// Summed odds that need no closer look.
constexpr float kEnough = 1e-12F;

/// What places lose at least in the lines that they do not share.
struct Losses {
    explicit Losses(const LikelihoodRatios& ratios)
        : enough(ratios.loss_for(kPassedOver_q8) + ratios.most_regained()) {
        for (int line = 0; line < ratios.count(); ++line) {
            const int least = ratios.least_loss(line);
            const int eighths = std::max(least, 0) / kUnit;
            of[static_cast<std::size_t>(line)] = static_cast<std::uint16_t>(eighths);
            all += eighths;
            at_best += least;
        }
    }

    /// Returns the losses of all steps, in parts of which `StepLosses::kEnough` are enough.
    StepLosses of_steps(const LikelihoodRatios& ratios) const {
        StepLosses steps;
        steps.count = ratios.count() - 1;
        // Quotients are less than 16, and floats exact enough that none is rounded up to the next.
        const auto part =
            static_cast<float>((enough + StepLosses::kEnough - 1) / StepLosses::kEnough);
        for (int step = 0; step < steps.count; ++step) {
            const int lost = std::min(ratios.least_loss_of_step(step), enough);
            steps.parts[static_cast<std::size_t>(step)] =
                static_cast<std::uint8_t>(static_cast<float>(lost) / part);
        }
        return steps;
    }

    /// Returns whether places lose enough if the lines that they share are worth no more than
    /// `all_but`.
    bool are_enough(int all_but) const { return kUnit * (all - all_but) > enough; }

    /// Scores are counted in units of this, rounded down, where their sum must fit 16 bits.
    static constexpr int kUnit = 8;
    int enough;                               ///< score after which a place is passed over
    int all = 0;                              ///< units that places lose that share no line
    int at_best = 0;                          ///< score that these lose, less what they regain
    std::array<std::uint16_t, kMaxLines> of;  ///< units that each line is worth
};

/// Sums up the places of one other profile.
class OtherPlaces {
  public:
    OtherPlaces(const LikelihoodRatios& ratios, const Losses& losses, Profile read, Profile other)
        : ratios_(ratios),
          losses_(losses),
          count_(static_cast<std::size_t>(ratios.count())),
          theirs_(code::basis(other)[kA4]),
          shift_here_(code::roll_further(read, other, ratios.position, ratios.places[kA4])),
          here_(offsets_of(ratios.places[kA4])) {
        // A line whose roll is the one read loses nothing.
        const int shared = modulo(here_[0] - shift_here_);
        int lost = 0;
        for (std::size_t line = 0; line < count_ && !ratios_.is_hopeless(lost); ++line) {
            if (here_[line] == shared) continue;
            has_same_rolls_ = false;
            lost += ratios_.loss(static_cast<int>(line), here_[line] - shared);
        }
        result_.here = ratios_.odds(lost);
    }

    /// Likelihood ratio of the same place.
    float here() const { return result_.here; }
    /// Upper bound of the sum of those of all other places; once they are counted, that sum.
    float elsewhere() const { return result_.elsewhere; }

    /// Bounds the places elsewhere by a table.
    void bound(const UnsharedLines& unshared, Profile read, Profile other) {
        const auto& table =
            code::kUnsharedInOther[static_cast<std::size_t>(read)][static_cast<std::size_t>(other)];
        const int lost = unshared.least_loss(table) - ratios_.most_regained();
        // There are at most as many shifts as lines, besides those that no line shares.
        result_.elsewhere =
            static_cast<float>(theirs_.length * count_) * ratios_.odds(std::max(lost, 0)) +
            sharing_none();
    }

    /// Forgets the bound, to count places one by one.
    void begin_count() { result_.elsewhere = 0; }

    /// Adds the same place of a4 at its other shifts, and all places at shifts that share no line.
    void add_unsimilar() {
        // A place that has the rolls read shares all lines at one shift and none at the others.
        if (!has_same_rolls_) add(ratios_.places[kA4], here_, shift_here_);
        add_sharing_none();
    }

    /// Adds another place in a4, at all shifts that some line shares.
    void add(std::uint32_t place) { add(place, offsets_of(place), kNoShift); }
    /// Adds a number of places that are passed over.
    void add_passed_over(int places) {
        result_.elsewhere += static_cast<float>(places * ratios_.count()) * kPassedOver;
    }
    /// Returns the sums, with the position of the best place elsewhere.
    const OtherAxis& result() {
        // The position of a place that explains little is never asked for.
        constexpr float kWorthNaming = 1e-6F;
        if (result_.best < kWorthNaming) return result_;
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
        // All lines that the tables have are taken, as loops of a known length are faster.
        for (std::size_t line = 0; line < offsets.size(); ++line)
            offsets[line] = roll_offset(own[line], alternative[line]);
        return offsets;
    }

    /// Returns the odds of all places at shifts that share no line, as if all lost as little as the
    /// best.
    float sharing_none() const {
        return static_cast<float>(theirs_.length * (kSections - 1)) * ratios_.odds(losses_.at_best);
    }

    /// Adds the places at shifts that share no line, one by one if all together are too much.
    void add_sharing_none() {
        const float all = sharing_none();
        if (all <= kEnough) {
            result_.elsewhere += all;
            return;
        }
        for (std::uint32_t place = 0; place < theirs_.length; ++place) {
            const int left_out = place == ratios_.places[kA4] ? shift_here_ : kNoShift;
            add_unshared(place, offsets_of(place), left_out);
        }
    }

    /// Adds a place at all shifts that share no line.
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

    void add(std::uint32_t place, const RollOffsets& offsets, int shift_left_out) {
        // The units of the lines that are shared at each shift, by the offset of these lines.
        std::array<std::uint16_t, kSections + 1> shared{};
        std::uint16_t most = 0;
        for (std::size_t line = 0; line < count_; ++line) {
            std::uint16_t& here = shared[offsets[line]];
            here = static_cast<std::uint16_t>(here + losses_.of[line]);
            most = std::max(most, here);
        }
        if (losses_.are_enough(most) && shift_left_out == kNoShift) {
            add_passed_over(1);
            return;
        }
        for (int line = 0; line < ratios_.count(); ++line) {
            const int base = offsets[static_cast<std::size_t>(line)];
            std::uint16_t& kept = shared[static_cast<std::size_t>(base)];
            if (kept == kCounted) continue;
            const bool is_passed_over = losses_.are_enough(kept);
            kept = kCounted;
            const int shift = modulo(offsets[0] - base);
            if (shift == shift_left_out) continue;
            if (is_passed_over) {
                result_.elsewhere += kPassedOver;
                continue;
            }
            const auto lost = loss_of_offsets(ratios_, offsets, line);
            if (lost) count(place, shift, ratios_.odds(*lost));
        }
    }

    /// Counts a place at which the roll of the first line is larger by `shift`.
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
    const RollOffsets here_;      ///< of the same place
    bool has_same_rolls_ = true;  ///< whether the same place has the rolls read in all lines
    std::uint32_t best_place_ = 0;
    OtherAxis result_;
};

/// Weighs the places of the other profiles along one axis.
class AxisWeigher {
  public:
    AxisWeigher(const Kernels& kernels, const UnsharedLines& unshared, Profile read)
        : kernels_(kernels),
          ratios_(unshared.ratios()),
          unshared_(unshared),
          read_(read),
          losses_(ratios_) {}

    /// Returns the places in profile `other`, those elsewhere bounded by a table.
    OtherPlaces bounded(Profile other) const {
        OtherPlaces others(ratios_, losses_, read_, other);
        others.bound(unshared_, read_, other);
        return others;
    }

    /// Counts places elsewhere one by one if their bound, with odds of `across` on the other axis,
    /// is not negligible.
    void look_closer(Profile other, float across, OtherPlaces& others) {
        if (others.elsewhere() * across <= kEnough) return;
        others.begin_count();
        others.add_unsimilar();
        if (!steps_) steps_ = losses_.of_steps(ratios_);
        // The digits as they were read are looked for in the sequence of the other profile.
        code::Secondary a4 = code::basis(other)[kA4];
        a4.digits = ratios_.basis[kA4].digits;
        const PlaceBits similar = kernels_.find_similar_places(a4, ratios_.places[kA4], *steps_);
        int added = 0;
        for (std::uint32_t word = 0; word < similar.size(); ++word) {
            // Few places are similar, so the others are skipped instead of visited.
            for (std::uint32_t rest = similar[word]; rest != 0; rest &= rest - 1) {
                others.add(32 * word + static_cast<std::uint32_t>(std::countr_zero(rest)));
                ++added;
            }
        }
        others.add_passed_over(a4.length - 1 - added);
    }

  private:
    const Kernels& kernels_;
    const LikelihoodRatios& ratios_;
    const UnsharedLines& unshared_;
    const Profile read_;
    const Losses losses_;
    std::optional<StepLosses> steps_;  ///< once they are needed
};

}  // namespace

OtherAxis weigh_other_code(const Kernels& kernels, const LikelihoodRatios& ratios, Profile read,
                           Profile other) {
    const UnsharedLines unshared(kernels, ratios);
    AxisWeigher axis(kernels, unshared, read);
    OtherPlaces places = axis.bounded(other);
    axis.look_closer(other, 1, places);
    return places.result();
}

void weigh_other_codes(const Kernels& kernels, const UnsharedLines& columns,
                       const UnsharedLines& rows, Profile read, OtherCodes& others) {
    others.first = {columns.ratios().position, rows.ratios().position};
    AxisWeigher by_x(kernels, columns, read);
    AxisWeigher by_y(kernels, rows, read);
    for (std::size_t i = 0; i < others.of.size(); ++i) {
        const auto other = static_cast<Profile>(i);
        if (other == read) continue;
        OtherPlaces x = by_x.bounded(other);
        OtherPlaces y = by_y.bounded(other);
        // An axis need not be looked at closely if the other one contradicts the profile.
        by_x.look_closer(other, y.here() + y.elsewhere(), x);
        by_y.look_closer(other, x.here() + x.elsewhere(), y);
        others.of[i] = {x.result(), y.result()};
    }
}

}  // namespace dotpose::core
