/// Files whose names match a pattern with *, ? and [...].
#pragma once

#include <string>
#include <vector>

#include "dotpose/export.hpp"

// Exported, because several libraries use these declarations.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::system {

/// Returns the files that match a pattern of a shell, in UTF-8 and sorted. On Windows, only the
/// last part of the pattern, after the folder, may have wildcards.
std::vector<std::string> glob(const std::string& pattern);

}  // namespace dotpose::system

DOTPOSE_END_EXPORT
