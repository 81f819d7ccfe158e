/// Reads untrusted text files, with limits on their size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "dotpose/export.hpp"

// These functions are exported because the tools library uses them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::files {

/// Returns the text of a file or pipe, or nullopt if the file does not exist. Throws Error if the
/// file cannot be read or has more than `max_bytes` bytes. Never reads much beyond this limit,
/// because a pipe or device may be endless.
std::optional<std::string> text_of(const std::filesystem::path& path, std::size_t max_bytes);

/// Reads the next line without its line break. Returns false at the end of the file. Throws Error
/// if reading fails, or if the line is longer than 64 KB. The rest of such a line is not read.
bool next_line(std::istream& stream, std::string& line);

/// Maximum nesting depth of JSON. The files of this project are nested less deeply, and recursive
/// functions do not overflow the stack at this depth.
inline constexpr int kMaxJsonDepth = 64;

/// Parses JSON. Throws Error if the text is not JSON or is nested too deeply. The message contains
/// the position of the error.
nlohmann::json parse_json(const std::string& text);

}  // namespace dotpose::files

DOTPOSE_END_EXPORT
