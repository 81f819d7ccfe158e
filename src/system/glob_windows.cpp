#include <algorithm>
#include <filesystem>
#include <string_view>

#include "system/glob.hpp"
#include "system/path.hpp"

namespace dotpose::system {
namespace fs = std::filesystem;
namespace {

/// Removes the character set at the beginning of `pattern`, such as [a-z] or [!0-9]. Returns true
/// if the set matches `c`. Returns false if the closing bracket is missing.
bool matches_set(std::wstring_view& pattern, wchar_t c) {
    const std::size_t end = pattern.find(L']', 2);
    if (end == std::wstring_view::npos) return false;
    std::wstring_view set = pattern.substr(1, end - 1);
    pattern.remove_prefix(end + 1);
    const bool is_inverted = set.front() == L'!' || set.front() == L'^';
    if (is_inverted) set.remove_prefix(1);
    bool is_member = false;
    for (; !set.empty(); set.remove_prefix(1)) {
        const bool is_range = set.size() > 2 && set[1] == L'-';
        is_member = is_member || (is_range ? set[0] <= c && c <= set[2] : set[0] == c);
        if (is_range) set.remove_prefix(2);
    }
    return is_member != is_inverted;
}

bool matches(std::wstring_view pattern, std::wstring_view name) {
    while (!pattern.empty()) {
        const wchar_t next = pattern.front();
        if (next == L'*') {
            pattern.remove_prefix(1);
            for (std::size_t skipped = 0; skipped <= name.size(); ++skipped) {
                if (matches(pattern, name.substr(skipped))) return true;
            }
            return false;
        }
        if (name.empty()) return false;
        if (next == L'[') {
            if (!matches_set(pattern, name.front())) return false;
        } else {
            if (next != L'?' && next != name.front()) return false;
            pattern.remove_prefix(1);
        }
        name.remove_prefix(1);
    }
    return name.empty();
}

}  // namespace

std::vector<std::string> glob(const std::string& pattern) {
    const fs::path path = path_of(pattern);
    const fs::path folder = path.parent_path();
    const std::wstring name_pattern = path.filename().native();
    std::vector<std::string> names;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, failed)) {
        const std::wstring name = entry.path().filename().native();
        const bool is_hidden = name.starts_with(L'.') && !name_pattern.starts_with(L'.');
        if (is_hidden || !matches(name_pattern, name)) continue;
        const std::u8string found = (folder / name).generic_u8string();
        names.emplace_back(found.begin(), found.end());
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace dotpose::system
