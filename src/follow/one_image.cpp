// Locates single images.
#include "dotpose/tools/follower.hpp"
#include "follow/page_cut.hpp"
#include "follow/reduced_image.hpp"

namespace dotpose {

using namespace follow_detail;

Located Follower::locate(const GreyImage& image) {
    use_options_for(image.width_px, image.height_px);
    image_ = as_located(image.view());
    // A camera file is valid for only one image size, so images are not reduced if there is a
    // camera file.
    const int by = options_.camera ? 1 : reduction_of(image.width_px, image.height_px);
    if (by > 1) {
        used_ = reduced(used_, image_, by);
        reduced_ = reduced(image_, by);
        image_ = reduced_.view();
    }
    const Found found = read();
    error_rate_.add(found.compared);
    Located result = located(found, in_whole_pixels(found.fix, by));
    result.reduced_by = by;
    if (result.tip) result.is_pen_down = PenContact().take(*result.tip);
    return result;
}

/// If `codes_` is empty, detects the code variant. Otherwise, tries each variant in `codes_`, and
/// returns the first fix that is on one of the sheets. If no fix is on a sheet, returns the first
/// fix. If there is no fix, returns the result for the first variant.
Follower::Found Follower::read() {
    if (codes_.empty()) {
        const CodeReading reading = locator(used_).locate_in_any_code(image_, evidence_);
        evidence_ = reading.evidence;
        used_.code = reading.code;
        return by_camera_file(reading.fix, {}, reading);
    }
    CodeVariant best = codes_.front();
    bool is_found = false;
    Found found;
    ComparedBits compared;
    for (const CodeVariant code : codes_) {
        found = read_in(code);
        if (found.compared.agrees_better_than(compared)) compared = found.compared;
        if (codes_.size() == 1 || find_sheet(options_.sheets, code, found.fix)) return found;
        if (found.fix.status == Status::ok && !is_found) {
            best = code;
            is_found = true;
        }
    }
    // The trace must belong to the returned fix. If another variant was tried after the best one,
    // the image must therefore be located again.
    if (used_.code != best) found = read_in(best);
    if (!is_found) found.compared = compared;
    return found;
}

Follower::Found Follower::read_in(CodeVariant code) {
    used_.code = code;
    const CodeReading reading = locator(used_).locate_in_code(image_);
    const auto place = find_sheet(options_.sheets, code, reading.fix);
    const Fix seen = place ? without_surroundings(reading.fix, *place) : reading.fix;
    return by_camera_file(seen, place, reading);
}

/// If bits disagree with a fix on a known sheet, labels or the tabletop beside the sheet may have
/// been read as dots. In this case, masks everything outside the dots of the sheet and locates the
/// image again. Returns the new fix if fewer bits disagree with it and it uses nearly as many dots.
/// Otherwise, returns `fix`.
Fix Follower::without_surroundings(const Fix& fix, const SheetPlace& place) {
    if (fix.bit_errors == 0) return fix;
    const auto cut = cut_to_dots(image_, used_, fix, place.entry->sheet);
    if (!cut) return fix;
    Fix again = locator(used_).locate(cut->view(), Prediction::like(fix));
    const auto place_again = find_sheet(options_.sheets, used_.code, again);
    const bool is_better = place_again && place_again->entry == place.entry &&
                           again.bit_errors < fix.bit_errors &&
                           again.dots_used + fix.bit_errors >= fix.dots_used;
    if (!is_better) {
        // Locates the image again, so that the trace belongs to the returned fix.
        (void)locator(used_).locate(image_);
        return fix;
    }
    if (again.attempt == Attempt::tracked) again.attempt = fix.attempt;
    // `p_wrong_log2` of the first fix is kept, because this bound accounts for all codes.
    again.p_wrong_log2 = fix.p_wrong_log2;
    return again;
}

}  // namespace dotpose
