#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fmt/core.h>
#include <unistd.h>

#include "common.hpp"
#include "live_program.hpp"
#include "system/process.hpp"

namespace dotpose::cli {
namespace {

/// Returns the path of dotpose-live: in the libexec directory if dotpose is installed, and
/// otherwise next to this program.
std::string live_program() {
    std::error_code failed;
    const auto folder = system::program_folder();
    const auto installed = (folder / DOTPOSE_LIVE_FROM_TOOL).lexically_normal();
    if (std::filesystem::exists(installed, failed)) return installed.string();
    return (folder / "dotpose-live").string();
}

}  // namespace

int become_live() {
    std::vector<std::string> words = given_arguments();
    words.insert(words.begin(), "dotpose");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    // Timeout in seconds for a camera that delivers no frames. OpenCV reads this environment
    // variable when the library is loaded, so the variable must be set before dotpose-live starts.
    setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "2", 0);
    execv(live_program().c_str(), arguments.data());
    return errno;
}

std::string live_program_text(int error_number) {
    return fmt::format(
        "the program dotpose-live, and {} cannot be started: {}; build it (target "
        "dotpose_live_cli) and install it beside dotpose",
        live_program(), std::strerror(error_number));
}

}  // namespace dotpose::cli
