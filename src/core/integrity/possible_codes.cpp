#include "core/integrity/possible_codes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/math/odds.hpp"

namespace dotpose::core {
namespace {

/// A fix is ambiguous if the summed odds of other places in other codes exceed this limit. Smaller
/// odds may make the fix uncertain, but a second attempt may reduce them.
constexpr float kAmbiguousOdds = 1e-3F;
/// Earlier frames rule out a code if its odds relative to the likeliest code are at most this
/// value. The locator does not try codes that are ruled out.
constexpr float kRuledOutOdds = 1e-9F;
/// Two odds are considered equal if their ratio is at most this value. Such a small difference may
/// result from rounding errors.
constexpr float kRoundings = 1.01F;

std::size_t index(CodeVariant code) {
    return static_cast<std::size_t>(code);
}

}  // namespace

PossibleCodes::PossibleCodes(CodeVariant only) : is_known_(true) {
    weights_[index(only)] = 1;
    order_[0] = only;
}

PossibleCodes::PossibleCodes(const CodeEvidence& evidence) : is_known_(false) {
    for (std::size_t i = 0; i < order_.size(); ++i) {
        order_[i] = static_cast<CodeVariant>(i);
        weights_[i] = power_of_two(evidence.log2_q8(order_[i]));
    }
    // Insertion sort. Codes with equal odds keep their order.
    for (std::size_t i = 1; i < order_.size(); ++i) {
        for (std::size_t k = i; k > 0 && weight(order_[k]) > weight(order_[k - 1]); --k)
            std::swap(order_[k], order_[k - 1]);
    }
    while (count_ < order_.size() && weight(order_[count_]) > kRuledOutOdds)
        ++count_;
}

float PossibleCodes::number(CodeVariant read) const {
    float sum = 0;
    for (const float weight : weights_)
        sum += weight;
    return sum / weight(read);
}

int PossibleCodes::rounded_up(int log2, float factor) {
    if (factor <= kRoundings) return log2;
    int exponent = 0;
    const float mantissa = std::frexp(factor, &exponent);
    return log2 + exponent - (mantissa == 0.5F ? 1 : 0);
}

Judgement PossibleCodes::judge(CodeVariant read, const OtherCodes& others, const Fix& fix,
                               int max_p_wrong_log2) const {
    Judgement result;
    if (is_known_) {
        result.p_wrong_log2 = fix.p_wrong_log2;
        result.is_certain = true;
        return result;
    }
    float elsewhere = 0;
    for (const CodeVariant other : order_) {
        if (other == read) continue;
        const OtherCode& there = others.of[index(other)];
        const float prior = weight(other) / weight(read);
        const float odds = prior * (there.here() + there.elsewhere());
        elsewhere += prior * there.elsewhere();
        if (odds <= result.other_odds) continue;
        result.other_odds = odds;
        result.other = other;
    }
    const float own = power_of_two_exactly(fix.p_wrong_log2);
    result.is_ambiguous = elsewhere > kAmbiguousOdds;
    result.p_wrong_log2 = std::min(rounded_up(fix.p_wrong_log2, 1 + elsewhere / own), 0);
    result.is_certain = result.p_wrong_log2 <= max_p_wrong_log2;
    return result;
}

CodeEvidence::LogOdds likelihoods(CodeVariant read, const OtherCodes& others) {
    CodeEvidence::LogOdds log2_q8{};
    for (std::size_t i = 0; i < log2_q8.size(); ++i) {
        if (i == index(read)) continue;
        const float odds = others.of[i].here() + others.of[i].elsewhere();
        // Sets the log ratio to exactly 0 if a code explains the frame as well as the code `read`.
        // Otherwise, rounding errors would accumulate over frames.
        const bool is_equal = odds <= kRoundings && odds * kRoundings >= 1;
        log2_q8[i] = is_equal ? 0 : log2_of_odds_q8(odds);
    }
    return log2_q8;
}

}  // namespace dotpose::core
