#include "device/small_frame.hpp"

#include <algorithm>

#include "core/detect/undistort.hpp"
#include "core/math/fixed.hpp"
#include "core/steps.hpp"
#include "device/border_dots.hpp"
#include "device/fine_dots.hpp"
#include "device/newest_rows.hpp"
#include "device/workspace.hpp"

namespace dotpose::core {

bool begin_small_frame(int width_px, int height_px, const DeviceOptions& options,
                       DeviceWorkspace& w) {
    Tracking& t = w.tracking;
    t.stride_px = stride_of(width_px);
    if (std::max(width_px, height_px) > kMaxSmallSide_px ||
        t.stride_px * height_px > static_cast<int>(t.rows.size()))
        return false;
    t.width_px = width_px;
    t.height_px = height_px;
    t.left_out_px = 0;
    t.rows_taken = t.first_kept = 0;
    t.min_contrast = static_cast<std::uint8_t>(options.min_contrast);
    t.dots_measured = 0;
    t.next_reading = kFirstFineRow;
    return true;
}

Status find_dots_of_small_frame(const DeviceOptions& options, DeviceWorkspace& w) {
    Tracking& t = w.tracking;
    if (t.rows_taken < kMinKnownFrameSide_px) return Status::too_few_dots;
    t.height_px = t.rows_taken;
    find_fine_dots(t);
    find_border_dots(t);
    if (t.dots_measured == 0) return Status::no_contrast;
    drop_unlike_dots(t);
    w.fix.dots_seen = w.dot_count = t.dots_measured;
    if (w.dot_count < min_dots(options, w)) return Status::too_few_dots;
    const FixedVec middle_q8{(t.width_px - 1) * 128, (t.height_px - 1) * 128};
    const auto dots = first(w.dots, w.dot_count);
    for (DetectedDot& dot : dots)
        dot.centre_q8 = dot.centre_q8 + middle_q8;
    undistort(options.lens, image_centre_q8(w.threshold), dots);  // paper, equations 1 and 2
    return Status::ok;
}

}  // namespace dotpose::core
