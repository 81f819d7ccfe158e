/// Code evidence: how probable each code variant is, given the frames of a sheet.
///
/// Code variants agree on most of the plane. A frame can therefore often be read in several
/// variants, usually at the same place. Sometimes the places are far apart. If one frame is
/// ambiguous, further frames of the sheet resolve the ambiguity:
///
///     CodeEvidence evidence;
///     for (;;) {
///         const CodeReading reading = locator.locate_in_any_code(image, evidence);
///         evidence = reading.evidence;
///     }
///
/// docs/integrity.md derives the odds.
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
/// single frame. Each frame alone would divide a variant's odds by some factor. All frames at one
/// place together divide the odds by the mean of these factors. Frames are at the same place if
/// they are less than 64 cells from the first frame at this place, along both axes.
class CodeEvidence {
  public:
    /// Log-likelihood or log-odds for each code variant: log2, in units of 2^-8.
    using LogOdds = std::array<std::int32_t, kCodeVariantCount>;

    /// Maximum log2 ratio between the odds for the likeliest code variant and for any other code
    /// variant. Applies to each frame and to all frames together. The limit allows later frames to
    /// reveal that the sheet was replaced.
    static constexpr std::int32_t kMax_log2 = 40;
    /// Maximum log2 factor by which consecutive frames at one place together reduce a variant's
    /// odds. These frames contain the same dots with the same defects, so they are not independent.
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

    /// Adds a frame located at `cell`. `log2_q8` contains the log2 likelihood of the frame's bits
    /// in each code variant, in units of 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< log2 odds from all places except the newest
    /// One sum per code variant, over the frames at the newest place. Each frame adds one factor to
    /// the sum. The frame alone would reduce the variant's odds, relative to the likeliest variant,
    /// by this factor. `sum()` uses the mean, factors_here_ / frames_here_.
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
    /// this place. `Locator::locate_in_any_code` sets the flag only if the status is
    /// ambiguous_code. For `Locator::locate_in_code`, the comment on this function lists the cases.
    /// If the fix is ok, its `p_wrong_log2` does not include the odds for this place.
    bool has_other = false;
    CodeVariant other_code = CodeVariant::anoto;
    Cell other_cell{};  ///< `Fix::cell` for the other place; fractions and angle are the same as in
                        ///< `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet in a given code variant. If none is given, detects the code
/// variant from the frames.
class CodeReader {
  public:
    /// Uses the code variant `given`. If `given` is empty, detects the code variant from all frames
    /// so far.
    explicit CodeReader(std::optional<CodeVariant> given = std::nullopt) : given_(given) {}

    /// Locates an image, and sets the locator's code variant to that of the fix. The fix's status
    /// reports errors, as in Locator::locate.
    Fix locate(const ImageView& image, Locator& locator);

    /// Returns true if a code variant was given.
    bool is_given() const { return given_.has_value(); }
    /// Returns the given code variant. If none was given, returns the likeliest so far.
    CodeVariant code() const { return given_.value_or(evidence_.likeliest()); }
    /// Returns the evidence from all frames so far. If a code variant was given, no evidence is
    /// collected, and all code variants remain equally likely.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<CodeVariant> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
