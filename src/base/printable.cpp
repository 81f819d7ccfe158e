#include "base/printable.hpp"

#include <cstddef>
#include <cstdint>

#include <fmt/core.h>

namespace dotpose::base {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

struct Character {
    std::uint32_t code = 0;
    /// Length of the UTF-8 encoding in bytes, or 0 if the string does not start with a valid UTF-8
    /// sequence.
    std::size_t bytes = 0;
};

/// Decodes the first character of a string, which must not be empty. If the UTF-8 sequence is
/// invalid, the result has `bytes` = 0. Overlong sequences, surrogates and code points above
/// U+10FFFF are invalid (Unicode standard, table 3-7).
Character first_of(std::string_view text) {
    const auto byte = [&text](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    if (byte(0) < 0x80) return {byte(0), 1};
    const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
    if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < bytes) return {};
    std::uint32_t code = byte(0) & (0x7FU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3FU);
    }
    constexpr std::uint32_t kMinCode[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < kMinCode[bytes] || code > 0x10FFFF || is_surrogate) return {};
    return {code, bytes};
}

bool is_del_or_c1(std::uint32_t code) {
    return code >= 0x7F && code <= 0x9F;
}

bool acts_on_terminals(std::uint32_t code) {
    const bool breaks_line = code == 0x2028 || code == 0x2029;
    const bool turns_direction = code == 0x061C || code == 0x200E || code == 0x200F ||
                                 (code >= 0x202A && code <= 0x202E) ||
                                 (code >= 0x2066 && code <= 0x2069);
    return code < 0x20 || is_del_or_c1(code) || breaks_line || turns_direction;
}

/// Replaces every character of a string. `shown` appends the replacement for one character to the
/// result. Invalid bytes are passed to `shown` one at a time.
template <typename Shown>
std::string rewritten(std::string_view text, Shown shown) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const Character first = first_of(text);
        const std::string_view bytes = text.substr(0, first.bytes == 0 ? 1 : first.bytes);
        shown(first, bytes, result);
        text.remove_prefix(bytes.size());
    }
    return result;
}

}  // namespace

std::string printable(std::string_view text) {
    return rewritten(text, [](Character c, std::string_view bytes, std::string& result) {
        result += c.bytes == 0 || acts_on_terminals(c.code) ? kReplacement : bytes;
    });
}

std::string with_escaped_controls(std::string_view json) {
    return rewritten(json, [](Character c, std::string_view bytes, std::string& result) {
        if (c.bytes > 0 && is_del_or_c1(c.code)) {
            result += fmt::format("\\u{:04x}", c.code);
        } else {
            result += bytes;
        }
    });
}

}  // namespace dotpose::base
