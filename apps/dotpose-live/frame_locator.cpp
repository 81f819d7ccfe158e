#include "frame_locator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dotpose/files/error.hpp"
#include "page_cut.hpp"

namespace dotpose::cli {
namespace {

constexpr double kNm_per_mm = 1e6;

std::int32_t bam(double angle_rad) {
    const auto turned = std::llround(angle_rad / std::numbers::pi * 2147483648.0);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(turned));
}

}  // namespace

FrameLocator::FrameLocator(const LocatorOptions& options)
    : options_(options), used_(options.locate), tracker_(options.track) {
    used_.show_stages = true;  // for window and recording
    if (options.code) profiles_ = {*options.code};
    if (!options.sheets.empty()) use_sheets();
}

void FrameLocator::use_sheets() {
    sheets_ = read_sheets(options_.sheets);
    if (sheets_.empty()) throw Error(options_.sheets + " has no sheets");
    profiles_.clear();
    options_.spacing_mm = sheets_.front().sheet.pattern.spacing_mm;
    for (const SheetEntry& entry : sheets_) {
        const Pattern& pattern = entry.sheet.pattern;
        if (std::ranges::find(profiles_, pattern.profile) == profiles_.end()) {
            profiles_.push_back(pattern.profile);
        }
        if (pattern.spacing_mm != options_.spacing_mm) {
            options_.spacing_mm = std::numeric_limits<double>::quiet_NaN();
        }
        if (entry.world) plane_ = Plane::sheet_world;
    }
}

/// Predicts where the frame at a time sees the pattern.
std::optional<Prediction> FrameLocator::predict(std::int64_t time_us) const {
    if (!seen_) return std::nullopt;
    if (!seen_->sighting) return Prediction::like(seen_->fix);
    Options options = options_.locate;
    options.profile = seen_->profile;
    return tracker_.predict(time_us, seen_->fix, *seen_->sighting, options);
}

Locator& FrameLocator::locator(const Options& options) {
    locator_.set_options(options);
    return locator_;
}

/// The first fix that lies on a sheet of its profile; otherwise the first fix, or what the last
/// profile told.
FrameLocator::Found FrameLocator::find(ImageView image, int max_p_wrong_log2,
                                       const std::optional<Prediction>& expected) {
    used_.integrity.max_p_wrong_log2 = max_p_wrong_log2;
    if (profiles_.empty()) return look_in_any_code(image, expected);
    Found best;
    for (const Profile profile : profiles_) {
        used_.profile = profile;
        const bool is_expected = expected && seen_ && seen_->profile == profile;
        Found found = look(image, used_, is_expected ? expected : std::nullopt);
        if (sheets_.size() > 1) found = without_neighbours(found, image);
        if (found.place) return found;
        if (best.fix.status != Status::ok) best = found;
    }
    return best;
}

FrameLocator::Found FrameLocator::look(ImageView image, const Options& options,
                                       const std::optional<Prediction>& expected) {
    // The user may have named a wrong code, so without a prediction the other codes are tried as
    // well, to warn about them.
    if (!expected && sheets_.empty()) {
        const CodeReading reading = locator(options).locate_in_code(image);
        return {reading.fix, {}, reading};
    }
    Fix fix = expected ? locator(options).locate(image, *expected) : locator(options).locate(image);
    auto place = find_sheet(sheets_, options.profile, fix);
    // A tracked frame whose centre has left the page may show another page there.
    if (fix.status == Status::ok && fix.attempt == Attempt::tracked && !place && !sheets_.empty()) {
        fix = locator(options).locate(image);
        place = find_sheet(sheets_, options.profile, fix);
    }
    return {fix, place, {fix, options.profile, {}}};
}

FrameLocator::Found FrameLocator::look_in_any_code(ImageView image,
                                                   const std::optional<Prediction>& expected) {
    if (seen_) used_.profile = seen_->profile;
    const CodeReading reading = expected && seen_
                                    ? locator(used_).locate_in_any_code(image, *expected, evidence_)
                                    : locator(used_).locate_in_any_code(image, evidence_);
    used_.profile = reading.code;
    return {reading.fix, {}, reading};
}

