/// Code evidence: the probability of each code variant, given the frames of a sheet.
///
/// Code variants agree on most of the plane. Many frames can therefore be read in several variants,
/// usually at the same place. If the places differ, further frames of the sheet resolve the
/// ambiguity:
///
///     CodeEvidence evidence;
///     for (;;) {
///         const CodeReading reading = locator.locate_in_any_code(image, evidence);
///         evidence = reading.evidence;
///     }
///
/// docs/integrity.md, "Which code?", derives the odds.
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
/// Consecutive frames at one place contain the same dots with the same defects, so they count as a
/// single frame. A single frame divides the odds of a variant by some factor. All frames at one
/// place together divide the odds by the mean of these factors. Frames are at the same place if
/// they are less than 64 cells from the first frame at this place, along both axes.
class CodeEvidence {
  public:
    /// Log-likelihood or log-odds for each code variant: log2, in units of 2^-8.
    using LogOdds = std::array<std::int32_t, kCodeVariantCount>;

    /// Maximum log2 ratio between the odds for the likeliest code variant and for any other code
    /// variant. Applies to each frame and to all frames together. With this limit, later frames can
    /// show that the sheet was replaced.
    static constexpr std::int32_t kMax_log2 = 40;
    /// Maximum log2 factor by which consecutive frames at one place together reduce the odds of a
    /// variant. These frames contain the same dots with the same defects, so they are not
    /// independent.
    static constexpr std::int32_t kMaxOfPlace_log2 = 32;

    /// Starts with equal odds for all code variants.
    CodeEvidence() = default;

    /// Returns the code variant with the highest odds.
    CodeVariant likeliest() const;
    /// Returns the log2 odds for `code` relative to the likeliest code variant. The result is in
    /// units of 2^-8, and at most 0.
    std::int32_t log2_q8(CodeVariant code) const;
    /// Returns the probability, in [0, 1], that the sheet is not printed in `code`.
    float p_wrong(CodeVariant code) const;

    /// Adds a frame located at `cell`. `log2_q8` contains the log2 likelihood of the bits of the
    /// frame in each code variant, in units of 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< log2 odds from all places except the newest
    /// Sum over the frames at the newest place, for each code variant. A frame adds the factor by
    /// which it alone would reduce the odds of the variant, relative to the likeliest variant.
    /// `sum()` uses the mean, factors_here_ / frames_here_.
    std::array<float, kCodeVariantCount> factors_here_{};
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// Result of locating one frame, with the evidence for each code variant.
struct CodeReading {
    /// If the status is ambiguous_code, two places explain the frame. The pose and the counts
    /// belong to one of these places.
    Fix fix;
    CodeVariant code = CodeVariant::anoto;  ///< code variant of `fix`
    CodeEvidence evidence;                  ///< evidence including this frame
    /// True if a place in another code variant also explains the frame. The members below contain
    /// this place. `Locator::locate_in_any_code` sets the flag only with the status ambiguous_code.
    /// The documentation of `Locator::locate_in_code` lists the cases in which that function sets
    /// the flag. If the fix is ok, its `p_wrong_log2` excludes the odds of this place.
    bool has_other = false;
    CodeVariant other_code = CodeVariant::anoto;
    Cell other_cell{};  ///< `Fix::cell` for the other place; fractions and angle are the same as in
                        ///< `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet in a given code variant. Without a given code variant, detects
/// the code variant from the frames.
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
