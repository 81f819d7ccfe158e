/// Locates the frames of `dotpose watch` on sheets, or on the pattern without sheets, with the
/// predictions of the tracker.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/files/sheet.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/heap_locator.hpp"
#include "dotpose/track.hpp"
#include "locate_record.hpp"
#include "video/frame_source.hpp"

namespace dotpose::cli {

struct LocatorOptions {
    Options locate;
    std::optional<Profile> code;  ///< none if it is found out from the frames
    std::string sheets;           ///< path of the sheet file; empty for none
    double spacing_mm = kDefaultSpacing_mm;
    bool is_inverted = false;
    TrackOptions track;
};

/// The plane in which a robot is tracked.
enum class Plane { pattern, sheet_world };

/// The results of one frame, alone and with the tracker.
struct Reading {
    std::int64_t index = 0;
    std::int64_t time_us = 0;
    Record record;  ///< `p_wrong` takes the prior into account where the fix needed it
    Track track;
    Plane plane = Plane::pattern;
};

class FrameLocator {
  public:
    /// Throws Error if the sheet file cannot be read or has no sheets.
    explicit FrameLocator(const LocatorOptions& options);

    /// Locates a frame. Inverts `frame.image` in place if the options ask for it.
    Reading operator()(video::Frame& frame);

    /// The world if the sheet file has the poses of the sheets in it, otherwise the pattern.
    Plane plane() const { return plane_; }
    const std::vector<SheetEntry>& sheets() const { return sheets_; }
    Trace trace() const { return locator_.trace(); }
    const Options& options() const { return used_; }

  private:
    struct Found {
        Fix fix;
        std::optional<SheetPlace> place;
        CodeReading reading;  ///< if the profile is given, only `CodeReading::code` is set
    };
    /// The newest frame with a fix.
    struct Seen {
        Fix fix;
        Profile profile;
        std::optional<Sighting> sighting;
    };
    void use_sheets();
    std::optional<Prediction> predict(std::int64_t time_us) const;
    Locator& locator(const Options& options);
    Found find(ImageView image, int max_p_wrong_log2, const std::optional<Prediction>& expected);
    Found look(ImageView image, const Options& options,
               const std::optional<Prediction>& expected = {});
    Found look_in_any_code(ImageView image, const std::optional<Prediction>& expected);
    Found without_neighbours(const Found& found, ImageView image);
    std::optional<Sighting> sighting_of(const Found& found, std::int64_t time_us) const;
    double spacing_mm(const Found& found) const;

    LocatorOptions options_;
    std::vector<SheetEntry> sheets_;
    /// The profiles in the order of trying, the one seen last first; empty for any profile.
    std::vector<Profile> profiles_;
    CodeEvidence evidence_;  ///< evidence for each profile from the frames before
    Plane plane_ = Plane::pattern;
    Options used_;  ///< the options for the newest frame
    HeapLocator locator_;
    Tracker tracker_;
    std::optional<Seen> seen_;  ///< none if it is too long ago for a prediction
};

}  // namespace dotpose::cli
