/// Writes files atomically: a file appears completely or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "dotpose/export.hpp"
#include "dotpose/language.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Writes `contents` to a temporary file beside the target, and renames the temporary file to the
/// target. Symbolic links are followed, and an existing target keeps its mode. Throws Error if the
/// target is not a regular file or cannot be written.
void write_file(const std::filesystem::path& target, std::string_view contents);

/// Checks that a file can be written. If not, throws the same Error as `write_file`. Intended for
/// use before a long computation whose result is written to the file.
void require_writable(const std::filesystem::path& target);

/// Follows symbolic links at `path` and returns the path of the final target, which need not exist.
/// Returns `path` itself if it is not a link.
std::filesystem::path without_links(std::filesystem::path path);

}  // namespace dotpose

DOTPOSE_END_EXPORT
