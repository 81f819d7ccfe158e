#include "core/attempts/any_code.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/attempts/device.hpp"
#include "core/attempts/first.hpp"
#include "core/attempts/other_place.hpp"
#include "core/attempts/rows.hpp"
#include "core/attempts/second.hpp"
#include "core/attempts/steps.hpp"
#include "core/attempts/tracked.hpp"
#include "core/attempts/tuning.hpp"
#include "core/integrity/verify.hpp"
#include "core/locate.hpp"
#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

namespace tuned = tuning::any_code;

enum class Step { tracked, outwards, rows, second, resampled, device };

/// More bit errors than any frame has.
constexpr int kMostErrors = std::numeric_limits<int>::max();

constexpr float kRoundings = tuned::kRoundings;

constexpr std::size_t index(Profile profile) {
    return static_cast<std::size_t>(profile);
}

/// Whether the dots lie on a grid but this profile does not read them, so that another one may.
bool is_for_code(Status status) {
    return status == Status::not_in_code || status == Status::ambiguous ||
           status == Status::not_certain;
}

/// How certain a fix is, given the alternatives in the other profiles.
struct Judgement {
    bool is_certain = false;
    bool is_ambiguous = false;  ///< whether a place in another profile is about as likely
    int p_wrong_log2 = 0;  ///< bound of the probability of being wrong, given the places in all
                           ///< profiles
    Profile other = Profile::anoto;  ///< likeliest profile other than the one read
    float other_odds = 0;            ///< odds of that profile against the one read
};

/// Locates one frame in the profile that it shows.
class AnyCode {
  public:
    AnyCode(const ImageView& image, const Options& options, const CodeEvidence& evidence,
            Workspace& w)
        : image_(image), options_(options), evidence_(evidence), w_(w) {
        for (std::size_t i = 0; i < order_.size(); ++i)
            order_[i] = static_cast<Profile>(i);
        weigh_codes(evidence);
        // Sorts by insertion, as there are only three.
        for (std::size_t i = 1; i < order_.size(); ++i) {
            for (std::size_t k = i; k > 0 && weight(order_[k]) > weight(order_[k - 1]); --k)
                std::swap(order_[k], order_[k - 1]);
        }
        w_.other_codes->are_wanted = true;
    }
    ~AnyCode() { w_.other_codes->are_wanted = false; }
    AnyCode(const AnyCode&) = delete;
    AnyCode& operator=(const AnyCode&) = delete;

    CodeReading locate(const Prediction* prediction) {
        CodeReading reading = read(prediction);
        if (is_for_code(reading.fix.status)) learn_of_another_sheet(reading);
        return reading;
    }

  private:
    CodeReading read(const Prediction* prediction) {
        if (options_.effort == Effort::device) return locate_by({Step::device});
        if (prediction != nullptr) {
            prediction_ = prediction;
            const Profile code = options_.profile;
            if (attempt(Step::tracked, code)) {
                const Judgement judgement = judge(code);
                if (judgement.is_certain) return accepted(code, judgement);
            }
        }
        if (!may_try_twice()) return locate_by({Step::outwards, Step::rows});
        return locate_by({Step::outwards, Step::rows, Step::second, Step::resampled});
    }

    bool may_try_twice() const { return options_.effort == Effort::twice && w_.has_second_attempt; }

    /// Adds evidence from a frame of another sheet. The evidence for one profile can be so strong
    /// that no frame of another profile is certain; such a frame must still be able to overturn it.
    void learn_of_another_sheet(CodeReading& reading) {
        if (options_.effort == Effort::device || weight(order_[1]) == 1) return;
        weigh_codes({});
        for (std::size_t i = 1; i < order_.size(); ++i) {
            if (!attempt(Step::outwards, order_[i]) || !judge(order_[i]).is_certain) continue;
            reading.evidence.add(w_.fix.cell, likelihoods(order_[i]));
            break;
        }
        weigh_codes(evidence_);
        w_.fix = reading.fix;
    }

    /// Weighs the fix read in the profile `read` against places in the other profiles.
    Judgement judge(Profile read) const {
        const OtherCodes& others = *w_.other_codes;
        Judgement result;
        float elsewhere = 0;
        for (const Profile other : order_) {
            if (other == read) continue;
            const OtherCode& there = others.of[index(other)];
            const float prior = weight(other) / weight(read);
            const float odds = prior * (there.here() + there.elsewhere());
            elsewhere += prior * there.elsewhere();
            if (odds <= result.other_odds) continue;
            result.other_odds = odds;
            result.other = other;
        }
        result.is_ambiguous = elsewhere > tuned::kAsWell;
        const float own = power_of_two_exactly(w_.fix.p_wrong_log2);
        result.p_wrong_log2 = std::min(rounded_up(w_.fix.p_wrong_log2, 1 + elsewhere / own), 0);
        result.is_certain = result.p_wrong_log2 <= options_.integrity.max_p_wrong_log2;
        return result;
    }

