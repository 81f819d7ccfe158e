#include "paths.hpp"

namespace dotpose::test {

std::string source_dir() {
    return DOTPOSE_SOURCE_DIR;
}

std::string built(const std::string& name) {
    return DOTPOSE_PROGRAMS "/" + name;
}

std::string tool_path() {
    return built("dotpose");
}

}  // namespace dotpose::test
