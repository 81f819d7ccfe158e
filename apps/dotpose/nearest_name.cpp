#include "nearest_name.hpp"

#include <algorithm>

namespace dotpose::cli {
namespace {

/// Returns the word in ASCII lower case, without leading hyphens.
std::string bare(std::string_view word) {
    word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
    std::string result(word);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

/// Returns the name that begins with `word`. Returns an empty string if there is no such name or
/// more than one, or if `word` has fewer than kMinCharacters characters.
std::string only_continuation(const std::string& word, const std::vector<std::string>& names) {
    constexpr std::size_t kMinCharacters = 2;
    if (word.size() < kMinCharacters) return {};
    std::string found;
    for (const std::string& name : names) {
        if (!bare(name).starts_with(word)) continue;
        if (!found.empty()) return {};
        found = name;
    }
    return found;
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
    // distance[i][j] is the distance between the first i characters of `a` and the first j
    // characters of `b`.
    std::vector<std::vector<int>> distance(a.size() + 1, std::vector<int>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        distance[i][0] = static_cast<int>(i);
    for (std::size_t j = 0; j <= b.size(); ++j)
        distance[0][j] = static_cast<int>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const int replaced = distance[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            const int removed = distance[i - 1][j] + 1;
            const int inserted = distance[i][j - 1] + 1;
            distance[i][j] = std::min({replaced, removed, inserted});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                distance[i][j] = std::min(distance[i][j], distance[i - 2][j - 2] + 1);
        }
    }
    return distance[a.size()][b.size()];
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
    const std::string asked = bare(word);
    std::string nearest;
    // Maximum length of a word that is compared with the names. No name is similar to a longer
    // word, and the distance table of a long word would need too much memory.
    constexpr std::size_t kMaxCharacters = 64;
    if (asked.size() > kMaxCharacters) return nearest;
    int min_distance = static_cast<int>(kMaxCharacters);
    for (const std::string& name : names) {
        const std::string known = bare(name);
        const int distance = edit_distance(asked, known);
        const std::size_t longer = std::max(asked.size(), known.size());
        if (distance < min_distance && distance <= static_cast<int>(longer / 3)) {
            min_distance = distance;
            nearest = name;
        }
    }
    return nearest.empty() ? only_continuation(asked, names) : nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
    const std::string name = nearest_name(word, names);
    return name.empty() ? name : "; did you mean '" + name + "'?";
}

}  // namespace dotpose::cli
