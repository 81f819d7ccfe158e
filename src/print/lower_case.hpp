/// Converts text to lower case.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace dotpose::print {

/// Returns the text with A to Z replaced by a to z. The result does not depend on the locale.
inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](char c) {
        return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return lower;
}

}  // namespace dotpose::print
