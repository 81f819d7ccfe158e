/// Code evidence: the probability of each code variant, given the frames of a sheet.
///
/// On most of the plane, the dots of the code variants are equal. Many frames can therefore be read
/// in several variants, usually at the same place. If the places differ, further frames of the
/// sheet show which variant is correct:
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

/// Odds for each code variant of a sheet, given all frames so far.
///
/// Consecutive frames at one place show the same dots with the same defects, so together they have
/// the weight of a single frame. Each frame alone would divide the odds of a variant by a factor:
/// the likelihood of the frame's bits in their likeliest variant, divided by their likelihood in
/// this variant. All consecutive frames at one place together divide the odds by the mean of their
/// factors. A frame counts as being at the same place as the preceding frames if it is less than 64
/// cells from the first of these frames along both axes.
class CodeEvidence {
  public:
    /// log2 of the likelihood or of the odds of each code variant, in units of 2^-8.
    using LogOdds = std::array<std::int32_t, kCodeVariantCount>;

    /// Maximum log2 of the ratio between the odds of the likeliest code variant and the odds of any
    /// other code variant. The maximum applies to each frame, and to all frames together. Without
    /// this limit, the evidence from many frames of one sheet could not be outweighed by the first
    /// frames of a new sheet in another code variant.
    static constexpr std::int32_t kMax_log2 = 40;
    /// Maximum log2 of the factor by which all consecutive frames at one place together divide the
    /// odds of a variant.
    static constexpr std::int32_t kMaxOfPlace_log2 = 32;

    /// Starts with equal odds for all code variants.
    CodeEvidence() = default;

    /// Returns the code variant with the highest odds. Of variants with equal odds, returns the
    /// first in the order of CodeVariant.
    CodeVariant likeliest() const;
    /// Returns the log2 of a ratio: the odds of `code`, divided by the odds of the likeliest code
    /// variant. The result is in units of 2^-8, and at most 0.
    std::int32_t log2_q8(CodeVariant code) const;
    /// Returns the probability, in [0, 1], that the sheet is not printed in `code`, assuming that
    /// it is printed in one of the code variants.
    float p_wrong(CodeVariant code) const;

    /// Adds a frame located at `cell`. `log2_q8` contains the log2 likelihood of the frame's bits
    /// in each code variant, in units of 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< log2 odds from the frames at all places before the newest place
    /// For each code variant, the sum over all frames at the newest place. Each frame adds the
    /// factor by which it alone would divide the odds of the variant. `sum()` uses the mean of
    /// these factors.
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
    /// True if a place in another code variant also explains the frame. The members below contain
    /// this other place. `Locator::locate_in_any_code` sets the flag only with the status
    /// ambiguous_code. `Locator::locate_in_code` also sets it in other cases, which are listed
    /// there. If the fix is ok, its `p_wrong_log2` does not include the probability that the other
    /// place is correct.
    bool has_other = false;
    CodeVariant other_code = CodeVariant::anoto;
    Cell other_cell{};  ///< `Fix::cell` of the other place; the fractions and the angle are those
                        ///< of `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet, either in a given code variant or in the variant that the
/// frames show.
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
