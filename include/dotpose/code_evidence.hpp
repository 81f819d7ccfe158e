/// Code evidence: the probability of each code variant of a sheet, given its frames. Code variants
/// agree on most of the plane. A frame can therefore often be read in several code variants,
/// usually at the same place, sometimes at distant places. If one frame is ambiguous, other frames
/// of the sheet decide:
///
///     CodeEvidence evidence;
///     for (;;) {
///         const CodeReading reading = locator.locate_in_any_code(image, evidence);
///         evidence = reading.evidence;
///     }
///
/// docs/integrity.md derives the numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "dotpose/code.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/image.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// The likelihood of each code variant for one sheet, given all frames so far. Frames of the same
/// dots count as one, with their mean, because they share the defects of these dots.
class CodeEvidence {
  public:
    /// log2 of the likelihood or odds of each code variant, in 2^-8.
    using LogOdds = std::array<std::int32_t, kCodeVariantCount>;

    /// Maximum change of a code variant's odds against the likeliest code variant, as log2, by one
    /// frame or by all frames together. With the limit, frames of another sheet can still show that
    /// the sheet has changed.
    static constexpr std::int32_t kMost_log2 = 40;
    /// Maximum change of these odds by the frames of one place, as log2, because defects of the
    /// same dots are not independent.
    static constexpr std::int32_t kMostOfPlace_log2 = 32;

    /// Starts with all code variants equally likely.
    CodeEvidence() = default;

    /// Returns the code variant with the highest odds.
    CodeVariant likeliest() const;
    /// Returns the log odds of a code variant against the likeliest, in 2^-8 of log2; at most 0.
    std::int32_t log2_q8(CodeVariant code) const;
    /// Returns the probability, at most 1, that the sheet does not have this code variant.
    float p_wrong(CodeVariant code) const;

    /// Adds a frame located at `cell`, with log2 of the likelihood of its bits in each code
    /// variant, in 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< sum over the places before the newest
    /// Sum over the frames of the newest place of the factors by which they make each code variant
    /// less likely.
    std::array<float, kCodeVariantCount> factors_here_{};
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// The result of locating one frame without a given code variant.
struct CodeReading {
    /// With the status ambiguous_code, pose and counts are those of one of the two places.
    Fix fix;
    CodeVariant code = CodeVariant::anoto;  ///< code variant of `fix`
    CodeEvidence evidence;                  ///< evidence with this frame added
    /// Whether a place in another code variant explains the frame as well. If the fix is ok, the
    /// odds of that place against the fix are part of `p_wrong_log2`.
    bool has_other = false;
    CodeVariant other_code = CodeVariant::anoto;
    Cell other_cell{};  ///< as Fix::cell; fractions and angle are those of `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet, in a given code variant or in the detected one.
class CodeReader {
  public:
    /// Uses the given code variant, or without one the likeliest code variant by all frames.
    explicit CodeReader(std::optional<CodeVariant> given = std::nullopt) : given_(given) {}

    /// Locates an image, and sets the code variant in the locator's options to the code variant of
    /// the fix. Errors are in the status, as in Locator::locate.
    Fix locate(const ImageView& image, Locator& locator);

    /// Whether the code variant was given.
    bool is_given() const { return given_.has_value(); }
    /// Returns the given code variant, otherwise the likeliest code variant so far.
    CodeVariant code() const { return given_.value_or(evidence_.likeliest()); }
    /// Returns the evidence of the frames so far; it is used only without a given code variant.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<CodeVariant> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

#pragma GCC visibility pop
