/// Code evidence: the probability of each code variant, given frames that show one sheet.
///
/// On most of the plane, the code variants print the same dots. Many frames can therefore be
/// decoded in several variants, usually to the same place. If the places differ, further frames of
/// the sheet reveal which variant is correct:
///
///     CodeEvidence evidence;
///     for (;;) {
///         const CodeReading reading = locator.locate_in_any_code(image, evidence);
///         evidence = reading.evidence;
///     }
///
/// docs/integrity.md, "Which code?", derives the formulas.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Odds of each code variant for a sheet, given all frames so far.
///
/// Each frame divides the odds of a variant by the likelihood ratio of this variant: the likelihood
/// of the frame's bits in the variant that explains these bits best, divided by their likelihood in
/// this variant.
///
/// Consecutive frames at one place show the same dots with the same defects, so they are not
/// independent. Together, they have the weight of a single frame: the odds are divided by the mean
/// of the likelihood ratios of these frames. A frame is at the same place as the preceding frames
/// if it is less than 64 cells from the first of them along both axes.
class CodeEvidence {
  public:
    /// log2 of the likelihood or odds of each code variant, in units of 2^-8.
    using LogOdds = std::array<std::int32_t, kCodeVariantCount>;

    /// Upper limit, as log2, on the odds of the likeliest code variant relative to any other
    /// variant. It applies to each frame and to the accumulated evidence. Without this limit, the
    /// first frames of a new sheet in another variant could not outweigh the evidence accumulated
    /// on the previous sheet.
    static constexpr std::int32_t kMax_log2 = 40;
    /// Upper limit, as log2, on the mean likelihood ratio of the consecutive frames at one place.
    static constexpr std::int32_t kMaxOfPlace_log2 = 32;

    /// Starts with equal odds for all code variants.
    CodeEvidence() = default;

    /// Returns the code variant with the highest odds. Ties are broken by the order of CodeVariant.
    CodeVariant likeliest() const;
    /// Returns the log2 odds of `code` relative to the likeliest code variant, in units of 2^-8.
    /// The result is at most 0.
    std::int32_t log2_q8(CodeVariant code) const;
    /// Returns the probability, in [0, 1], that the sheet is not printed in `code`, assuming that
    /// it is printed in one of the code variants.
    float p_wrong(CodeVariant code) const;

    /// Adds a frame located at `cell`. `log2_q8` contains the log2 likelihood of the frame's bits
    /// in each code variant, in units of 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< log2 odds from the frames at all earlier places
    /// Sum of the likelihood ratios of all frames at the newest place, for each code variant.
    /// `sum()` uses their mean.
    std::array<float, kCodeVariantCount> factors_here_{};
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// Result of locating one frame, with the evidence for each code variant.
struct CodeReading {
    /// The fix. If its status is ambiguous_code, two places explain the frame, and the pose and the
    /// counts refer to one of them.
    Fix fix;
    CodeVariant code = CodeVariant::anoto;  ///< code variant of `fix`
    CodeEvidence evidence;                  ///< evidence including this frame
    /// True if a place in another code variant also explains the frame. The members below describe
    /// that place. `Locator::locate_in_any_code` sets the flag only with the status ambiguous_code.
    /// `Locator::locate_in_code` also sets the flag in the cases listed in its comment. If the fix
    /// is ok, `Fix::p_wrong_log2` does not include the probability that the other place is correct.
    bool has_other = false;
    CodeVariant other_code = CodeVariant::anoto;
    /// `Fix::cell` of the other place. The fractions and the angle are the same as in `fix`.
    Cell other_cell{};
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet, in a given code variant or in the variant detected from the
/// frames.
class CodeReader {
  public:
    /// Uses the code variant `given`. If `given` is empty, detects the code variant from all frames
    /// so far.
    explicit CodeReader(std::optional<CodeVariant> given = std::nullopt) : given_(given) {}

    /// Locates an image, and sets the code variant of the locator to that of the fix. The status of
    /// the fix reports errors, as in Locator::locate.
    Fix locate(const ImageView& image, Locator& locator);

    /// Returns true if a code variant was given.
    bool is_given() const { return given_.has_value(); }
    /// Returns the given code variant, or the likeliest code variant so far if none was given.
    CodeVariant code() const { return given_.value_or(evidence_.likeliest()); }
    /// Returns the evidence from all frames so far. If a code variant was given, no evidence is
    /// collected, and all code variants have equal odds.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<CodeVariant> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
