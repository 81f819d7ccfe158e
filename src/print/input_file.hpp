/// Text files of strangers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace dotpose::print {

/// The text of a file or pipe; none if there is no such file. Throws Error if it cannot be read or
/// has more bytes than `most`, of which no more are read: an endless file fills no memory.
std::optional<std::string> text_of(const std::filesystem::path& path, std::size_t most);

/// The next line, without its line break; false at the end. Throws Error if it has more than 64 KB,
/// of which no more are read, or if reading fails.
bool next_line(std::istream& stream, std::string& line);

/// Nested deeper than any file of ours, and shallow enough for the recursion of whoever walks it.
inline constexpr int kMostJsonDepth = 64;

/// Throws Error, which says where the text is no JSON, or that it is nested too deeply.
nlohmann::json parse_json(const std::string& text);

}  // namespace dotpose::print
