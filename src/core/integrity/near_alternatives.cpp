#include "core/integrity/near_alternatives.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <span>

namespace dotpose::core {
namespace {

/// Number of sequence periods that are added to a place before a line index is subtracted from it.
/// This keeps the result positive, because kPeriods periods of any sequence contain more than
/// kMaxLines places.
constexpr std::uint32_t kPeriods = kMaxLines / code::kA3.size() + 1;

/// Alternatives that lose at least 56 bits are not evaluated line by line. Each of them contributes
/// 2^-56, so even 2^15 of them contribute only 2^-41 in total.
constexpr int kSkippedBits = 56;
constexpr float kSkippedOdds = 0x1p-56F;

/// Roll offsets of 16 lines, or sums of two roll offsets in each of 16 lines.
using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
static_assert(kMaxLines % sizeof(Bytes) == 0);

Bytes bytes_at(const RollOffsets& offsets, std::size_t line) {
    Bytes bytes;
    std::memcpy(&bytes, offsets.data() + line, sizeof bytes);
    return bytes;
}

/// Sets `offsets` to the sum of the roll offsets `a` and `b` in each line, modulo 63.
void set_sums(const RollOffsets& a, const RollOffsets& b, std::size_t lines, RollOffsets& offsets) {
    for (std::size_t line = 0; line < lines; line += sizeof(Bytes)) {
        Bytes sum = bytes_at(a, line) + bytes_at(b, line);
        sum -= static_cast<Bytes>(sum >= kSections) & kSections;
        std::memcpy(offsets.data() + line, &sum, sizeof sum);
    }
}

/// The twin places of a run in one sequence: the places where the digits of the run occur. A run is
/// a group of adjacent lines, and its digits are the digits of the reading at the steps between
/// these lines. For each place, the class stores the roll offset of each line relative to the first
/// line of the run, or the negated offset (see `Sign`). The first place is the place of the
/// reading.
class TwinPlaces {
  public:
    enum class Sign : std::uint8_t { positive, negative };

    /// The run begins at line `run` and has `digits` + 1 lines.
    TwinPlaces(const RankedLines& lines, std::size_t sequence, std::uint32_t run, int digits,
               Sign sign) {
        const code::Secondary& a = lines.ratios.basis[sequence];
        const std::uint32_t own = (lines.ratios.places[sequence] + run) % a.length;
        const auto add = [&](std::uint32_t place) {
            RollOffsets& offsets = twins_[count_++];
            lines.set_offsets(sequence, (place + kPeriods * a.length - run) % a.length, offsets);
            make_relative(run, static_cast<std::size_t>(lines.count()), sign, offsets);
        };
        add(own);
        for (std::uint32_t first = 0; first < a.length; first += 32) {
            for (std::uint32_t rest = a.equal_places(own, digits, first / 32); rest != 0;
                 rest &= rest - 1) {
                const auto place = first + static_cast<std::uint32_t>(std::countr_zero(rest));
                if (place != own) add(place);
            }
        }
    }

    std::span<const RollOffsets> all() const { return std::span(twins_).first(count_); }

  private:
    static void make_relative(std::uint32_t run, std::size_t lines, Sign sign,
                              RollOffsets& offsets) {
        const std::uint8_t base = offsets[run];
        for (std::size_t line = 0; line < lines; line += sizeof(Bytes)) {
            const Bytes here = bytes_at(offsets, line);
            // Negative differences are represented modulo 256.
            Bytes relative = sign == Sign::positive ? here - base : base - here;
            relative += static_cast<Bytes>(relative >= kSections) & kSections;
            std::memcpy(offsets.data() + line, &relative, sizeof relative);
        }
    }

    std::size_t count_ = 0;
    std::array<RollOffsets, code::kA4Restored.size()> twins_;
};

/// Sums the odds of the alternatives that share all lines of one run. Each alternative consists of
/// one twin place in each of the four sequences. The pairs of places in the last two sequences are
/// processed in batches of 32. Each batch is compared with every pair of places in the first two
/// sequences.
class RunSum {
  public:
    RunSum(const Kernels& kernels, const RankedLines& lines, const CoarseLosses& losses, int run,
           int shared_lines)
        : kernels_(kernels),
          lines_(lines),
          losses_(losses),
          count_(static_cast<std::size_t>(lines.count())),
          a_(places(0, run, shared_lines, TwinPlaces::Sign::negative)),
          b_(places(1, run, shared_lines, TwinPlaces::Sign::negative)),
          c_(places(2, run, shared_lines, TwinPlaces::Sign::positive)),
          d_(places(3, run, shared_lines, TwinPlaces::Sign::positive)) {}

    float sum() {
        for (const RollOffsets& c : c_.all()) {
            for (const RollOffsets& d : d_.all()) {
                RollOffsets both;
                set_sums(c, d, count_, both);
                for (std::size_t line = 0; line < count_; ++line)
                    batch_.offsets[line][in_batch_] = both[line];
                if (++in_batch_ == batch_.offsets[0].size()) add_batch();
            }
        }
        add_batch();
        return sum_;
    }

  private:
    TwinPlaces places(std::size_t k, int run, int shared_lines, TwinPlaces::Sign sign) const {
        return {lines_, k, static_cast<std::uint32_t>(run), shared_lines - 1, sign};
    }

    void add_batch() {
        if (in_batch_ == 0) return;
        const auto losses = std::span(losses_.losses).first(count_);
        const std::uint32_t all = ~std::uint32_t{0} >> (32 - in_batch_);
        RollOffsets opposite;
        for (const RollOffsets& a : a_.all()) {
            for (const RollOffsets& b : b_.all()) {
                set_sums(a, b, count_, opposite);
                std::uint32_t similar =
                    all & kernels_.similar_in_batch(batch_, opposite.data(), losses, losses_.limit);
                // The first combination is the reading itself.
                if (is_first_) similar &= ~std::uint32_t{1};
                is_first_ = false;
                for (; similar != 0; similar &= similar - 1)
                    sum_ += odds(static_cast<std::size_t>(std::countr_zero(similar)), opposite);
                sum_ += static_cast<float>(in_batch_) * kSkippedOdds;
            }
        }
        in_batch_ = 0;
    }

    float odds(std::size_t n, const RollOffsets& opposite) const {
        int lost = 0;
        for (std::size_t line = 0; line < count_; ++line) {
            const int offset = batch_.offsets[line][n] - opposite[line] + kSections;
            lost += lines_.loss(static_cast<int>(line), offset);
            if (lines_.ratios.is_hopeless(lost)) return 0;
        }
        return lines_.ratios.odds(lost);
    }

    const Kernels& kernels_;
    const RankedLines& lines_;
    const CoarseLosses& losses_;
    std::size_t count_;
    TwinPlaces a_, b_, c_, d_;
    OffsetBatch batch_;
    std::size_t in_batch_ = 0;
    bool is_first_ = true;
    float sum_ = 0;
};

}  // namespace

float sum_of_near_alternatives(const Kernels& kernels, const RankedLines& lines, int shared_lines) {
    const CoarseLosses losses(lines.ratios, kSkippedBits);
    float sum = 0;
    for (int run = 0; run + shared_lines <= lines.count(); ++run)
        sum += RunSum(kernels, lines, losses, run, shared_lines).sum();
    return sum;
}

}  // namespace dotpose::core
