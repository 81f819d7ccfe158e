/// Locates the frames of `dotpose watch`, on sheets or on the bare pattern, with the tracker's
/// prior. Dots are looked for where the frames before lead to expect them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/tools/heap_locator.hpp"
#include "dotpose/tools/sheet.hpp"
#include "dotpose/tools/sheet_file.hpp"
#include "dotpose/track.hpp"
#include "locate_record.hpp"
#include "video/frame_source.hpp"

namespace dotpose::cli {

struct LocatorOptions {
    Options locate;
    std::optional<Profile> code;  ///< none: found out
    std::string sheets;           ///< sheet file; empty: none
    double spacing_mm = kDefaultSpacing_mm;
    bool is_inverted = false;
    TrackOptions track;
};

/// In which plane a robot is tracked.
enum class Plane { pattern, sheet_world };

/// What one frame told, alone and together with those before it.
struct Reading {
    std::int64_t index = 0;
    std::int64_t time_us = 0;
    Record record;  ///< `p_wrong` with the prior, where that was needed
    Track track;
    Plane plane = Plane::pattern;
};

class FrameLocator {
  public:
    /// Throws Error: the sheet file cannot be read or has no sheets.
    explicit FrameLocator(const LocatorOptions& options);

    /// `frame.image` is inverted in place if that was asked for.
    Reading operator()(video::Frame& frame);

    /// The world if the file says where the sheets lie; otherwise the pattern.
    Plane plane() const { return plane_; }
    const std::vector<SheetEntry>& sheets() const { return sheets_; }
    Trace trace() const { return locator_.trace(); }
    const Options& options() const { return used_; }

  private:
    struct Found {
        Fix fix;
        std::optional<SheetPlace> place;
        CodeReading reading;  ///< of which the profile alone counts where that is given
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
    /// To try, in this order; first the one seen last. None: all are in question.
    std::vector<Profile> profiles_;
    CodeEvidence evidence_;  ///< of the frames before
    Plane plane_ = Plane::pattern;
    Options used_;  ///< for the newest frame
    HeapLocator locator_;
    Tracker tracker_;
    std::optional<Seen> seen_;  ///< none if that is too long ago to expect anything
};

}  // namespace dotpose::cli
