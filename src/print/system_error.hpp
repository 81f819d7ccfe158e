/// What the operating system says of a file, as an Error.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "dotpose/tools/error.hpp"

namespace dotpose::print {

/// Throws Error: "cannot ACTION PATH: REASON", the reason being that of a value of errno.
[[noreturn]] inline void throw_system(const std::string& action, const std::filesystem::path& path,
                                      int error_number) {
    throw Error("cannot " + action + " " + path.string() + ": " +
                std::generic_category().message(error_number));
}

}  // namespace dotpose::print
