// Starts `dotpose-live` for the commands that only dotpose-live implements. Commands that read
// frames also start it for cameras and videos.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <unistd.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "live_calibration.hpp"
#include "live_sources.hpp"

namespace dotpose::cli {
namespace {

/// Returns the path of dotpose-live. It is in the libexec directory if dotpose is installed,
/// otherwise beside this program.
std::string live_program() {
    std::error_code failed;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", failed).parent_path();
    const auto installed = (folder / DOTPOSE_LIVE_FROM_TOOL).lexically_normal();
    if (std::filesystem::exists(installed, failed)) return installed.string();
    return (folder / "dotpose-live").string();
}

/// Replaces this process with dotpose-live. Returns only on failure, with errno.
int become_live() {
    std::vector<std::string> words = given_arguments();
    words.insert(words.begin(), "dotpose");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    // Timeout in seconds if a camera delivers no frames. OpenCV reads the variable when it is
    // loaded, so it must be set before the program starts.
    setenv("OPENCV_VIDEOIO_V4L_SELECT_TIMEOUT", "2", 0);
    execv(live_program().c_str(), arguments.data());
    return errno;
}

[[noreturn]] void throw_missing(const std::string& what, int error_number) {
    throw Error(
        fmt::format("{} the program dotpose-live, and {} cannot be started: {}; build it "
                    "(target dotpose_live_cli) and install it beside dotpose",
                    what, live_program(), std::strerror(error_number)));
}

void add_forwarded(Command& app, const char* name, const char* what) {
    Command* command = app.add_subcommand(name, what);
    command->set_help_flag();
    command->prefix_command();
    command->callback(
        [name] { throw_missing(fmt::format("'dotpose {}' needs", name), become_live()); });
}

constexpr const char* kSourcesNeed = "cameras, URLs and videos need";

}  // namespace

void hand_over() {
    throw_missing(kSourcesNeed, become_live());
}

void hand_over_if_possible() {
    static_cast<void>(become_live());
}

std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions&) {
    throw_missing("cannot read " + name + ": " + kSourcesNeed, ENOENT);
}

std::unique_ptr<video::GreyVideo> create_video(const std::string& path, double) {
    throw_missing("cannot write " + path + ": videos need", ENOENT);
}

LensCalibration calibrate_live(const SourceArguments&, Sources&, const CalibrateOptions&,
                               const LiveCalibrationOptions&) {
    throw_missing("calibrate --live needs", become_live());
}

void add_live(Command& app) {
    add_forwarded(app, "watch", "Follow a camera live, or a video frame by frame");
    add_forwarded(app, "fleet", "Show all robots that publish to a broker");
}

}  // namespace dotpose::cli
