// Possible codes: determines how certain a fix in one code is, given that the sheet may have
// another code. docs/integrity.md, "Which code?", derives the numbers.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/other_codes.hpp"
#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"

namespace dotpose::core {

/// Certainty of a fix, given its alternatives in the other possible codes.
struct Judgement {
    bool is_certain = false;
    bool is_ambiguous = false;  ///< true if a place in another code is about as likely
    int p_wrong_log2 = 0;  ///< log2 of the bound of the probability of being wrong, over all codes
    CodeVariant other = CodeVariant::anoto;  ///< likeliest code other than the one read
    float other_odds = 0;                    ///< odds of that code relative to the code read
};

/// The codes that a sheet may have, with their odds before the frame.
class PossibleCodes {
  public:
    /// Constructs the case that only one code is possible.
    explicit PossibleCodes(CodeVariant only);
    /// Constructs the case that all codes are possible, with the odds of earlier frames.
    explicit PossibleCodes(const CodeEvidence& evidence);

    /// Returns the codes that earlier frames do not rule out, the likeliest first.
    std::span<const CodeVariant> in_order() const { return std::span(order_).first(count_); }
    CodeVariant likeliest() const { return order_[0]; }
    bool is_known() const { return is_known_; }
    /// Returns true if earlier frames do not favour any code.
    bool are_equal() const { return !is_known_ && weight(order_[1]) == 1; }

    /// Returns the number of possible codes, each weighted by its odds relative to the code read.
    float number(CodeVariant read) const;
    /// Returns log2 of 2^log2 * factor, rounded up.
    static int rounded_up(int log2, float factor);

    /// Judges a fix with status ok, read in the code `read`.
    Judgement judge(CodeVariant read, const OtherCodes& others, const Fix& fix,
                    int max_p_wrong_log2) const;

  private:
    float weight(CodeVariant code) const { return weights_[static_cast<std::size_t>(code)]; }

    bool is_known_;
    std::size_t count_ = 1;                           ///< number of codes that are not ruled out
    std::array<float, kCodeVariantCount> weights_{};  ///< odds relative to the likeliest code
    std::array<CodeVariant, kCodeVariantCount> order_{};
};

/// Returns log2 of the likelihood of the bits in each code relative to the code read, in 2^-8.
CodeEvidence::LogOdds likelihoods(CodeVariant read, const OtherCodes& others);

}  // namespace dotpose::core
