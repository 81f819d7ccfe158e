#include <glob.h>

#include "system/glob.hpp"

namespace dotpose::system {

std::vector<std::string> glob(const std::string& pattern) {
    glob_t found{};
    std::vector<std::string> names;
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) {
        names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    globfree(&found);
    return names;
}

}  // namespace dotpose::system
