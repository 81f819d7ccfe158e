/// Throws an Error with the operating system's message about a failure.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "dotpose/files/error.hpp"

namespace dotpose::base {

/// Throws Error with the text "cannot ACTION PATH: REASON". The reason is the system's message for
/// an error code or an errno value.
[[noreturn]] inline void throw_system(const std::string& action, const std::filesystem::path& path,
                                      std::error_code error) {
    throw Error("cannot " + action + " " + path.string() + ": " + error.message());
}
[[noreturn]] inline void throw_system(const std::string& action, const std::filesystem::path& path,
                                      int error_number) {
    throw_system(action, path, std::error_code(error_number, std::generic_category()));
}

}  // namespace dotpose::base