/// Locates a frame across the edge of a page again, without the part beyond the edge, if enough
/// dots are left.
FrameLocator::Found FrameLocator::without_neighbours(const Found& found, ImageView image) {
    Found guess = found;
    if (found.fix.status == Status::not_certain) {
        // If the frame shows two patterns, the one that is read better is accepted here, because it
        // is only used to find the edge of its page.
        Options any = used_;
        any.integrity = {.max_p_wrong_log2 = 0, .max_bit_error_q8 = 128};
        guess = look(image, any);
    }
    if (!guess.place) return found;
    const auto cut = cut_to_page(image, used_, guess.fix, *guess.place);
    if (!cut) return found;
    Found again = look(cut->view(), used_, Prediction::like(guess.fix));
    if (!again.place || again.place->entry != guess.place->entry) return found;
    // The prediction for the second call came from the same frame, so it is no tracked fix.
    if (again.fix.attempt == Attempt::tracked) again.fix.attempt = guess.fix.attempt;
    return again;
}

double FrameLocator::spacing_mm(const Found& found) const {
    return found.place ? found.place->entry->sheet.pattern.spacing_mm : options_.spacing_mm;
}

std::optional<Sighting> FrameLocator::sighting_of(const Found& found, std::int64_t time_us) const {
    const double spacing = spacing_mm(found);
    if (found.fix.status != Status::ok || !std::isfinite(spacing)) return std::nullopt;
    Fix fix = found.fix;
    fix.spacing_nm = static_cast<std::int32_t>(std::lround(spacing * kNm_per_mm));
    Sighting sighting = dotpose::sighting_of(fix, time_us);
    if (plane_ == Plane::pattern) return sighting;
    const auto world = found.place ? world_place(*found.place) : std::nullopt;
    if (!world) return std::nullopt;
    sighting.plane = 0;
    sighting.is_y_up = true;
    sighting.x_nm = std::llround(world->x_m * 1e9);
    sighting.y_nm = std::llround(world->y_m * 1e9);
    sighting.theta_bam = bam(world->yaw_rad);
    sighting.covariance = world_covariance(sighting.covariance, found.place->entry->world->yaw_rad);
    return sighting;
}

Reading FrameLocator::operator()(video::Frame& frame) {
    if (options_.is_inverted) {
        for (std::uint8_t& grey : frame.image.pixels)
            grey = static_cast<std::uint8_t>(255 - grey);
    }
    const ImageView image = frame.image.view();
    Found found = find(image, options_.track.max_p_wrong_log2, predict(frame.time_us));
    const Fix strict = found.fix;
    if (strict.status == Status::not_certain && tracker_.has_prior()) {
        // The frame is located without a prediction: the tracker applies its prior to the result,
        // which must not depend on the prior already.
        found = find(image, options_.track.max_weak_p_wrong_log2, {});
    }
    const auto sighting = sighting_of(found, frame.time_us);
    Reading reading;
    reading.index = frame.index;
    reading.time_us = frame.time_us;
    reading.plane = plane_;
    reading.track = tracker_.update(frame.time_us, sighting ? &*sighting : nullptr);
    // A fix with a weak bound counts only if the tracker accepted it with its prior.
    const bool is_fix = strict.status == Status::ok || reading.track.verdict == Verdict::with_prior;
    if (is_fix) {
        seen_ = Seen{found.fix, found.reading.code, sighting};
        if (profiles_.empty()) {
            evidence_ = found.reading.evidence;
        } else {
            std::ranges::iter_swap(profiles_.begin(),
                                   std::ranges::find(profiles_, found.reading.code));
        }
    } else if (!tracker_.has_prior()) {
        seen_.reset();
    }
    Record& record = reading.record;
    record.fix = is_fix ? found.fix : strict;
    record.code_is_given = !profiles_.empty();
    record.reading = found.reading;
    record.reading.fix = record.fix;
    record.reading.evidence = evidence_;
    if (reading.track.verdict == Verdict::with_prior) {
        record.fix.p_wrong_log2 = reading.track.p_wrong_log2;
    }
    record.file = frame.file;
    record.spacing_mm = spacing_mm(found);
    record.has_sheets = !sheets_.empty();
    if (is_fix) record.place = found.place;
    record.elapsed_us = std::numeric_limits<double>::quiet_NaN();
    record.width_px = image.width_px;
    record.height_px = image.height_px;
    record.min_dots = used_.lattice.min_dots;
    record.max_p_wrong_log2 = used_.integrity.max_p_wrong_log2;
    return reading;
}

}  // namespace dotpose::cli
