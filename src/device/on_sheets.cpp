#include "device/on_sheets.hpp"

#include <algorithm>

#include "core/decode/upright.hpp"
#include "core/decode/window.hpp"
#include "device/fine_dots.hpp"
#include "device/fine_grid.hpp"
#include "device/hard_block.hpp"
#include "device/sheet_odds.hpp"
#include "device/sheet_search.hpp"
#include "device/small_frame.hpp"
#include "device/workspace.hpp"

namespace dotpose::core {
namespace {

bool read(const DeviceOptions& options, DeviceWorkspace& w) {
    Decoding& decoding = w.decoding;
    decoding.region = choose_window(w.grid, kMaxComparedLines);
    const HardBlock block(w.grid, decoding.region);
    const int lines = std::max(decoding.region.columns, decoding.region.rows);
    const int max_wrong =
        max_wrong_bits(w.known, options.code, block.dots(), lines, options.integrity);
    const auto found = find_on_sheets(block, options.code, w.known.regions, max_wrong);
    if (!found) return false;
    const QuarterTurn turn{found->quarters};
    if (!is_certain_place(w.known, options.code, block.lines(Axis::x, turn.quarters),
                          block.lines(Axis::y, turn.quarters), found->corner, options.integrity,
                          w.fix))
        return false;
    const FixedVec corner = turn(Upright(w.grid, decoding.region, turn).corner());
    decoding.pattern_from_grid = turn;
    decoding.place = moved(options.code, found->corner, -corner.x, -corner.y);
    decoding.bits = 2 * block.dots();
    return true;
}

bool verify(const DeviceOptions& options, DeviceWorkspace& w) {
    const TrackedBlock block(w.tracking.lines, options.code, w.tracking.corner);
    return is_certain_place(w.known, options.code, block.columns(), block.rows(), block.corner(),
                            options.integrity, w.fix);
}

int fit_grid(const DeviceOptions& options, DeviceWorkspace& w) {
    return fit_fine_grid(options.code, w.tracking, w.pattern_from_image, w.fix.displacement_q16);
}

}  // namespace

constinit const SheetFunctions kSheetFunctions{
    read, verify, begin_small_frame, find_dots_of_small_frame, find_fine_dots, fit_grid};

}  // namespace dotpose::core
