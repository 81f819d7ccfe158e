// Locate: chooses the attempts for a frame on a desktop, and the codes to try. Decides whether a
// fix is accepted. Unlike the paper, dotpose makes up to three attempts:
//
//   tracked    measures the dots where a prediction expects them    locate/tracked.hpp
//   first      finds the grid in a part of the image                locate/first.hpp
//   second     filters the image and uses all its dots              locate/second.hpp
//
// A known code is treated as a list of possible codes with one element.
#include "locate/locate.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>

#include "core/integrity/possible_codes.hpp"
#include "core/integrity/verify.hpp"
#include "core/kernels/select.hpp"
#include "core/math/odds.hpp"
#include "core/steps.hpp"
#include "device/locate.hpp"
#include "dotpose/locate.hpp"
#include "locate/confirm.hpp"
#include "locate/first.hpp"
#include "locate/other_place.hpp"
#include "locate/pale.hpp"
#include "locate/second.hpp"
#include "locate/tracked.hpp"
#include "locate/tuning.hpp"
#include "locate/turning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::cascade;

/// Steps of the cascade. `resampled` is a second attempt that samples the bits again if the
/// position is doubtful. It takes three times as long as `second`.
enum class Step : std::uint8_t { tracked, first, turning, second, resampled, device };

/// Returns true if the status means that there is a grid of dots, but that its bits do not give a
/// certain position in this code. Another code may succeed.
bool leaves_code_open(Status status) {
    return status == Status::not_in_code || status == Status::ambiguous ||
           status == Status::not_certain;
}

/// Makes the attempts for one frame, in all possible codes, and chooses the fix.
class Cascade {
  public:
    Cascade(const ImageView& image, const DeviceOptions& options, const PossibleCodes& codes,
            const CodeEvidence& evidence, DesktopWorkspace& w)
        : image_(image), options_(options), codes_(codes), evidence_(evidence), w_(w), second_(w) {}

    /// Returns the fix. The workspace contains the fix and the results of the stages.
    CodeReading locate(const Prediction* prediction) {
        if (options_.effort == Effort::device) return make({Step::device});
        prediction_ = prediction;
        const CodeVariant predicted = options_.code;
        if (prediction != nullptr && attempt(Step::tracked, predicted)) {
            const Judgement judgement = judge(predicted);
            const bool needs_turn =
                judgement.is_certain && prediction->readout_turn_rad == 0 && shows_turn();
            if (judgement.is_certain && !needs_turn) return accept(predicted, judgement);
            if (needs_turn && attempt(Step::turning, predicted)) {
                const Judgement turned = judge(predicted);
                if (turned.is_certain) return accept(predicted, turned);
            }
        }
        CodeReading reading = locate_afresh();
        if (leaves_code_open(reading.fix.status)) add_evidence_of_another_sheet(reading);
        return reading;
    }

  private:
    /// Returns true if the options allow a second attempt and the image is large enough for one.
    bool may_try_twice() const {
        return options_.effort == Effort::twice &&
               std::min(image_.width_px, image_.height_px) >= kMinFrameSide_px;
    }

    CodeReading locate_afresh() {
        const bool is_paper = options_.decoder == Decoder::window;
        if (is_paper)
            return may_try_twice() ? make({Step::second, Step::resampled}) : make({Step::second});
        if (!may_try_twice()) return make({Step::first, Step::turning});
        if (codes_.is_known()) return make({Step::first, Step::turning, Step::resampled});
        return make({Step::first, Step::turning, Step::second, Step::resampled});
    }

    /// Runs the steps in order until a fix is certain. Tries each step in all codes worth trying. A
    /// step after `turning` ends early if it fails for a reason that does not depend on the code.
    /// Skips the remaining steps if the first doubtful fix is ambiguous between codes, or if the
    /// image shows too few cells for a certain fix. Without a certain fix, returns the first
    /// doubtful fix. Without a doubtful fix, returns the last failure in the most likely code.
    CodeReading make(std::initializer_list<Step> steps) {
        std::optional<CodeReading> doubtful;
        std::optional<Fix> failure;
        bool shows_too_few_cells = false;
        for (const Step step : steps) {
            for (const CodeVariant code : worth_trying(step)) {
                if (!attempt(step, code)) {
                    shows_too_few_cells |= w_.measurement.shows_too_few_cells;
                    // A failed search for a rotation does not determine the status of the frame.
                    if (code == codes_.likeliest() && step != Step::turning) failure = w_.fix;
                    if (step > Step::turning && !leaves_code_open(w_.fix.status)) break;
                    continue;
                }
                const Judgement judgement = judge(code);
                if (judgement.is_certain) return best_of(step, code, judgement);
                if (!doubtful) doubtful = in_doubt(code, judgement);
            }
            if (doubtful && doubtful->fix.status == Status::ambiguous_code) break;
            if (shows_too_few_cells) break;
        }
        if (!doubtful)
            doubtful = CodeReading{failure.value_or(Fix{}), codes_.likeliest(), evidence_};
        w_.fix = doubtful->fix;
        return *doubtful;
    }

