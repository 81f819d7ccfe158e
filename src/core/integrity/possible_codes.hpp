// Possible codes: computes the certainty of a fix if the code of the sheet is unknown. See
// docs/integrity.md, "Which code?".
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Certainty of a fix over all possible codes.
struct Judgement {
    bool is_certain = false;
    bool is_ambiguous = false;  ///< true if other places in other codes have summed odds above 1e-3
    /// Upper bound on the probability that the fix is wrong, as log2. Covers the places in all
    /// possible codes.
    int p_wrong_log2 = 0;
    CodeVariant other = CodeVariant::anoto;  ///< likeliest code except the code that was read
    float other_odds = 0;                    ///< odds of `other` relative to the code that was read
};

/// The possible codes of a sheet, and their odds before the current frame.
class PossibleCodes {
  public:
    /// Allows only the code `only`.
    explicit PossibleCodes(CodeVariant only);
    /// Allows all codes, weighted by their odds from earlier frames.
    explicit PossibleCodes(const CodeEvidence& evidence);

    /// Returns the codes that earlier frames do not rule out, in order of decreasing odds.
    std::span<const CodeVariant> in_order() const { return std::span(order_).first(count_); }
    CodeVariant likeliest() const { return order_[0]; }
    bool is_known() const { return is_known_; }
    /// Returns true if the code is unknown and the two likeliest codes have equal odds. Earlier
    /// frames then favour neither of them.
    bool are_equal() const { return !is_known_ && weight(order_[1]) == 1; }

    /// Returns the weighted number of possible codes. The weight of a code is its odds relative to
    /// the code `read`.
    float number(CodeVariant read) const;
    /// Returns log2(2^log2 * factor), rounded up to an integer. Factors up to 1.01 are treated as
    /// 1.
    static int rounded_up(int log2, float factor);

    /// Returns the certainty of a fix that was read in the code `read` and has the status ok.
    /// `others` contains the odds of the other codes.
    Judgement judge(CodeVariant read, const OtherCodes& others, const Fix& fix,
                    int max_p_wrong_log2) const;

  private:
    float weight(CodeVariant code) const { return weights_[static_cast<std::size_t>(code)]; }

    bool is_known_;
    std::size_t count_ = 1;                           ///< number of codes that are not ruled out
    std::array<float, kCodeVariantCount> weights_{};  ///< odds relative to the likeliest code
    std::array<CodeVariant, kCodeVariantCount> order_{};
};

/// Returns the likelihood of the bits in each code divided by their likelihood in the code `read`,
/// as log2 in units of 2^-8. Likelihoods that differ by at most 1 % are considered equal.
CodeEvidence::LogOdds likelihoods(CodeVariant read, const OtherCodes& others);

}  // namespace dotpose::core
