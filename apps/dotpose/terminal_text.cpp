#include "terminal_text.hpp"

#include <cstdio>

#include <fmt/core.h>

namespace dotpose::cli {

void tell(std::string_view message) {
    fmt::print(stderr, "dotpose: {}\n", printable(message));
}

}  // namespace dotpose::cli
