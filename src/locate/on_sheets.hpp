// On sheets: the position of the second attempt on known sheets, where the whole plane is too
// large.
#pragma once

#include "dotpose/device_options.hpp"
#include "locate/workspace.hpp"

namespace dotpose::core {

/// Returns true if the position read is possible: on a known sheet, unless other sheets may be in
/// view.
bool is_possible(CodeVariant code, const DesktopWorkspace& w);

/// Finds the position of the grid on the known sheets. Returns true if it is certain there. Sets
/// the place and the turn of the decoding, and `bit_errors`, `p_wrong_log2` and `prior` of the fix.
bool read_on_sheets(const DeviceOptions& options, DesktopWorkspace& w);

}  // namespace dotpose::core
