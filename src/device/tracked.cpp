#include "device/tracked.hpp"

#include "core/math/fixed.hpp"
#include "core/pose/subgrid.hpp"
#include "core/steps.hpp"
#include "device/coded_cells.hpp"
#include "device/fine_dots.hpp"
#include "device/near_dot.hpp"
#include "device/newest_rows.hpp"
#include "device/predicted.hpp"
#include "device/read_dots.hpp"
#include "device/shift.hpp"
#include "device/tracked_pose.hpp"
#include "device/turn.hpp"

namespace dotpose::core {
namespace {

/// Maximum number of shifts to try. One of the first two shifts is almost always correct.
constexpr int kMaxShifts = 4;

/// Shifts and rotates the predicted cells to fit the dots in the first rows. Error: not_tracked.
Status settle(Tracking& tracking) {
    Shifts shifts(tracking);
    const int paper = shifts.paper_level();
    if (paper == 0) return Status::not_tracked;
    const FixedVec predicted_q16 = tracking.cells.origin_q16;
    for (int tried = 0; tried < kMaxShifts; ++tried) {
        FixedVec shift_q8;
        if (!shifts.next(shift_q8) || shifts.depth() < tracking.min_contrast)
            return Status::not_tracked;
        tracking.cells.origin_q16 = predicted_q16 + FixedVec{shift_q8.x * 256, shift_q8.y * 256};
        // The mass of dots is not known until `find_turn` measures it. Until then, the threshold is
        // midway between paper and ink, and the range of masses is wide.
        tracking.cut_q8 = 128 * shifts.depth() / paper;
        tracking.min_mass = paper / 8 + 16;
        tracking.max_mass = INT16_MAX;
        if (find_turn(tracking)) return Status::ok;
    }
    return Status::not_tracked;
}

/// Reads the dots in the rows received so far. At least `Tracking::first_rows` rows must have been
/// received. Error: not_tracked.
Status read_rows(DeviceWorkspace& w) {
    Tracking& t = w.tracking;
    if (t.is_fine) {
        w.on_sheets->find_dots(t);
        make_room(kRowsAtOnce, t);
        t.first_rows = std::min(t.rows_taken + kRowsAtOnce, t.height_px);
        return Status::ok;
    }
    if (t.rows_taken == t.first_rows) {
        const Status status = settle(t);
        if (status != Status::ok) return status;
        if (!begin_reading(t)) return Status::not_tracked;
    } else if (t.rows_taken < t.next_reading && t.rows_taken != t.height_px) {
        return Status::ok;
    }
    t.next_reading = t.rows_taken + kRowsAtOnce;
    read_ready_dots(t);
    make_room(kRowsAtOnce, t);
    return Status::ok;
}

/// Verifies the predicted place against the bits of the dots. If sheets are known, first tests
/// whether the place is certain on these sheets. If the place is not certain on the known sheets,
/// but other sheets are possible, tests whether it is certain in the whole code. Error:
/// not_certain.
Status verify_place(const DeviceOptions& options, DeviceWorkspace& w) {
    if (w.on_sheets != nullptr) {
        if (w.on_sheets->verify(options, w)) return Status::ok;
        if (w.known.are_all() || w.in_whole_code == nullptr) return Status::not_certain;
    }
    return w.in_whole_code->verify(options, w);
}

/// Verifies the place against the bits of the dots, and fits the plane. Returns the number of dots
/// in the fit, or 0 if the frame is not tracked.
int verify_and_fit(const DeviceOptions& options, DeviceWorkspace& w) {
    Tracking& t = w.tracking;
    const int in_fine_grid = t.is_fine ? w.on_sheets->fit_grid(options, w) : 0;
    w.fix.dots_seen = dots_seen(t);
    w.decoding.place = t.corner;
    if (t.is_fine && in_fine_grid == 0) return 0;
    if (verify_place(options, w) != Status::ok) return 0;
    if (t.is_fine) return in_fine_grid;
    const int used = fit_tracked_pose(t, w.pattern_from_image, w.fix.displacement_q16);
    w.pattern_from_image.centre_q8.y += t.rows_above * 256;
    return used;
}

/// Verifies the place, and writes the pose. Error: not_tracked.
Status confirm(const DeviceOptions& options, DeviceWorkspace& w) {
    const Tracking& t = w.tracking;
    if (t.status != Status::ok) return t.status;
    w.fix.dots_used = verify_and_fit(options, w);
    if (w.fix.dots_used == 0) return Status::not_tracked;
    write_affine_pose(w.pattern_from_image, reference_q8(w.pattern_from_image.centre_q8, options),
                      options.code, t.corner, w.fix);
    return Status::ok;
}

}  // namespace

Status begin_device_tracked(int width_px, int height_px, const DeviceOptions& options,
                            const Prediction& prediction, DeviceWorkspace& w) {
    forget_frame(w);
    w.fix.attempt = Attempt::tracked;
    Tracking& t = w.tracking;
    t.width_px = width_px;
    t.height_px = height_px;
    t.first_kept = 0;
    t.min_contrast = static_cast<std::uint8_t>(options.min_contrast);
    t.min_side_px = w.min_side_px;
    t.dots_measured = 0;
    t.offset_q8 = {};
    t.next_reading = kFirstFineRow;
    // Frames with lens distortion are not tracked, but located without the prediction.
    t.status = options.lens.k_q40 == 0
                   ? lay_predicted_cells(prediction, options.code, w.pattern_from_image, t)
                   : Status::not_tracked;
    // A workspace that keeps every stage is used on processors that are fast enough to locate the
    // whole frame without the prediction. Locating the whole frame is more accurate than tracking
    // only its middle part.
    if (w.keeps_every_stage && t.left_out_px > 0) t.status = Status::not_tracked;
    t.rows_taken = -t.rows_above;
    std::fill(t.lines.begin(), t.lines.end(), ComparedLine{});
    if (t.status == Status::ok) lay_tracked_lines(options.code, t);
    return w.fix.status = t.status;
}

Status push_tracked_row(const std::uint8_t* pixels, DeviceWorkspace& w) {
    Tracking& t = w.tracking;
    const bool is_tracked =
        static_cast<unsigned>(t.rows_taken) < static_cast<unsigned>(t.height_px);
    if (t.status != Status::ok || !is_tracked) {
        // Ignores rows outside the tracked part, and all rows after a failure.
        if (t.rows_taken < 0) ++t.rows_taken;
        return t.status;
    }
    keep_row(pixels, t);
    if (t.rows_taken < t.first_rows) return Status::ok;
    return t.status = read_rows(w);
}

const Fix& finish_device_tracked(const DeviceOptions& options, DeviceWorkspace& w) {
    w.fix.status = confirm(options, w);
    return w.fix;
}

}  // namespace dotpose::core
