/// Finds the known name that is most similar to a misspelt word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dotpose::cli {

/// Returns the minimum number of edits needed to convert one word into the other (optimal string
/// alignment). An edit inserts, removes or replaces a character, or swaps two adjacent characters.
/// No character is edited twice, so the distance from "ca" to "abc" is 3.
int edit_distance(std::string_view a, std::string_view b);

/// Returns the name that was probably meant by `word`, or an empty string if no name is similar.
/// Ignores case and leading hyphens.
/// - If the edit distance of the nearest name is at most a third of the length of the longer word,
///   returns this name.
/// - Otherwise, if `word` has at least two characters and exactly one name begins with `word`,
///   returns this name.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// Returns "; did you mean 'NAME'?" with the nearest name. Returns an empty string if no name is
/// similar.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace dotpose::cli
