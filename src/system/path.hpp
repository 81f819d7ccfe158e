/// Converts text to paths. All text in dotpose is UTF-8.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dotpose::system {

/// Returns the path for a UTF-8 string. On Windows, the constructor of std::filesystem::path would
/// expect another encoding.
inline std::filesystem::path path_of(std::string_view utf8) {
    return std::u8string(utf8.begin(), utf8.end());
}

}  // namespace dotpose::system
