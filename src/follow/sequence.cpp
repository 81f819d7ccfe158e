// Follows a robot through a sequence of images, using the predictions and the prior of the tracker.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dotpose/tools/follower.hpp"
#include "follow/page_cut.hpp"

namespace dotpose {
namespace {

using namespace follow_detail;

std::int32_t bam(double angle_rad) {
    const auto turned = std::llround(angle_rad / std::numbers::pi * 2147483648.0);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(turned));
}

}  // namespace

Followed Follower::follow(ImageView image, std::int64_t time_us) {
    use_options_for(image.width_px, image.height_px);
    if (seen_) used_.code = seen_->code;
    image_ = as_located(image);
    Found found = find(options_.track.max_p_wrong_log2, predict(time_us));
    const Fix strict = found.fix;
    if (strict.status == Status::not_certain && tracker_.has_prior()) {
        // Locates the image without a prediction, because the tracker applies its prior to the
        // result. With a prediction, the result would already depend on the prior.
        found = find(options_.track.max_weak_p_wrong_log2, {});
    }
    error_rate_.add(found.compared);
    const auto sighting = sighting_of(found, time_us);
    Followed result;
    result.track = tracker_.update(time_us, sighting ? &*sighting : nullptr);
    // A fix that is certain only with the prior is used only if the tracker accepted it.
    const bool is_with_prior = result.track.verdict == Verdict::with_prior;
    const bool is_fix = strict.status == Status::ok || is_with_prior;
    if (is_fix) {
        remember(found, sighting);
    } else if (!tracker_.has_prior()) {
        seen_.reset();
    }
    result.located = located(found, is_fix ? found.fix : strict);
    if (result.located.tip) result.located.is_pen_down = contact_.take(*result.located.tip);
    if (options_.fits_space_pose)
        result.space_track = track_in_space(result.located, sighting, time_us);
    result.located.reading.fix = result.located.fix;
    result.located.reading.evidence = evidence_;
    if (is_with_prior) result.located.fix.p_wrong_log2 = result.track.p_wrong_log2;
    return result;
}

/// Updates the track of the camera. Ignores a pose in space if the frame has no sighting in the
/// plane, because the planar sighting determines the coordinate frame of the pose.
SpaceTrack Follower::track_in_space(const Located& located, const std::optional<Sighting>& sighting,
                                    std::int64_t time_us) {
    if (!located.space || !sighting) return space_tracker_.update(time_us);
    if (!is_in_world_)
        return space_tracker_.update(
            dotpose::sighting_of(*located.space, time_us, sighting->plane));
    return space_tracker_.update(*dotpose::world_sighting(*located.space, *located.place, time_us));
}

void Follower::remember(const Found& found, const std::optional<Sighting>& sighting) {
    seen_ = Seen{found.fix, found.reading.code, sighting};
    if (codes_.empty()) {
        evidence_ = found.reading.evidence;
    } else {
        std::ranges::iter_swap(codes_.begin(), std::ranges::find(codes_, found.reading.code));
    }
}

std::optional<Prediction> Follower::predict(std::int64_t time_us) const {
    if (!seen_) return std::nullopt;
    if (!seen_->sighting) return Prediction::like(seen_->fix);
    return tracker_.predict(time_us, seen_->fix, *seen_->sighting, used_);
}

/// Tries each code variant, and returns the first fix that is on one of the sheets. If no fix is on
/// a sheet, returns the first fix. If there is no fix, returns the result for the last variant.
Follower::Found Follower::find(int max_p_wrong_log2, const std::optional<Prediction>& expected) {
    used_.integrity.max_p_wrong_log2 = max_p_wrong_log2;
    if (codes_.empty()) return look_in_any_code(expected);
    Found best;
    ComparedBits compared;
    for (const CodeVariant code : codes_) {
        used_.code = code;
        const bool is_expected = expected && seen_ && seen_->code == code;
        Found found = look(image_, used_, is_expected ? expected : std::nullopt);
        if (options_.sheets.size() > 1) found = without_neighbours(found);
        if (found.place) return found;
        if (found.compared.agrees_better_than(compared)) compared = found.compared;
        if (best.seen.status != Status::ok) best = found;
    }
    if (best.seen.status != Status::ok) best.compared = compared;
    return best;
}

