/// Code evidence: the probability of each profile of a sheet, given its frames. Profiles agree on
/// most of the plane. A frame can therefore often be read in several profiles, usually at the same
/// place, sometimes at distant places. If one frame is ambiguous, other frames of the sheet decide:
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

/// The likelihood of each profile for one sheet, given all frames so far. Frames of the same dots
/// count as one, with their mean, because they share the defects of these dots.
class CodeEvidence {
  public:
    /// log2 of the likelihood or odds of each profile, in 2^-8.
    using LogOdds = std::array<std::int32_t, kProfileCount>;

    /// Maximum change of a profile's odds against the likeliest profile, as log2, by one frame or
    /// by all frames together. With the limit, frames of another sheet can still show that the
    /// sheet has changed.
    static constexpr std::int32_t kMost_log2 = 40;
    /// Maximum change of these odds by the frames of one place, as log2, because defects of the
    /// same dots are not independent.
    static constexpr std::int32_t kMostOfPlace_log2 = 32;

    /// Starts with all profiles equally likely.
    CodeEvidence() = default;

    /// Returns the profile with the highest odds.
    Profile likeliest() const;
    /// Returns the log odds of a profile against the likeliest, in 2^-8 of log2; at most 0.
    std::int32_t log2_q8(Profile profile) const;
    /// Returns the probability, at most 1, that the sheet does not have this profile.
    float p_wrong(Profile profile) const;

    /// Adds a frame located at `cell`, with log2 of the likelihood of its bits in each profile, in
    /// 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< sum over the places before the newest
    /// Sum over the frames of the newest place of the factors by which they make each profile less
    /// likely.
    std::array<float, kProfileCount> factors_here_{};
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// The result of locating one frame without a given profile.
struct CodeReading {
    /// With the status ambiguous_code, pose and counts are those of one of the two places.
    Fix fix;
    Profile code = Profile::anoto;  ///< profile of `fix`
    CodeEvidence evidence;          ///< evidence with this frame added
    /// Whether a place in another profile explains the frame as well. If the fix is ok, the odds of
    /// that place against the fix are part of `p_wrong_log2`.
    bool has_other = false;
    Profile other_code = Profile::anoto;
    Cell other_cell{};  ///< as Fix::cell; fractions and angle are those of `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet, in a given profile or in the detected one.
class CodeReader {
  public:
    /// Uses the given profile, or without one the likeliest profile by all frames.
    explicit CodeReader(std::optional<Profile> given = std::nullopt) : given_(given) {}

    /// Locates an image, and sets the profile in the locator's options to the profile of the fix.
    /// Errors are in the status, as in Locator::locate.
    Fix locate(const ImageView& image, Locator& locator);

    /// Whether the profile was given.
    bool is_given() const { return given_.has_value(); }
    /// Returns the given profile, otherwise the likeliest profile so far.
    Profile code() const { return given_.value_or(evidence_.likeliest()); }
    /// Returns the evidence of the frames so far; it is used only without a given profile.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<Profile> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

#pragma GCC visibility pop