    /// Sets the odds of the profiles against the likeliest, before the frame.
    void weigh_codes(const CodeEvidence& evidence) {
        for (const Profile profile : order_)
            weights_[index(profile)] = power_of_two(evidence.log2_q8(profile));
    }
    float weight(Profile profile) const { return weights_[index(profile)]; }

    /// Returns log2 of `times` * 2^log2, rounded up to a whole number; factors within rounding
    /// errors of 1 do not count.
    static int rounded_up(int log2, float times) {
        if (times <= kRoundings) return log2;
        int exponent = 0;
        const float mantissa = std::frexp(times, &exponent);
        return log2 + exponent - (mantissa == 0.5F ? 1 : 0);
    }

    /// Returns the number of possible profiles, each weighted by its odds against the one read.
    float codes(Profile read) const {
        float sum = 0;
        for (const Profile profile : order_)
            sum += weight(profile);
        return sum / weight(read);
    }

    /// Makes the steps in order until a profile gives a certain fix; otherwise returns the first
    /// doubtful fix, or the failure in the likeliest profile.
    CodeReading locate_by(std::initializer_list<Step> steps) {
        std::optional<CodeReading> doubtful;
        std::optional<Fix> failure;
        for (const Step step : steps) {
            for (const Profile code : worth_trying(step)) {
                if (!attempt(step, code)) {
                    if (code == order_[0]) failure = w_.fix;
                    if (step != Step::outwards && !is_for_code(w_.fix.status)) break;
                    continue;
                }
                const Judgement judgement = judge(code);
                if (judgement.is_certain) return best_of(step, code, judgement);
                if (!doubtful) doubtful = in_doubt(code, judgement);
            }
            if (doubtful && doubtful->fix.status == Status::ambiguous_code) break;
        }
        if (!doubtful) doubtful = CodeReading{failure.value_or(Fix{}), order_[0], evidence_};
        w_.fix = doubtful->fix;
        return *doubtful;
    }

    /// Returns the profiles in which a step is tried.
    std::span<const Profile> worth_trying(Step step) const {
        // Sampling the cells again costs three times the rest, so it is done only where the fewest
        // bits contradict.
        if (step == Step::resampled)
            return {&worth_resampling_, fewest_errors_ == kMostErrors ? 0U : 1U};
        // If there is a second attempt, it also finds what rows would show in the other profiles.
        if (step == Step::rows && may_try_twice()) return std::span(order_).first(1);
        std::size_t count = 1;
        while (count < order_.size() && weight(order_[count]) > tuned::kRuledOut)
            ++count;
        return std::span(order_).first(count);
    }

    /// Makes one step in one profile; leaves fix and other codes in the workspace. Returns whether
    /// there is a fix.
    bool attempt(Step step, Profile code) {
        options_.profile = code;
        // Alternatives that do not depend on the place are equally likely in each profile.
        const float in_question = codes(code);
        w_.other_codes->log2_in_question_q8 =
            in_question <= kRoundings ? 0 : log2_of_odds_q8(in_question);
        w_.other_codes->of = {};
        switch (step) {
            case Step::tracked:
                return locate_tracked(kernels(), image_, options_, *prediction_, w_);
            case Step::outwards:
                forget_frame(w_);
                return searches_outwards(options_, w_) &&
                       locate_outwards(kernels(), image_, options_, Rough::counted, w_) ==
                           Confirmation::ok;
            case Step::rows:
                return locate_by_rows(kernels(), image_, options_, w_);
            case Step::second:
                return attempt_filtered(code, false);
            case Step::resampled:
                return attempt_filtered(code, true);
            case Step::device:
                detect_image(image_, options_, w_);
                if (finish_device_attempt(options_, w_).status != Status::ok) return false;
                w_.fix.p_wrong_log2 = rounded_up(w_.fix.p_wrong_log2, codes(code));
                weigh_other_codes(kernels(), w_.grid, code, w_.decoding, w_.line_scores,
                                  w_.other_codes);
                return true;
        }
        return false;
    }

    /// Makes the second attempt, with or without sampling the cells again. The filtered image, its
    /// dots and its grid do not depend on the profile, so they are computed once.
    bool attempt_filtered(Profile code, bool resamples) {
        if (!is_seen_) {
            w_.fix.status = see_filtered(image_, options_, w_);
            w_.fix.attempt = Attempt::second;
            seen_ = w_.fix;
            is_seen_ = true;
        }
        w_.fix = seen_;
        if (seen_.status != Status::ok) return false;
        w_.decoding = {};
        Status& status = w_.fix.status;
        status = read_position(options_, w_);
        if (status == Status::not_certain && resamples) {
            status = resample_until_certain(image_, options_, w_);
            is_seen_ = false;
        } else if (status == Status::not_certain && w_.fix.bit_errors < fewest_errors_) {
            fewest_errors_ = w_.fix.bit_errors;
            worth_resampling_ = code;
        }
        if (status == Status::ok) status = measure_and_weigh(image_, options_, w_);
        return status == Status::ok;
    }

