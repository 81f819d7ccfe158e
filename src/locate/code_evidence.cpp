#include "dotpose/code_evidence.hpp"

#include <algorithm>

#include "core/math/odds.hpp"
#include "dotpose/locate.hpp"
#include "locate/near_cells.hpp"

namespace dotpose {
namespace {

/// Two frames are at the same place if their positions differ by less than this number of cells
/// along each axis. Such frames may show the same dots.
constexpr std::uint32_t kSamePlace_cells = 64;
/// Maximum number of frames that are counted at one place. Further frames are ignored. The limit
/// ensures that the number of frames can be converted to a float without rounding.
constexpr std::uint32_t kMaxFrames = 1U << 23;

/// Returns the log2 odds of each code relative to the most likely code, clamped to at least
/// -`max_log2`. `log2_q8` and the result are in units of 2^-8.
CodeEvidence::LogOdds against_likeliest(CodeEvidence::LogOdds log2_q8, std::int32_t max_log2) {
    const std::int32_t likeliest = *std::max_element(log2_q8.begin(), log2_q8.end());
    for (std::int32_t& log2 : log2_q8)
        log2 = std::max(log2 - likeliest, -256 * max_log2);
    return log2_q8;
}

}  // namespace

CodeEvidence::LogOdds CodeEvidence::sum() const {
    LogOdds sum = before_log2_q8_;
    if (frames_here_ == 0) return sum;
    // The factor of a code in one frame is the odds of the most likely code in this frame, divided
    // by the odds of the code in question. By Markov's inequality, the mean factor of the true code
    // over the frames at one place is at least m with a probability of at most 1/m, even if the
    // frames are not independent. The odds of a code with mean factor m are therefore multiplied by
    // 1/m.
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const float mean = factors_here_[i] / static_cast<float>(frames_here_);
        sum[i] +=
            std::clamp<std::int32_t>(core::log2_of_odds_q8(1 / mean), -256 * kMaxOfPlace_log2, 0);
    }
    return against_likeliest(sum, kMax_log2);
}

CodeVariant CodeEvidence::likeliest() const {
    const LogOdds all = sum();
    return static_cast<CodeVariant>(std::max_element(all.begin(), all.end()) - all.begin());
}

std::int32_t CodeEvidence::log2_q8(CodeVariant code) const {
    return sum()[static_cast<std::size_t>(code)];
}

float CodeEvidence::p_wrong(CodeVariant code) const {
    const LogOdds all = sum();
    float right = 0;
    float wrong = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const float odds = core::power_of_two(all[i]);
        (static_cast<CodeVariant>(i) == code ? right : wrong) += odds;
    }
    return wrong / (right + wrong);
}

void CodeEvidence::add(Cell cell, const LogOdds& log2_q8) {
    const LogOdds frame = against_likeliest(log2_q8, kMax_log2);
    if (frames_here_ == 0 || !core::are_near(cell, here_, kSamePlace_cells)) {
        before_log2_q8_ = sum();
        factors_here_ = {};
        here_ = cell;
        frames_here_ = 0;
    }
    if (frames_here_ == kMaxFrames) return;
    ++frames_here_;
    for (std::size_t i = 0; i < frame.size(); ++i)
        factors_here_[i] += core::power_of_two(-frame[i]);
}

Fix CodeReader::locate(const ImageView& image, Locator& locator) {
    if (given_) {
        if (locator.options().code != *given_) {
            DeviceOptions options = locator.options();
            options.code = *given_;
            locator.set_options(options);
        }
        return locator.locate(image);
    }
    const CodeReading reading = locator.locate_in_any_code(image, evidence_);
    evidence_ = reading.evidence;
    return reading.fix;
}

}  // namespace dotpose
