/// Follower: locates images on the sheets of their owner, and follows a robot over them.
///
///     FollowerOptions options;
///     options.sheets = read_sheets("sheets.json");
///     Follower follower(options);
///     for (;;) {
///         const Followed now = follower.follow(image.view(), time_us);
///         if (now.located.place) use(now.located.place->x_mm, now.track.pose);
///     }
///
/// Functions throw BadArgument if an image has not the size that the camera file is for.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/grey_image.hpp"
#include "dotpose/tools/heap_locator.hpp"
#include "dotpose/track.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

struct FollowerOptions {
    Options locate;
    /// The sheets that may be seen. Empty: poses are told in the bare pattern.
    std::vector<SheetEntry> sheets;
    /// The profile of the code, if it is known. Sheets tell theirs; without sheets and without a
    /// profile it is found out from all images together.
    std::optional<Profile> code;
    /// Spacing of the pattern where there are no sheets.
    double spacing_mm = kDefaultSpacing_mm;
    /// Lens, view and mount of the camera. Images must have its size.
    std::optional<Camera> camera;
    /// The pixel whose pose is wanted, instead of the image centre or the camera file's.
    std::optional<PixelPoint> reference_px;
    TrackOptions track;
};

/// What one image tells by itself.
struct Located {
    /// The pose of the reference point, by the camera file if there is one.
    Fix fix;
    std::optional<SheetPlace> place;  ///< of the fix, if it lies on a sheet
    /// The profile, and other places that explain the image. Its fix is that before the camera file
    /// is applied.
    CodeReading reading;
    /// Of the sheet, or of all sheets; not a number where sheets differ and none was found.
    double spacing_mm = 0;
    bool code_is_given = false;  ///< by the options or the sheets
    int reduced_by = 1;          ///< the image was too large and was reduced by this factor
};

/// What an image of a sequence tells, with those before it.
struct Followed {
    Located located;  ///< `p_wrong` with the prior, where the fix needed it
    Track track;
};

class Follower {
  public:
    explicit Follower(const FollowerOptions& options);

    /// Locates an image by itself. One that is larger than `kMaxFrameSide_px` is reduced, unless
    /// there is a camera file. Evidence of the profile adds up over the images.
    Located locate(const GreyImage& image);

    /// Locates the next image of a sequence, taken at `time_us`: the pattern is looked for where
    /// the images before lead to expect it, and a weak fix counts where it was expected.
    Followed follow(ImageView image, std::int64_t time_us);

    /// Whether the robot is tracked in the world of the sheet file (m, y up) instead of the
    /// pattern.
    bool is_in_world() const { return is_in_world_; }
    const std::vector<SheetEntry>& sheets() const { return options_.sheets; }

    /// Of the newest image: what was located (the reduced image, if it was reduced), how, and what
    /// the stages left.
    ImageView image() const { return image_; }
    const Options& used_options() const { return used_; }
    Trace trace() const { return locator_.trace(); }

  private:
    struct Found {
        Fix seen;  ///< before the camera file is applied
        Fix fix;
        std::optional<SheetPlace> place;  ///< of `seen`
        CodeReading reading;
    };
    /// The newest image with a fix.
    struct Seen {
        Fix fix;
        Profile profile;
        std::optional<Sighting> sighting;
    };

    void use_sheets();
    void use_options_for(int width_px, int height_px);
    Locator& locator(const Options& options);
    Fix by_camera_file(const Fix& seen, const std::optional<SheetPlace>& place) const;
    double spacing_mm(const std::optional<SheetPlace>& place) const;
    Located located(const Found& found, const Fix& fix) const;

    // one image
    Found read();
    Found read_in(Profile profile);
    Fix without_surroundings(const Fix& fix, const SheetPlace& place);

    // a sequence
    std::optional<Prediction> predict(std::int64_t time_us) const;
    Found find(int max_p_wrong_log2, const std::optional<Prediction>& expected);
    Found look(ImageView image, const Options& options, const std::optional<Prediction>& expected);
    Found look_in_any_code(const std::optional<Prediction>& expected);
    Found without_neighbours(const Found& found);
    std::optional<Sighting> sighting_of(const Found& found, std::int64_t time_us) const;
    void remember(const Found& found, const std::optional<Sighting>& sighting);

    FollowerOptions options_;
    /// The profiles to try, in this order; the one seen last is the first. Empty: all.
    std::vector<Profile> profiles_;
    CodeEvidence evidence_;       ///< of the images before
    double unplaced_spacing_mm_;  ///< for a fix on no sheet
    bool is_in_world_ = false;
    Options used_;
    ImageView image_;
    GreyImage reduced_;
    HeapLocator locator_;
    Tracker tracker_;
    std::optional<Seen> seen_;  ///< none if that is too long ago to expect anything
};

}  // namespace dotpose

#pragma GCC visibility pop
