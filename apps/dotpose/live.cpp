// Starts `dotpose-live` for commands that only dotpose-live implements, and for commands that read
// frames from cameras or videos.
#include <cerrno>
#include <string>

#include <fmt/core.h>

#include "commands.hpp"
#include "dotpose/files/error.hpp"
#include "live_calibration.hpp"
#include "live_program.hpp"
#include "live_sources.hpp"
#include "reading_sink.hpp"

namespace dotpose::cli {
namespace {

[[noreturn]] void throw_missing(const std::string& what, int error_number) {
    throw Error(what + " " + live_program_text(error_number));
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

std::unique_ptr<ReadingSink> open_publisher(const PublishArguments& arguments, const std::string&) {
    if (arguments.mqtt.url.empty()) return nullptr;
    throw_missing("--mqtt needs", become_live());
}

std::unique_ptr<ReadingSink> open_page(const PageArguments& arguments, const std::string&,
                                       const std::string&) {
    if (arguments.address.empty()) return nullptr;
    throw_missing("--web needs", become_live());
}

void add_live(Command& app) {
    add_forwarded(app, "watch", "Follow a camera live, or a video frame by frame");
    add_forwarded(app, "fleet", "Show all robots that publish to a broker");
}

}  // namespace dotpose::cli
