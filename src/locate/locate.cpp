// Locate: chooses the attempts for a frame on a desktop, and the codes to try. Decides whether a
// fix is accepted. Unlike the paper, dotpose makes up to three attempts:
//
//   tracked    measures the dots at their predicted positions    locate/tracked.hpp
//   first      finds the grid in a part of the image             locate/first.hpp
//   second     filters the image and uses all its dots           locate/second.hpp
//
// A known code is treated as a list of possible codes with one element.
#include "locate/locate.hpp"

#include <initializer_list>
#include <optional>

#include "core/integrity/possible_codes.hpp"
#include "core/steps.hpp"
#include "device/locate.hpp"
#include "dotpose/locate.hpp"
#include "locate/attempts.hpp"
#include "locate/confirm.hpp"
#include "locate/other_place.hpp"
#include "locate/pale.hpp"
#include "locate/tuning.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::cascade;

/// Makes attempts to locate one frame, in all possible codes, until a fix is certain. The workspace
/// then contains the fix and the results of the stages.
class Cascade {
  public:
    Cascade(const ImageView& image, const DeviceOptions& options, const PossibleCodes& codes,
            const CodeEvidence& evidence, DesktopWorkspace& w)
        : image_(image),
          options_(options),
          codes_(codes),
          evidence_(evidence),
          w_(w),
          attempts_(image, options, codes, w) {}

    /// Locates the frame. The arguments of the constructor must be valid.
    CodeReading locate(const Prediction* prediction) {
        w_.is_mirrored = w_.measurement.shows_too_few_cells = false;
        const auto tracked = track(prediction);
        CodeReading reading =
            tracked ? accept(options_.code, *tracked) : locate_without_prediction();
        if (leaves_code_open(reading.fix.status)) add_evidence_of_another_sheet(reading);
        // Reports `mirrored` if any attempt found the mirrored code, even if a later attempt failed
        // for another reason.
        if (reading.fix.status != Status::ok && w_.is_mirrored)
            reading.fix.status = w_.fix.status = Status::mirrored;
        if (reading.fix.status == Status::ok &&
            is_pale(image_, options_, reading.code, reading.fix))
            refuse_pale(reading);
        return reading;
    }

  private:
    /// Makes the tracked attempt. Searches for a rotation if the residuals indicate one. Returns
    /// nullopt if no fix is certain, if there is no prediction, or if the effort is
    /// `Effort::device`.
    std::optional<Judgement> track(const Prediction* prediction) {
        if (prediction == nullptr || options_.effort == Effort::device) return {};
        const CodeVariant code = options_.code;
        if (!attempts_.track(*prediction)) return {};
        Judgement judgement = attempts_.judge(code);
        if (judgement.is_certain && prediction->readout_turn_rad == 0 && attempts_.shows_turn()) {
            if (!attempts_.make(Step::turning, code)) return {};
            judgement = attempts_.judge(code);
        }
        return judgement.is_certain ? std::optional(judgement) : std::nullopt;
    }

    CodeReading locate_without_prediction() {
        const bool twice = attempts_.may_try_twice();
        if (options_.effort == Effort::device) return make({Step::device});
        if (options_.decoder == Decoder::window)  // the paper's decoder
            return twice ? make({Step::second, Step::resampled}) : make({Step::second});
        if (!twice) return make({Step::first, Step::turning});
        if (codes_.is_known()) return make({Step::first, Step::turning, Step::resampled});
        return make({Step::first, Step::turning, Step::second, Step::resampled});
    }

    /// Runs the steps in order until a fix is certain. Tries each step with every code that
    /// `Attempts::codes_for` returns. If a step after `turning` fails for a reason that does not
    /// depend on the code, does not try this step with the remaining codes. Skips the remaining
    /// steps if the first doubtful fix is ambiguous between codes, or if the image shows too few
    /// cells for a reliable fix. If no fix is certain, returns the first doubtful fix. If there is
    /// no doubtful fix, returns the last failure in the most likely code.
    CodeReading make(std::initializer_list<Step> steps) {
        std::optional<CodeReading> doubtful;
        std::optional<Fix> failure;
        bool shows_too_few_cells = false;
        for (const Step step : steps) {
            for (const CodeVariant code : attempts_.codes_for(step)) {
                if (step == Step::turning && attempts_.is_still() && codes_.is_known()) break;
                Step last = step;
                bool is_made = attempts_.make(step, code);
                if (step == Step::first && !is_made && attempts_.is_rough()) {
                    if (const auto better = better_than_rough(code)) return *better;
                    last = Step::complete_first;
                    is_made = attempts_.make(last, code);
                }
                if (is_made) {
                    const Judgement judgement = attempts_.judge(code);
                    if (judgement.is_certain) return best_of(last, code, judgement);
                    if (!doubtful) doubtful = in_doubt(code, judgement);
                    continue;
                }
                shows_too_few_cells |= attempts_.shows_too_few_cells();
                // A failed search for a rotation does not determine the status of the frame.
                if (code == codes_.likeliest() && step != Step::turning) failure = w_.fix;
                if (step > Step::turning && !leaves_code_open(w_.fix.status)) break;
            }
            if (doubtful && doubtful->fix.status == Status::ambiguous_code) break;
            if (shows_too_few_cells) break;
        }
        if (!doubtful)
            doubtful = CodeReading{failure.value_or(Fix{}), codes_.likeliest(), evidence_};
        w_.fix = doubtful->fix;
        return *doubtful;
    }

