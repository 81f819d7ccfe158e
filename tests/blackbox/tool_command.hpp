/// Runs `dotpose` as a black box in a temporary directory.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "../paths.hpp"
#include "../shell.hpp"
#include "../temporary_directory.hpp"

namespace dotpose::test {

namespace fs = std::filesystem;

inline std::string read_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A camera file for images of 640 x 480 px, and the error message for images of another size.
inline constexpr const char* kLargeCamera =
    "{format: dotpose-camera, version: 1, width_px: 640, height_px: 480, k_per_px2: 0, "
    "centre_px: [319.5, 239.5]}";
inline constexpr const char* kNotForLargeCamera = ": the camera file is for images of 640 x 480";

/// Shell command that waits until the background process $tool has installed its SIGTERM handler.
/// Before that, SIGTERM would end the process immediately. SIGTERM is bit 14 of the signal mask in
/// /proc.
inline constexpr const char* kUntilItHandlesSignals =
    "until grep -qE '^SigCgt:.*[4-7c-f][0-9a-f]{3}$' /proc/$tool/status || ! kill -0 $tool; "
    "do sleep 0.02; done; ";

class ToolCommand : public testing::Test {
  protected:
    ToolCommand() { fs::create_directory(directory_); }

    /// Runs `dotpose ARGUMENTS` in a shell, and returns the exit code.
    int run(const std::string& arguments, const std::string& input = "/dev/null") {
        return shell("{ \"$T\" " + arguments + "; } <" + input);
    }

    /// Runs shell commands, in which $T is the tool. Returns the exit code.
    int shell(const std::string& commands) {
        const fs::path errors = root_.path() / "errors";
        const ShellOutcome outcome =
            run_shell("cd '" + directory_.string() + "' && T='" + tool_path() + "' && { " +
                      commands + "; } 2>'" + errors.string() + "'");
        exit_code_ = outcome.exit_code;
        output_ = outcome.output;
        errors_ = read_file(errors);
        return exit_code_;
    }

    std::string file(const std::string& name) const { return read_file(directory_ / name); }

    TemporaryDirectory root_;
    const fs::path directory_ = root_.path() / "files";
    int exit_code_ = -1;
    std::string output_;  ///< standard output
    std::string errors_;  ///< standard error
};

}  // namespace dotpose::test