    /// Returns the codes to try in a step, most likely code first. If several codes are possible,
    /// returns at most one code for `resampled`: the code with the fewest bit errors among the
    /// codes in which `second` was not certain.
    std::span<const CodeVariant> worth_trying(Step step) const {
        if (step == Step::resampled && !codes_.is_known())
            return {&worth_resampling_, min_errors_ == kMaxErrors ? 0U : 1U};
        return codes_.in_order();
    }

    /// Runs one step in one code. Returns true if there is a fix. The workspace then contains the
    /// fix and the odds of the other codes.
    bool attempt(Step step, CodeVariant code) {
        options_.code = code;
        OtherCodes& others = w_.other_codes;
        others.of = {};
        // The bounds on the probability of a wrong position apply to a single code. If several
        // codes are possible, each bound is multiplied by the number of codes, weighted by their
        // odds.
        if (!codes_.is_known()) others.log2_in_question_q8 = log2_of_odds_q8(codes_.number(code));
        const Frame frame = this->frame();
        switch (step) {
            case Step::tracked:
                return prediction_->readout_turn_rad == 0
                           ? locate_tracked(frame, *prediction_, w_)
                           : locate_tracked_turning(frame, *prediction_, w_);
            case Step::first:
                return locate_first(frame, w_);
            case Step::turning:
                return locate_turning(frame, w_);
            case Step::second:
                return attempt_second(frame);
            case Step::resampled:
                return second_.read(frame, SecondAttempt::Resampling::if_doubtful);
            case Step::device:
                return attempt_as_device(code);
        }
        return false;
    }

    Frame frame() const { return w_.frame(kernels(), image_, options_); }

    bool shows_turn() {
        return core::shows_turn(frame(), w_.fix, w_.rolling_pixels, w_.measurement);
    }

    bool attempt_second(const Frame& frame) {
        if (second_.read(frame, SecondAttempt::Resampling::never)) return true;
        if (w_.fix.status == Status::not_certain && w_.fix.bit_errors < min_errors_) {
            min_errors_ = w_.fix.bit_errors;
            worth_resampling_ = frame.options.code;
        }
        return false;
    }

    bool attempt_as_device(CodeVariant code) {
        if (locate_as_device(image_, options_, w_).status != Status::ok) return false;
        w_.fix.p_wrong_log2 = PossibleCodes::rounded_up(w_.fix.p_wrong_log2, codes_.number(code));
        weigh_other_codes(kernels(), w_.grid, code, w_.decoding, w_.line_scores, &w_.other_codes);
        return true;
    }

    Judgement judge(CodeVariant read) const {
        return codes_.judge(read, w_.other_codes, w_.fix, options_.integrity.max_p_wrong_log2);
    }

    /// Returns the certain fix, or a better fix if there is one. Reads the frame again in another
    /// code if the other code is more likely. After a first attempt, searches for a rotation if the
    /// residuals show one. If this gives no certain fix, or if there is no rotation, makes a second
    /// attempt if the residuals are large.
    CodeReading best_of(Step step, CodeVariant code, Judgement judgement) {
        const auto remake = [&](Step other_step, CodeVariant other) {
            if (!attempt(other_step, other)) return false;
            code = other;
            judgement = judge(other);
            return judgement.is_certain;
        };
        const CodeVariant read = code;
        if (judgement.other_odds > tuned::kBetterOdds && !remake(step, judgement.other))
            remake(step, read);
        if (step == Step::first) {
            const CodeVariant best = code;
            const bool may_be_better = is_rough(w_.fix) && may_try_twice();
            const bool needs_turn = shows_turn();
            const bool is_better = (needs_turn && remake(Step::turning, best)) ||
                                   (may_be_better && remake(Step::resampled, best));
            if ((needs_turn || may_be_better) && !is_better) remake(step, best);
        }
        return accept(code, judgement);
    }

    CodeReading accept(CodeVariant code, const Judgement& judgement) {
        w_.fix.p_wrong_log2 = judgement.p_wrong_log2;
        CodeReading reading{w_.fix, code, evidence_};
        if (!codes_.is_known())
            reading.evidence.add(w_.fix.cell, likelihoods(code, w_.other_codes));
        return reading;
    }

    CodeReading in_doubt(CodeVariant code, const Judgement& judgement) {
        CodeReading reading{w_.fix, code, evidence_};
        reading.fix.p_wrong_log2 = judgement.p_wrong_log2;
        reading.fix.status = judgement.is_ambiguous ? Status::ambiguous_code : Status::not_certain;
        if (judgement.is_ambiguous)
            name_other_place(code, judgement.other, w_.other_codes, reading);
        return reading;
    }

