/// Code evidence: which profile a sheet was printed with, as far as frames tell. Profiles agree on
/// most of the plane, so that many frames can be read in several of them, mostly at the same place
/// and sometimes at places far apart. What one frame leaves open, others of the same sheet decide:
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

/// How likely each profile is for one sheet, by all frames of it so far. Frames of the same dots
/// count once, since their faults are the same.
class CodeEvidence {
  public:
    /// Log odds of the profiles, log2 in 2^-8.
    using LogOdds = std::array<std::int32_t, kProfileCount>;

    /// Frames change a profile's odds against the likeliest one by at most this, in all; so frames
    /// of another sheet can still tell that it is another one.
    static constexpr std::int32_t kMost_log2 = 40;
    /// And those of one place by this: what spoils their dots is not independent.
    static constexpr std::int32_t kMostOfPlace_log2 = 32;

    /// Nothing is known: all profiles are equally likely.
    CodeEvidence() = default;

    Profile likeliest() const;
    /// Log odds against the likeliest, so at most 0.
    std::int32_t log2_q8(Profile profile) const;
    /// Probability, at most 1, that it is another profile.
    float p_wrong(Profile profile) const;

    /// A frame at this cell was seen, whose bits have these likelihoods in the profiles.
    void add(Cell cell, const LogOdds& log2_q8);

  private:
    LogOdds sum() const;

    LogOdds before_log2_q8_{};  ///< of earlier places
    LogOdds here_log2_q8_{};    ///< of the newest place, the least of its frames
    Cell here_;
    std::uint32_t frames_here_ = 0;
};

/// The result of locating one frame whose profile is not given.
struct CodeReading {
    /// With status ambiguous_code, pose and counts are those of one of the two places.
    Fix fix;
    Profile code = Profile::anoto;  ///< in which `fix` is
    CodeEvidence evidence;          ///< with this frame
    /// Another place that explains the frame, in another profile. Of a fix that is ok: its odds
    /// against the fix are part of `p_wrong_log2`.
    bool has_other = false;
    Profile other_code = Profile::anoto;
    Cell other_cell{};  ///< as Fix::cell; fractions and angle are the same
    Section other_section{};
};

class Locator;

/// Locates frames of one sheet, in a profile that is given, or else found out from all of them.
class CodeReader {
  public:
    explicit CodeReader(std::optional<Profile> given = std::nullopt) : given_(given) {}

    /// Locates the image. Afterwards the locator's options have the profile that was read.
    Fix locate(const ImageView& image, Locator& locator);

    bool is_given() const { return given_.has_value(); }
    Profile code() const { return given_.value_or(evidence_.likeliest()); }
    /// Of the frames so far, where the profile is not given.
    const CodeEvidence& evidence() const { return evidence_; }

  private:
    std::optional<Profile> given_;
    CodeEvidence evidence_;
};

}  // namespace dotpose

#pragma GCC visibility pop
