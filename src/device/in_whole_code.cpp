#include "device/in_whole_code.hpp"

#include "core/decode/position.hpp"
#include "core/decode/window.hpp"
#include "core/integrity/verify.hpp"
#include "core/steps.hpp"
#include "device/workspace.hpp"

namespace dotpose::core {
namespace {

Status read_in_whole_code(const DeviceOptions& options, DeviceWorkspace& w) {
    // The decoder does not need the 8 x 8 window (paper, section II-B.5). The window is computed
    // only for display.
    if (w.keeps_every_stage) w.decoding.window = choose_window(w.grid, kWindowSide);
    choose_region(w);
    // Finds the orientation and the position (paper, sections II-B.6 and II-B.7).
    Status status = decode_briefly(w.grid, options.code, w.line_scores, w.decoding);
    if (status == Status::ok) {
        status = verify_quickly(w.grid, options.code, w.decoding, options.integrity, w.line_scores,
                                w.fix);
    }
    return status == Status::ok ? status : refused(status, w);
}

Status verify_in_whole_code(const DeviceOptions& options, DeviceWorkspace& w) {
    return verify_tracked(options.code, w.tracking.lines, w.tracking.corner, options.integrity,
                          w.decoding, w.fix);
}

}  // namespace

constinit const WholeCodeFunctions kWholeCodeFunctions{read_in_whole_code, verify_in_whole_code};

}  // namespace dotpose::core
