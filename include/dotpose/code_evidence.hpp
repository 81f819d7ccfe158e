/// Code evidence: the probability of each code variant of a sheet, given frames of the sheet. The
/// code variants agree on most of the plane. A frame can therefore often be read in several code
/// variants, usually at the same place, but sometimes at distant places. If one frame is ambiguous,
/// further frames of the sheet resolve the ambiguity:
///
///     CodeEvidence evidence;
///     for (;;) {
///         const CodeReading reading = locator.locate_in_any_code(image, evidence);
///         evidence = reading.evidence;
///     }
///
/// For the derivation of the odds, see docs/integrity.md.
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

/// The odds of each code variant of one sheet, given all frames so far. Consecutive frames at one
/// place contain the same dots with the same defects, so they count as a single frame: together
/// they reduce the odds of a code variant by the mean of their individual factors. Frames are at
/// the same place if, along both axes, they are less than 64 cells from the first frame at this
/// place.
class CodeEvidence {
  public:
    /// log2 of the likelihood or the odds of each code variant, in units of 2^-8.
    using LogOdds = std::array<std::int32_t, kCodeVariantCount>;

    /// log2 of the maximum ratio between the odds of the likeliest and of any other code variant.
    /// Applies to each frame and to all frames together. Because of this limit, later frames can
    /// still reveal that the sheet was replaced.
    static constexpr std::int32_t kMax_log2 = 40;
    /// log2 of the maximum factor by which consecutive frames at one place together reduce the odds
    /// of a code variant. These frames contain the same dots with the same defects, so they are not
    /// independent.
    static constexpr std::int32_t kMaxOfPlace_log2 = 32;

    /// Starts with all code variants equally likely.
    CodeEvidence() = default;

    /// Returns the code variant with the highest odds.
    CodeVariant likeliest() const;
    /// Returns log2 of the odds of a code variant relative to the likeliest code variant, in units
    /// of 2^-8, at most 0.
    std::int32_t log2_q8(CodeVariant code) const;
    /// Returns the probability, in [0, 1], that `code` is not the code variant of the sheet.
    float p_wrong(CodeVariant code) const;

    /// Adds the evidence of a frame located at `cell`. `log2_q8` is log2 of the likelihood of the
    /// bits of the frame in each code variant, in units of 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< log2 of the odds from all places except the newest
    /// For each code variant, the sum over the frames at the newest place of the factor by which a
    /// frame reduces the odds of the variant, relative to the likeliest variant. `sum()` uses the
    /// mean, factors_here_ / frames_here_.
    std::array<float, kCodeVariantCount> factors_here_{};
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// The result of locating one frame, with the evidence for the code variant of its sheet.
struct CodeReading {
    /// If the status is ambiguous_code, the pose and the counts are those of one of the two places.
    Fix fix;
    CodeVariant code = CodeVariant::anoto;  ///< code variant of `fix`
    CodeEvidence evidence;                  ///< evidence that includes this frame
    /// True if the place in the following members also explains the frame, in another code variant.
    /// Set by `Locator::locate_in_any_code` only if the status is ambiguous_code, and by
    /// `Locator::locate_in_code` in the cases listed there. If the fix is ok, its `p_wrong_log2`
    /// does not include the odds of this place.
    bool has_other = false;
    CodeVariant other_code = CodeVariant::anoto;
    Cell other_cell{};  ///< cell of the other place, as in Fix; fractions and angle are the same as
                        ///< in `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet, in a given code variant or, if none is given, in the code
/// variant detected from the frames.
class CodeReader {
  public:
    /// Uses the code variant `given`. If `given` is empty, detects the code variant from all frames
    /// so far.
    explicit CodeReader(std::optional<CodeVariant> given = std::nullopt) : given_(given) {}

    /// Locates an image. Also sets the code variant in the options of `locator` to the code variant
    /// of the fix. The status of the fix reports errors, as in Locator::locate.
    Fix locate(const ImageView& image, Locator& locator);

    /// Returns true if the code variant was given.
    bool is_given() const { return given_.has_value(); }
    /// Returns the given code variant, or the likeliest code variant so far if none is given.
    CodeVariant code() const { return given_.value_or(evidence_.likeliest()); }
    /// Returns the evidence from the frames so far. If a code variant was given, all code variants
    /// remain equally likely.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<CodeVariant> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
