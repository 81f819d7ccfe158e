/// Text without capital letters.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace dotpose::print {

/// The text with A to Z as a to z, whatever the locale; all else stays.
inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char c) {
        return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return lower;
}

}  // namespace dotpose::print