    /// Returns the certain fix or a better one: of a profile that explains the same place better,
    /// or of the second attempt.
    CodeReading best_of(Step step, Profile code, Judgement judgement) {
        const auto make = [&](Step other_step, Profile other) {
            if (!attempt(other_step, other)) return false;
            code = other;
            judgement = judge(other);
            return judgement.is_certain;
        };
        const Profile read = code;
        if (judgement.other_odds > tuned::kBetter && !make(step, judgement.other)) make(step, read);
        const bool may_be_improved = step == Step::outwards || step == Step::rows;
        if (may_be_improved && is_rough(w_.fix) && may_try_twice()) {
            const Profile best = code;
            if (!make(Step::resampled, best)) make(step, best);
        }
        return accepted(code, judgement);
    }

    CodeReading accepted(Profile code, const Judgement& judgement) {
        w_.fix.p_wrong_log2 = judgement.p_wrong_log2;
        CodeReading reading{w_.fix, code, evidence_};
        reading.evidence.add(w_.fix.cell, likelihoods(code));
        return reading;
    }

    /// Returns log2 of the likelihood of the bits in each profile, against that of the fix, in
    /// 2^-8.
    CodeEvidence::LogOdds likelihoods(Profile code) const {
        const OtherCodes& others = *w_.other_codes;
        CodeEvidence::LogOdds log2_q8{};
        for (std::size_t i = 0; i < log2_q8.size(); ++i) {
            if (i == index(code)) continue;
            const float odds = others.of[i].here() + others.of[i].elsewhere();
            // A profile that explains the frame equally well gives no evidence; rounding errors
            // must not add up.
            const bool says_nothing = odds <= kRoundings && odds * kRoundings >= 1;
            log2_q8[i] = says_nothing ? 0 : log2_of_odds_q8(odds);
        }
        return log2_q8;
    }

    CodeReading in_doubt(Profile code, const Judgement& judgement) {
        CodeReading reading{w_.fix, code, evidence_};
        reading.fix.p_wrong_log2 = judgement.p_wrong_log2;
        reading.fix.status = judgement.is_ambiguous ? Status::ambiguous_code : Status::not_certain;
        if (judgement.is_ambiguous) {
            name_other_place(code, judgement.other, *w_.other_codes, reading);
        }
        return reading;
    }

    const ImageView& image_;
    Options options_;
    const CodeEvidence& evidence_;
    std::array<float, kProfileCount> weights_;
    Workspace& w_;
    const Prediction* prediction_ = nullptr;
    std::array<Profile, kProfileCount> order_;  ///< by odds, the likeliest first
    // The members below hold what the second attempt has found so far.
    bool is_seen_ = false;  ///< whether the workspace holds dots and cells of the filtered image
    Fix seen_;              ///< the fix at that time, without a position
    Profile worth_resampling_ =
        Profile::anoto;                ///< profile that may gain from sampling the cells again
    int fewest_errors_ = kMostErrors;  ///< number of bit errors in `worth_resampling_`
};

}  // namespace

CodeReading read_in_any_code(const ImageView& image, const Options& options,
                             const Prediction* prediction, const CodeEvidence& evidence,
                             Workspace& w) {
    return AnyCode(image, options, evidence, w).locate(prediction);
}

CodeReading read_in_code(const ImageView& image, const Options& options, Workspace& w) {
    w.other_codes->of = {};
    w.other_codes->are_wanted = true;
    w.other_codes->log2_in_question_q8 = -1;
    CodeReading reading;
    reading.fix = core::locate(image, options, w);
    reading.code = options.profile;
    w.other_codes->are_wanted = false;
    if (reading.fix.status == Status::ok) {
        name_code_that_explains(*w.other_codes, reading);
        return reading;
    }
    if (!is_for_code(reading.fix.status)) return reading;
    const CodeReading any = read_in_any_code(image, options, nullptr, {}, w);
    const bool is_read = any.fix.status == Status::ok || any.fix.status == Status::ambiguous_code;
    // The other profile must explain the image without a contradiction, apart from misread bits.
    if (is_read && tuned::kBitsPerError * any.fix.bit_errors <= any.fix.dots_seen) {
        const bool is_first = any.code != reading.code;
        reading.has_other = is_first || any.has_other;
        reading.other_code = is_first ? any.code : any.other_code;
        reading.other_cell = is_first ? any.fix.cell : any.other_cell;
        reading.other_section = is_first ? any.fix.section : any.other_section;
    }
    // The workspace must match the fix that is returned.
    static_cast<void>(core::locate(image, options, w));
    return reading;
}

}  // namespace dotpose::core
