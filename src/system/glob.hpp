/// Finds files whose names match a pattern with *, ? and [...].
#pragma once

#include <string>
#include <vector>

#include "dotpose/export.hpp"

// These declarations are exported because several libraries use them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::system {

/// Returns the files that match a shell pattern. The paths are in UTF-8 and sorted. On Windows,
/// only the last part of the path may contain wildcards.
std::vector<std::string> glob(const std::string& pattern);

}  // namespace dotpose::system

DOTPOSE_END_EXPORT
