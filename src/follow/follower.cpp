// Functions used for both single images and sequences, including those that set the sheets and the
// camera file.
#include "dotpose/tools/follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dotpose/tools/flip.hpp"
#include "dotpose/tools/mounted_pose.hpp"

namespace dotpose {

Follower::Follower(const FollowerOptions& options)
    : options_(options),
      unplaced_spacing_mm_(options.spacing_mm),
      used_(options.locate),
      tracker_(options.track),
      space_tracker_(options.space_track) {
    if (options.fits_space_pose) require_space_camera();
    if (options.code) codes_ = {*options.code};
    use_flat_field();
    if (!options.sheets.empty()) use_sheets();
    require_pages(options.print_map, options.sheets);
}

void Follower::use_flat_field() {
    flat_field_.reset();
    if (!options_.camera || options_.camera->flat_field.empty()) return;
    validate(*options_.camera);
    flat_field_.emplace(*options_.camera);
}

void Follower::require_space_camera() const {
    if (!options_.camera) throw BadArgument("a pose in space needs a camera file");
    require_focal_length(*options_.camera);
}

void Follower::set_sheets(std::vector<SheetEntry> sheets) {
    if (sheets.empty()) throw BadArgument("a follower needs at least one sheet");
    require_pages(options_.print_map, sheets);
    options_.sheets = std::move(sheets);
    // Starts a new track, because the track and the prediction are in the coordinates of the
    // previous sheets.
    start_tracks();
    use_sheets();
}

void Follower::start_tracks() {
    tracker_ = Tracker(options_.track);
    space_tracker_ = SpaceTracker(options_.space_track);
    seen_.reset();
}

void Follower::use_sheets() {
    codes_.clear();
    known_.clear();
    is_in_world_ = false;
    unplaced_spacing_mm_ = options_.sheets.front().sheet.pattern.spacing_mm;
    for (const SheetEntry& entry : options_.sheets) {
        const Pattern& pattern = entry.sheet.pattern;
        if (std::ranges::find(codes_, pattern.code) == codes_.end()) {
            codes_.push_back(pattern.code);
        }
        if (pattern.spacing_mm != unplaced_spacing_mm_) {
            unplaced_spacing_mm_ = std::numeric_limits<double>::quiet_NaN();
        }
        if (entry.world) is_in_world_ = true;
        known_.push_back({pattern.code, pattern.section, entry.sheet.origin,
                          static_cast<std::uint32_t>(entry.sheet.columns),
                          static_cast<std::uint32_t>(entry.sheet.rows)});
    }
    const OtherSheets others =
        options_.has_only_sheets ? OtherSheets::impossible : OtherSheets::possible;
    if (locator_.set_known(known_, others) != Status::ok)
        throw BadArgument("the section or the cells of a sheet are outside of the code plane");
}

void Follower::use_options_for(int width_px, int height_px) {
    used_ = options_.locate;
    int& bits_per_error = used_.integrity.bits_per_error;
    if (bits_per_error == kMeasuredErrorRate) bits_per_error = error_rate_.bits_per_error();
    if (options_.camera) use_camera(*options_.camera, width_px, height_px, used_);
    // `space_pose` and `with_print_map` need the dots in the trace.
    if (options_.fits_space_pose || !options_.print_map.pages.empty()) used_.show_stages = true;
    if (options_.reference_px) {
        const auto from_centre_q8 = [](double px, int side_px) {
            return static_cast<std::int32_t>(std::lround((px - (side_px - 1) / 2.0) * 256));
        };
        used_.reference_dx_q8 = from_centre_q8(options_.reference_px->u, width_px);
        used_.reference_dy_q8 = from_centre_q8(options_.reference_px->v, height_px);
    }
}

void Follower::set_camera(const Camera& camera) {
    validate(camera);
    if (options_.fits_space_pose) require_focal_length(camera);
    options_.camera = camera;
    error_rate_ = {};
    use_flat_field();
    // Starts a new track, because the prediction depends on the lens of the previous camera.
    start_tracks();
}

/// Returns the image, flipped and flat-field corrected if the options require it.
ImageView Follower::as_located(ImageView image) {
    if (image.pixels == nullptr) return image;
    if (options_.flip || (options_.camera && options_.camera->flip)) {
        corrected_ = flipped(image);
        image = corrected_.view();
    }
    if (!flat_field_) return image;
    corrected_ = flat_field_->corrected(image);
    return corrected_.view();
}

Locator& Follower::locator(const DeviceOptions& options) {
    locator_.set_options(options);
    return locator_;
}

Follower::Found Follower::by_camera_file(const Fix& seen, const std::optional<SheetPlace>& place,
                                         const CodeReading& reading) const {
    if (!options_.camera) {
        const MappedFix mapped = with_print_map(seen, options_.print_map, locator_.trace());
        return {seen, mapped.fix, place, reading, {}, {}, mapped.use, locator_.compared_bits()};
    }
    const AxisScale print = place ? place->entry->print_scale() : AxisScale{};
    const auto [fix, velocity, map_use] =
        with_camera_and_map(seen, *options_.camera, locator_.trace(), print, options_.print_map);
    return {seen,     fix,
            place,    reading,
            velocity, space_of(seen, place, map_use),
            map_use,  locator_.compared_bits()};
}

/// Returns the pose in space for the latest fix. Uses the print map if the fix used it.
std::optional<SpacePose> Follower::space_of(const Fix& seen, const std::optional<SheetPlace>& place,
                                            MapUse map_use) const {
    if (!options_.fits_space_pose) return std::nullopt;
    const AxisScale print = place ? place->entry->print_scale() : AxisScale{};
    const Trace trace = locator_.trace();
    const MapPage* map = nullptr;
    if (map_use == MapUse::used)
        map = find_page(options_.print_map, trace.options.code, {seen.cell, seen.section});
    return space_pose(with_spacing(seen, place), *options_.camera, image_, trace, print, map);
}

double Follower::spacing_mm(const std::optional<SheetPlace>& place) const {
    return place ? place->entry->sheet.pattern.spacing_mm : unplaced_spacing_mm_;
}

/// Returns the fix with `spacing_nm` set to the spacing of its sheet, or to 0 if the spacing is
/// unknown.
Fix Follower::with_spacing(const Fix& fix, const std::optional<SheetPlace>& place) const {
    Fix result = fix;
    const double mm = spacing_mm(place);
    result.spacing_nm = std::isfinite(mm) ? static_cast<std::int32_t>(std::lround(mm * 1e6)) : 0;
    return result;
}

Located Follower::located(const Found& found, const Fix& fix) const {
    Located result;
    result.reading = found.reading;
    result.velocity = found.velocity;
    if (fix.status == Status::ok) result.map_use = found.map_use;
    if (fix.status == Status::ok) result.space = found.space;
    if (result.space && !result.space->is_ambiguous() && options_.camera->tip)
        result.tip = tip_of(*result.space, *options_.camera->tip, options_.camera->sigma);
    result.place = find_sheet(options_.sheets, found.reading.code, fix);
    result.spacing_mm = spacing_mm(result.place);
    if (options_.camera) {
        const AxisScale print = result.place ? result.place->entry->print_scale() : AxisScale{};
        result.camera_spacing_mm = measured_spacing_mm(fix, *options_.camera, print);
    }
    result.fix = with_spacing(fix, result.place);
    result.code_is_given = !codes_.empty();
    return result;
}

}  // namespace dotpose
