/// Code evidence: which profile a sheet was printed with, as far as its frames tell. Profiles agree
/// on most of the plane, so many frames can be read in several of them, mostly at the same place
/// and sometimes at places far apart. What one frame leaves open, other frames of the sheet decide:
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

/// How likely each profile is for one sheet, given all its frames so far. Frames that show the same
/// dots count as one, at their mean, since they share the faults of these dots.
class CodeEvidence {
  public:
    /// One value per profile: log2 of its likelihood or odds, in 2^-8.
    using LogOdds = std::array<std::int32_t, kProfileCount>;

    /// Most by which one frame, or all frames together, change a profile's odds against the
    /// likeliest one, as log2. The limit lets frames of another sheet still show that the sheet has
    /// changed.
    static constexpr std::int32_t kMost_log2 = 40;
    /// Most by which the frames of one place change these odds, as log2: faults that spoil the same
    /// dots are not independent.
    static constexpr std::int32_t kMostOfPlace_log2 = 32;

    /// Starts with all profiles equally likely.
    CodeEvidence() = default;

    /// Returns the profile with the highest odds.
    Profile likeliest() const;
    /// Returns the log odds of a profile against the likeliest, in 2^-8 of log2; at most 0.
    std::int32_t log2_q8(Profile profile) const;
    /// Returns the probability, at most 1, that the sheet has another profile than this one.
    float p_wrong(Profile profile) const;

    /// Adds a frame located at `cell`, with log2 of the likelihood of its bits in each profile, in
    /// 2^-8.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< sum over the places before the newest
    /// Newest place: the factors by which its frames make each profile less likely, summed up.
    std::array<float, kProfileCount> factors_here_{};
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// The result of locating one frame whose profile is not given.
struct CodeReading {
    /// With the status ambiguous_code, pose and counts are those of one of the two places.
    Fix fix;
    Profile code = Profile::anoto;  ///< profile in which `fix` was read
    CodeEvidence evidence;          ///< evidence with this frame added
    /// Whether a place in another profile explains the frame as well. If the fix is ok, the odds of
    /// that place against the fix are part of `p_wrong_log2`.
    bool has_other = false;
    Profile other_code = Profile::anoto;
    Cell other_cell{};  ///< as Fix::cell; fractions and angle are those of `fix`
    Section other_section{};
};

class Locator;

/// Locates the frames of one sheet, in a given profile or in the one that the frames show.
class CodeReader {
  public:
    /// Reads in the profile given; without one, in the likeliest by all frames.
    explicit CodeReader(std::optional<Profile> given = std::nullopt) : given_(given) {}

    /// Locates an image; afterwards the locator's options have the profile that was read. Errors
    /// are those of Locator::locate, in the status.
    Fix locate(const ImageView& image, Locator& locator);

    /// Whether the profile was given.
    bool is_given() const { return given_.has_value(); }
    /// Returns the profile that was given, otherwise the likeliest one so far.
    Profile code() const { return given_.value_or(evidence_.likeliest()); }
    /// Returns the evidence of the frames so far; it counts only where no profile was given.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<Profile> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

#pragma GCC visibility pop
