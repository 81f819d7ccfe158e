/// The captions beside the live picture of `dotpose watch`.
#pragma once

#include <string>
#include <vector>

#include "reading.hpp"

namespace dotpose::cli {

/// Returns the lines for a frame: its number and time, how it was located, the state, the sheet,
/// and the pose with the name of the frame of reference that it refers to. That is the world where
/// the sheet file says how its sheets lie; otherwise the sheet; otherwise the pattern.
std::vector<std::string> panel_text(const Reading& reading);

}  // namespace dotpose::cli
