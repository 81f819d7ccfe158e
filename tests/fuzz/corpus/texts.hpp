/// Seeds that are written down rather than computed: what each reader was made to read.
#pragma once

#include <string>
#include <vector>

namespace dotpose::fuzz {

struct TextSeed {
    std::string path;  ///< below the folder of the corpus
    std::string bytes;
};

std::vector<TextSeed> text_seeds();

}  // namespace dotpose::fuzz
