/// Finds the known name that is most similar to a misspelt word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dotpose::cli {

/// Returns the minimum number of edits that turn one word into the other. An edit inserts, removes
/// or replaces a character, or swaps two adjacent characters. No character is edited twice, so the
/// distance from "ca" to "abc" is 3.
int edit_distance(std::string_view a, std::string_view b);

/// Returns the name that was probably meant by `word`. This is the nearest name if its edit
/// distance is at most a third of the length of the longer word. Otherwise, it is the only name
/// that begins with `word`. Case and leading hyphens are ignored. Returns an empty string if no
/// name is similar.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// Returns "; did you mean 'NAME'?" with the nearest name, or an empty string if no name is
/// similar.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace dotpose::cli
