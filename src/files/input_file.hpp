/// Reads text files that anybody may have written, with limits on their size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

// Visible outside of the library because the tools library calls them too.
#pragma GCC visibility push(default)

namespace dotpose::files {

/// Returns the text of a file or pipe, or none if there is no such file. Throws Error if it cannot
/// be read or has more than `most` bytes; it stops reading there, so that an endless file does not
/// fill the memory.
std::optional<std::string> text_of(const std::filesystem::path& path, std::size_t max_bytes);

/// Reads the next line, without its line break; returns false at the end of the file. Throws Error
/// if the line has more than 64 KB, after which it stops reading, or if reading fails.
bool next_line(std::istream& stream, std::string& line);

/// Deepest nesting of JSON that is read. Files of this project need less, and functions that walk
/// the text recursively have stack enough for it.
inline constexpr int kMostJsonDepth = 64;

/// Parses JSON. Throws Error that says where the text is not JSON, or that it is nested too deeply.
nlohmann::json parse_json(const std::string& text);

}  // namespace dotpose::files

#pragma GCC visibility pop
