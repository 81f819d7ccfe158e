/// Finds the known name that is nearest to a misspelt word.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dotpose::cli {

/// Returns how many characters have to be inserted, removed, replaced or exchanged with their
/// neighbour to make one word of the other. No character is changed twice, so "ca" is 3 from "abc".
int edit_distance(std::string_view a, std::string_view b);

/// Returns the name that `word` was probably meant to be: the nearest one, if their distance is at
/// most a third of the longer one, else the only one that begins with the word. Capitals and
/// hyphens at the start do not count. Returns an empty string if no name is like the word.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// Returns "; did you mean 'NAME'?" with the nearest name, or an empty string if there is none.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace dotpose::cli
