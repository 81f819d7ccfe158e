/// Spellings of options that earlier versions had. They go on working for one release, with a note.
#pragma once

#include <string>
#include <vector>

namespace dotpose::cli {

struct Respelt {
    std::vector<std::string> words;  ///< without the name of the program
    std::vector<std::string> notes;  ///< what was spelt in the earlier way, for the user
};

/// Returns the words of a command line with all options spelt as they are now.
Respelt in_new_spelling(const std::vector<std::string>& words);

/// Returns "OLD is now NEW; the earlier spelling works until the next release".
std::string spelling_note(const std::string& earlier, const std::string& now);

}  // namespace dotpose::cli
