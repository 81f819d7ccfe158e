/// Throws an Error with the operating system's reason for a failure.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

#include "dotpose/files/error.hpp"

namespace dotpose::base {

/// Throws Error with the text "cannot ACTION PATH: REASON". REASON is the system's message for
/// `error_number`, a value of errno.
[[noreturn]] inline void throw_system(const std::string& action, const std::filesystem::path& path,
                                      int error_number) {
    throw Error("cannot " + action + " " + path.string() + ": " +
                std::generic_category().message(error_number));
}

}  // namespace dotpose::base
