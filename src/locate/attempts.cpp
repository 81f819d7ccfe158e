#include "locate/attempts.hpp"

#include <algorithm>
#include <utility>

#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "core/math/odds.hpp"
#include "device/locate.hpp"
#include "locate/first.hpp"
#include "locate/tracked.hpp"
#include "locate/turning.hpp"

namespace dotpose::core {

bool leaves_code_open(Status status) {
    return status == Status::not_in_code || status == Status::ambiguous ||
           status == Status::not_certain;
}

bool Attempts::may_try_twice() const {
    return options_.effort == Effort::twice &&
           std::min(image_.width_px, image_.height_px) >= kMinFrameSide_px;
}

std::span<const CodeVariant> Attempts::codes_for(Step step) const {
    if (step == Step::resampled && !codes_.is_known())
        return {&worth_resampling_, min_errors_ == kMaxErrors ? 0U : 1U};
    return codes_.in_order();
}

/// Selects the code of the next attempt and returns the input of that attempt. Discards the odds
/// that the previous attempt stored for the other codes, and renews the work limit.
Frame Attempts::frame_in(CodeVariant code) {
    w_.work = WorkLimit(is_small(image_) ? WorkLimit::kOfSmallImage : WorkLimit::kOfImage);
    options_.code = code;
    w_.measurement.compared = {};
    if (w_.other_codes.are_wanted) w_.other_codes.of = {};
    // The certainty tests bound the probability of a wrong position in a single code. If several
    // codes are possible, the tests multiply this bound by the weighted number of codes (see
    // `PossibleCodes::number`).
    if (!codes_.is_known())
        w_.other_codes.log2_in_question_q8 = log2_of_odds_q8(codes_.number(code));
    return frame();
}

bool Attempts::track(const Prediction& prediction) {
    const Frame frame = frame_in(options_.code);
    const bool is_made = prediction.readout_turn_rad == 0
                             ? locate_tracked(frame, prediction, w_)
                             : locate_tracked_turning(frame, prediction, w_);
    note_compared_bits();
    return is_made;
}

bool Attempts::make(Step step, CodeVariant code) {
    Frame frame = frame_in(code);
    frame.defers_if_rough = step == Step::first && may_try_twice();
    // The place of filtered bits often needs more work.
    if (step == Step::second || step == Step::resampled) w_.work = WorkLimit(WorkLimit::kOfImage);
    const bool is_made = make(step, frame);
    note_compared_bits();
    return is_made;
}

void Attempts::note_compared_bits() {
    const ComparedBits& compared = w_.measurement.compared;
    if (compared.agrees_better_than(w_.compared_bits)) w_.compared_bits = compared;
}

bool Attempts::make(Step step, const Frame& frame) {
    switch (step) {
        case Step::first:
        case Step::complete_first:
            return locate_first(frame, w_);
        case Step::turning:
            return locate_turning(frame, std::exchange(shown_turn_, {}), w_);
        case Step::second:
            return make_second(frame);
        case Step::resampled:
            return second_.read(frame, SecondAttempt::Resampling::if_doubtful);
        case Step::device:
            return make_as_device();
    }
    return false;
}

bool Attempts::make_second(const Frame& frame) {
    if (second_.read(frame, SecondAttempt::Resampling::never)) return true;
    if (w_.fix.status == Status::not_certain && w_.fix.bit_errors < min_errors_) {
        min_errors_ = w_.fix.bit_errors;
        worth_resampling_ = frame.options.code;
    }
    return false;
}

bool Attempts::make_as_device() {
    const CodeVariant code = options_.code;
    if (locate_as_device(image_, options_, w_).status != Status::ok) return false;
    w_.fix.p_wrong_log2 = PossibleCodes::rounded_up(w_.fix.p_wrong_log2, codes_.number(code));
    weigh_other_codes(kernels(), w_.grid, code, w_.decoding, w_.line_scores, &w_.other_codes);
    return true;
}

Judgement Attempts::judge(CodeVariant read) const {
    return codes_.judge(read, w_.other_codes, w_.fix, options_.integrity.max_p_wrong_log2);
}

bool Attempts::shows_turn() {
    // Estimated cost if the dots show no rotation, in units of `WorkLimit`. With many dots, the
    // place is certain without much work, so only the cost of kMaxDots dots is subtracted from the
    // limit.
    constexpr std::size_t kWorkPerDot = 250;
    constexpr std::size_t kMaxDots = 200;
    const std::size_t dots =
        std::min(static_cast<std::size_t>(w_.measurement.dots.count), kMaxDots);
    if (w_.fix.surface != Surface::even && !w_.work.spend(kWorkPerDot * dots)) return false;
    return core::shows_turn(frame(), w_.fix, w_.rolling_pixels, w_.measurement, shown_turn_);
}

}  // namespace dotpose::core