Follower::Found Follower::look(ImageView image, const DeviceOptions& options,
                               const std::optional<Prediction>& expected) {
    // The given code may be wrong. Without a prediction and without sheets, the other codes are
    // also tried, so that the user can be warned if a different code is in view.
    if (!expected && options_.sheets.empty()) {
        const CodeReading reading = locator(options).locate_in_code(image);
        return by_camera_file(reading.fix, {}, reading);
    }
    Fix fix = locate_near(image, options, expected);
    auto place = find_sheet(options_.sheets, options.code, fix);
    // A prediction keeps the fix on the same page, but another page may now be at the image centre.
    // If the image centre is not on a known page, locates the image again without the prediction.
    if (fix.status == Status::ok && fix.attempt == Attempt::tracked && !place &&
        !options_.sheets.empty()) {
        fix = locator(options).locate(image);
        place = find_sheet(options_.sheets, options.code, fix);
    }
    return by_camera_file(fix, place, {fix, options.code, {}});
}

/// Locates an image, with the prediction if there is one. The tracked attempt measures dots in
/// small windows at their nominal positions, so the measured centre of a displaced dot is biased
/// towards its nominal position. This bias matters with a print map, because the map contains the
/// displacements. With a print map, the prediction is therefore used only for images that have no
/// fix without it.
Fix Follower::locate_near(ImageView image, const DeviceOptions& options,
                          const std::optional<Prediction>& expected) {
    const bool needs_exact_centres = !options_.print_map.pages.empty();
    if (!expected || needs_exact_centres) {
        const Fix fix = locator(options).locate(image);
        if (!expected || fix.status == Status::ok) return fix;
    }
    return locator(options).locate(image, *expected);
}

Follower::Found Follower::look_in_any_code(const std::optional<Prediction>& expected) {
    const CodeReading reading =
        expected && seen_ ? locator(used_).locate_in_any_code(image_, *expected, evidence_)
                          : locator(used_).locate_in_any_code(image_, evidence_);
    used_.code = reading.code;
    return by_camera_file(reading.fix, {}, reading);
}

/// If an image shows more than the page of the fix, masks everything outside this page and locates
/// the image again. Returns `found` if the fix in the masked image is not on the same sheet, or if
/// there is no such fix.
Follower::Found Follower::without_neighbours(const Found& found) {
    Found guess = found;
    if (found.seen.status == Status::not_certain) {
        // The image may show two patterns. An uncertain fix on the clearer pattern is sufficient
        // here, because it is used only to find the edge of the page.
        DeviceOptions any = used_;
        any.integrity = {.max_p_wrong_log2 = 0, .max_bit_error_q8 = 128};
        guess = look(image_, any, {});
    }
    if (!guess.place) return found;
    const auto cut = cut_to_page(image_, used_, guess.seen, *guess.place);
    if (!cut) return found;
    Found again = look(cut->view(), used_, Prediction::like(guess.seen));
    if (!again.place || again.place->entry != guess.place->entry) return found;
    // The prediction was computed from this image rather than an earlier one, so the fix is not
    // marked as tracked.
    if (again.fix.attempt == Attempt::tracked) {
        again.seen.attempt = again.fix.attempt = guess.seen.attempt;
    }
    return again;
}

std::optional<Sighting> Follower::sighting_of(const Found& found, std::int64_t time_us) const {
    const auto place = find_sheet(options_.sheets, found.reading.code, found.fix);
    if (found.fix.status != Status::ok || !std::isfinite(spacing_mm(place))) return std::nullopt;
    const Fix fix = with_spacing(found.fix, place);
    if (!is_in_world_) return dotpose::sighting_of(fix, time_us);
    return place ? world_sighting(fix, *place, time_us) : std::nullopt;
}

std::optional<Sighting> world_sighting(const Fix& fix, const SheetPlace& place,
                                       std::int64_t time_us) {
    const auto world = world_place(place);
    if (!world) return std::nullopt;
    Sighting sighting = sighting_of(fix, time_us);
    sighting.plane = 0;
    sighting.is_y_up = true;
    sighting.x_nm = std::llround(world->x_m * 1e9);
    sighting.y_nm = std::llround(world->y_m * 1e9);
    sighting.theta_bam = bam(world->yaw_rad);
    sighting.covariance = world_covariance(sighting.covariance, place.entry->world->yaw_rad);
    return sighting;
}

}  // namespace dotpose
