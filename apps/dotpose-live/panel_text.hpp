/// Captions beside the live picture of `dotpose watch`.
#pragma once

#include <string>
#include <vector>

#include "reading.hpp"

namespace dotpose::cli {

/// Returns the lines for a frame: its number and time, its result, the state, the sheet, and the
/// pose with the name of its frame of reference. The frame of reference is the world if the sheet
/// file contains world poses, otherwise the sheet, otherwise the pattern.
std::vector<std::string> panel_text(const Reading& reading);

}  // namespace dotpose::cli