    /// Reads the frame again after a rough fix: searches for a rotation if the residuals indicate
    /// one, and then makes a second attempt. Returns the first certain fix.
    std::optional<CodeReading> better_than_rough(CodeVariant code) {
        const bool needs_turn = attempts_.shows_turn();
        for (const Step step : {Step::turning, Step::resampled}) {
            if ((step == Step::turning && !needs_turn) || !attempts_.make(step, code)) continue;
            const Judgement judgement = attempts_.judge(code);
            if (judgement.is_certain) return best_of(step, code, judgement);
        }
        return {};
    }

    /// Tries to improve the certain fix that `step` has found, and returns the best fix. If another
    /// code is more likely, reads the frame again in that code. After a first attempt, searches for
    /// a rotation if the residuals indicate one. If this gives no better fix and the residuals are
    /// large, makes a second attempt. If none of these attempts finds a certain fix, repeats the
    /// original attempt to restore its results in the workspace.
    CodeReading best_of(Step step, CodeVariant code, Judgement judgement) {
        const auto remake = [&](Step other_step, CodeVariant other) {
            if (!attempts_.make(other_step, other)) return false;
            code = other;
            judgement = attempts_.judge(other);
            return judgement.is_certain;
        };
        const CodeVariant read = code;
        const Step again = step == Step::first ? Step::complete_first : step;
        if (judgement.other_odds > tuned::kBetterOdds && !remake(again, judgement.other))
            remake(again, read);
        if (step == Step::first || step == Step::complete_first) {
            const CodeVariant best = code;
            // Before `complete_first`, a second attempt in this code found no certain fix.
            const bool has_failed = step == Step::complete_first && best == read;
            const bool may_be_better = is_rough(w_.fix) && attempts_.may_try_twice() && !has_failed;
            const bool needs_turn = attempts_.shows_turn();
            const bool is_better = (needs_turn && remake(Step::turning, best)) ||
                                   (may_be_better && remake(Step::resampled, best));
            if ((needs_turn || may_be_better) && !is_better) remake(again, best);
        }
        return accept(code, judgement);
    }

    CodeReading accept(CodeVariant code, const Judgement& judgement) {
        w_.fix.p_wrong_log2 = judgement.p_wrong_log2;
        w_.compared_bits = w_.measurement.compared;
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

    /// Tests the frame against the other codes, ignoring all earlier evidence. If another code
    /// yields a fix, adds the evidence of this frame to the reading. Without this test, strong
    /// earlier evidence for one code would prevent all fixes on sheets in other codes.
    void add_evidence_of_another_sheet(CodeReading& reading) {
        if (options_.effort == Effort::device || codes_.is_known() || codes_.are_equal()) return;
        const PossibleCodes all{CodeEvidence{}};
        Attempts attempts(image_, options_, all, w_);
        for (const CodeVariant code : all.in_order()) {
            if (code == codes_.likeliest() || !attempts.make(Step::complete_first, code) ||
                !attempts.judge(code).is_certain)
                continue;
            reading.evidence.add(w_.fix.cell, likelihoods(code, w_.other_codes));
            break;
        }
        w_.fix = reading.fix;
    }

    void refuse_pale(CodeReading& reading) {
        refuse(Status::no_contrast, w_);
        w_.fix.dots_seen = reading.fix.dots_seen;
        reading.fix = w_.fix;
    }

    const ImageView& image_;
    const DeviceOptions& options_;
    const PossibleCodes& codes_;
    const CodeEvidence& evidence_;
    DesktopWorkspace& w_;
    Attempts attempts_;
};

}  // namespace

Fix locate(const ImageView& image, const DeviceOptions& options, const Prediction* prediction,
           DesktopWorkspace& w) {
    w.compared_bits = {};
    const Status status = check(image, options, w);
    if (status != Status::ok) return refuse(status, w);
    if (options.effort == Effort::device) {
        return prediction != nullptr ? locate_as_device(image, options, *prediction, w)
                                     : locate_as_device(image, options, w);
    }
    w.other_codes.are_wanted = false;
    return Cascade(image, options, PossibleCodes(options.code), {}, w).locate(prediction).fix;
}

CodeReading locate_in_any_code(const ImageView& image, const DeviceOptions& options,
                               const Prediction* prediction, const CodeEvidence& evidence,
                               DesktopWorkspace& w) {
    w.compared_bits = {};
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.code, evidence};
    if (const auto only = w.known.only_code()) {
        DeviceOptions in_code = options;
        in_code.code = *only;
        const Prediction* same_code = *only == options.code ? prediction : nullptr;
        return {locate(image, in_code, same_code, w), *only, evidence};
    }
    w.other_codes.are_wanted = true;
    return Cascade(image, options, PossibleCodes(evidence), evidence, w).locate(prediction);
}

CodeReading locate_in_code(const ImageView& image, const DeviceOptions& options,
                           DesktopWorkspace& w) {
    w.compared_bits = {};
    const Status status = check(image, options, w);
    if (status != Status::ok) return {refuse(status, w), options.code, {}};
    w.other_codes.are_wanted = true;
    w.other_codes.log2_in_question_q8 = OtherCodes::kNoneInQuestion;
    CodeReading reading =
        Cascade(image, options, PossibleCodes(options.code), {}, w).locate(nullptr);
    if (reading.fix.status == Status::ok) {
        name_code_that_explains(w.other_codes, reading);
    } else if (leaves_code_open(reading.fix.status)) {
        note_other_reading(locate_in_any_code(image, options, nullptr, {}, w), reading);
        // Restores the results of the returned fix in the workspace.
        locate(image, options, nullptr, w);
    }
    return reading;
}

}  // namespace dotpose::core
