/// Paths from texts. All texts of dotpose are UTF-8.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dotpose::system {

/// Returns the path that a text in UTF-8 names. The constructor of std::filesystem::path would
/// convert the text from the code page of Windows.
inline std::filesystem::path path_of(std::string_view utf8) {
    return std::u8string(utf8.begin(), utf8.end());
}

}  // namespace dotpose::system
