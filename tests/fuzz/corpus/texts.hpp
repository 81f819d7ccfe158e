/// Hand-written seeds: valid input for each reader.
#pragma once

#include <string>
#include <vector>

namespace dotpose::fuzz {

struct TextSeed {
    std::string path;  ///< relative to the folder of the corpus
    std::string bytes;
};

std::vector<TextSeed> text_seeds();

}  // namespace dotpose::fuzz
