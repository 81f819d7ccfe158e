/// Captions next to the live image of `dotpose watch`.
#pragma once

#include <string>
#include <vector>

#include "reading.hpp"

namespace dotpose::cli {

/// Returns the lines of text about a frame: its number and time, its result, the state of the
/// tracker, the sheet, and the pose with the name of its frame of reference. The frame of reference
/// is the world if the sheet file contains world poses. Otherwise, it is the sheet or, without a
/// sheet, the pattern.
std::vector<std::string> panel_text(const Reading& reading);

}  // namespace dotpose::cli