    /// Adds the evidence of the frame if the frame is certain in another code without the earlier
    /// evidence. Without this addition, strong evidence for one code would prevent certain fixes on
    /// all sheets in other codes.
    void add_evidence_of_another_sheet(CodeReading& reading) {
        if (options_.effort == Effort::device || codes_.is_known() || codes_.are_equal()) return;
        const PossibleCodes before = codes_;
        codes_ = PossibleCodes(CodeEvidence{});
        for (const CodeVariant code : codes_.in_order()) {
            if (code == before.likeliest() || !attempt(Step::first, code) ||
                !judge(code).is_certain)
                continue;
            reading.evidence.add(w_.fix.cell, likelihoods(code, w_.other_codes));
            break;
        }
        codes_ = before;
        w_.fix = reading.fix;
    }

    static constexpr int kMaxErrors = std::numeric_limits<int>::max();

    const ImageView& image_;
    DeviceOptions options_;
    PossibleCodes codes_;
    const CodeEvidence& evidence_;
    DesktopWorkspace& w_;
    const Prediction* prediction_ = nullptr;
    SecondAttempt second_;
    CodeVariant worth_resampling_ = CodeVariant::anoto;  ///< code with `min_errors_` bit errors
    int min_errors_ = kMaxErrors;
};

/// Locates a frame. The arguments must be valid.
CodeReading locate_checked(const ImageView& image, const DeviceOptions& options,
                           const Prediction* prediction, const PossibleCodes& codes,
                           const CodeEvidence& evidence, DesktopWorkspace& w) {
    w.is_mirrored = w.measurement.shows_too_few_cells = false;
    CodeReading reading = Cascade(image, options, codes, evidence, w).locate(prediction);
    // Reports `mirrored` if any attempt found the mirrored code, even if a later attempt failed for
    // another reason.
    if (reading.fix.status != Status::ok && w.is_mirrored)
        reading.fix.status = w.fix.status = Status::mirrored;
    if (reading.fix.status == Status::ok && is_pale(image, options, reading.code, reading.fix)) {
        const int dots_seen = reading.fix.dots_seen;
        refuse(Status::no_contrast, w);
        w.fix.dots_seen = dots_seen;
        reading.fix = w.fix;
    }
    return reading;
}

/// Sets `other_code`, `other_cell` and `other_section` of `reading` to the code and place of `any`,
/// a reading of the same frame in any code. If both readings are in the same code, copies these
/// members from `any` instead. Does nothing if `any` has no place, or if `any` has more than one
/// bit error per kBitsPerError dots.
void note_other_reading(const CodeReading& any, CodeReading& reading) {
    const bool is_read = any.fix.status == Status::ok || any.fix.status == Status::ambiguous_code;
    if (!is_read || tuned::kBitsPerError * any.fix.bit_errors > any.fix.dots_seen) return;
    const bool is_first = any.code != reading.code;
    reading.has_other = is_first || any.has_other;
    reading.other_code = is_first ? any.code : any.other_code;
    reading.other_cell = is_first ? any.fix.cell : any.other_cell;
    reading.other_section = is_first ? any.fix.section : any.other_section;
}

}  // namespace

Fix locate(const ImageView& image, const DeviceOptions& options, const Prediction* prediction,
           DesktopWorkspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    if (options.effort == Effort::device) {
        return prediction != nullptr ? locate_as_device(image, options, *prediction, w)
                                     : locate_as_device(image, options, w);
    }
    w.other_codes.are_wanted = false;
    return locate_checked(image, options, prediction, PossibleCodes(options.code), {}, w).fix;
}

Status begin_image(int width_px, int height_px, const DeviceOptions& options, DesktopWorkspace& w) {
    Status status = check(width_px, height_px, options, w);
    if (status == Status::ok && !w.pushed.begin(width_px, height_px))
        status = Status::image_too_large;
    return status == Status::ok ? status : refuse(status, w).status;
}

CodeReading locate_in_any_code(const ImageView& image, const DeviceOptions& options,
                               const Prediction* prediction, const CodeEvidence& evidence,
                               DesktopWorkspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.code, evidence};
    w.other_codes.are_wanted = true;
    return locate_checked(image, options, prediction, PossibleCodes(evidence), evidence, w);
}

CodeReading locate_in_code(const ImageView& image, const DeviceOptions& options,
                           DesktopWorkspace& w) {
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.code, {}};
    const PossibleCodes given(options.code);
    w.other_codes.are_wanted = true;
    w.other_codes.log2_in_question_q8 = OtherCodes::kNoneInQuestion;
    CodeReading reading = locate_checked(image, options, nullptr, given, {}, w);
    if (reading.fix.status == Status::ok) {
        name_code_that_explains(w.other_codes, reading);
    } else if (leaves_code_open(reading.fix.status)) {
        note_other_reading(locate_in_any_code(image, options, nullptr, {}, w), reading);
        locate(image, options, nullptr, w);  // restores the results of the returned fix in the
                                             // workspace
    }
    return reading;
}

}  // namespace dotpose::core
