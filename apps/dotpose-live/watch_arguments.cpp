#include "watch_arguments.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>

#include <fmt/core.h>

#include "choices.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/image_file.hpp"
#include "mqtt_arguments.hpp"
#include "robot_name.hpp"

namespace dotpose::cli {
namespace {

/// Maximum DDS domain ID. Higher IDs would require port numbers above 65,535.
constexpr int kLastDomain = 232;

const std::map<std::string, ImageEncoding> kFrameFormats = {
    {"png", ImageEncoding::png},
    {"jpeg", ImageEncoding::jpeg},
    {"pgm", ImageEncoding::pgm},
};

int domain_of_ros() {
    const char* given = std::getenv("ROS_DOMAIN_ID");
    if (given == nullptr || *given == '\0') return 0;
    int number = 0;
    if (parse_number(std::string(given), number) && number >= 0 && number <= kLastDomain) {
        return number;
    }
    throw BadArgument(
        fmt::format("ROS_DOMAIN_ID is '{}', not a number from 0 to {}", given, kLastDomain));
}

void add_output_options(Command& command, WatchArguments& arguments) {
    OutputOptions& outputs = arguments.outputs;
    add_line_options(command, outputs.lines);
    add_draw_option(command, outputs.map, "Draw the path at the end (SVG)");
    const auto add_file = [&command](const char* flag, std::string& path, const char* help) {
        command.add_option(flag, path, help)->type_name("FILE");
    };
    add_file("--log", outputs.log, "Also write all lines as CSV in mm, for dotpose replay");
    add_file("--record", outputs.screen.record, "Video with the overlay (.mp4: H.264, or .avi)");
    add_file("--packets", outputs.packets, "Send pose packets to a file or device");
    add_file("--mcap", outputs.messages.mcap, "Record ROS 2 messages for ros2 bag and Foxglove");
    command.add_flag("--mcap-images", outputs.messages.has_images, "Also record the frames");
    command
        .add_option("--save", arguments.save.folder,
                    "Save frames that show a new place, for dotpose calibrate")
        ->type_name("DIR");
    command.add_option("--save-every", arguments.save.every, "Save every N-th frame instead")
        ->type_name("N")
        ->check(Range(1, 2'000'000'000));
    command
        .add_option_function<std::string>(
            "--image-format",
            [&arguments](const std::string& name) {
                arguments.save.format = kFrameFormats.at(name);
                arguments.outputs.messages.image_format = arguments.save.format;
            },
            "Format of the frames of --save and --mcap-images: png, jpeg (small losses) or pgm "
            "(uncompressed); png is too slow for every frame of a fast camera")
        ->type_name("NAME")
        ->default_str("png")
        ->check(one_of({"png", "jpeg", "pgm"}));
    command.add_flag("--realtime", arguments.is_realtime,
                     "Read recorded frames in real time, as from a camera");
    command.add_flag("--list-cameras", arguments.lists_cameras,
                     "Print the cameras of this computer with their sizes and rates, and exit");
    command.add_flag("--no-window", arguments.has_no_window,
                     "Open no window, even if there is a display");
    command.add_option("--frames", arguments.frames, "End after N frames")
        ->type_name("N")
        ->check(Range(1, 2'000'000'000));
}

void add_publish_options(Command& command, OutputOptions& outputs) {
    outputs.publish.add_to(command, "Name of the robot on the broker and in ROS topics");
    add_frame_prefix_option(command, outputs.messages.frame_prefix);
}

void add_web_options(Command& command, WatchArguments& arguments) {
    arguments.web.add_to(command);
    command
        .add_option("--web-recordings", arguments.web_recordings,
                    "Folder of the recordings that are started in the page of --web")
        ->type_name("DIR")
        ->capture_default_str();
    command
        .add_flag("--web-edit-sheets", arguments.web_edits_sheets,
                  "The page of --web may change the sheet file, and print and measure sheets")
        ->needs(command.get_option("--web"))
        ->needs(command.get_option("--sheets"));
    arguments.calibration.add_to(command);
}

void add_track_options(Command& command, TrackOptions& track, SpaceTrackOptions& space_track) {
    const auto require_positive = Range(1e-3, 1e7);
    command.add_option("--max-speed", track.max_speed_mm_s, "Maximum speed of the robot")
        ->type_name("MM/S")
        ->capture_default_str()
        ->check(require_positive);
    command
        .add_option(
            "--acceleration", track.acceleration_mm_s2,
            "Usual acceleration of the robot: a larger value follows faster and smooths less")
        ->type_name("MM/S^2")
        ->capture_default_str()
        ->check(require_positive);
    command
        .add_option("--camera-acceleration", space_track.acceleration_mm_s2,
                    "Usual acceleration of the camera along an axis, with --pose space")
        ->type_name("MM/S^2")
        ->capture_default_str()
        ->check(require_positive);
    command
        .add_option_function<double>(
            "--max-p-wrong",
            [&track](double p) {
                track.max_p_wrong_log2 = static_cast<int>(std::floor(std::log2(p)));
            },
            "Maximum probability that an accepted position is wrong, including the prior")
        ->type_name("P")
        ->default_str("1e-9")
        ->check(Range(1e-60, 1e-3));
    command
        .add_option_function<double>(
            "--lost-after",
            [&track](double ms) { track.lost_after_us = static_cast<std::int64_t>(ms * 1000); },
            "Time without an accepted fix after which the robot is lost")
        ->type_name("MS")
        ->default_str("70")
        ->check(Range(0.0, 1e9));
}

}  // namespace

void DdsArguments::add_to(Command& command) {
    command.add_flag("--dds", is_wanted, "Publish ROS 2 messages over DDS");
    command.add_flag("--dds-reliable", is_reliable,
                     "Send lost poses again, for subscribers that request it");
    command.add_option("--dds-domain", domain, "Domain of DDS")
        ->type_name("N")
        ->default_str("ROS_DOMAIN_ID, or 0")
        ->check(Range(0, kLastDomain));
}

std::optional<dds::PublisherOptions> DdsArguments::publisher() const {
    if (!is_wanted) return std::nullopt;
    const char* range = std::getenv("ROS_AUTOMATIC_DISCOVERY_RANGE");
    const bool is_local = range != nullptr && std::string_view(range) == "LOCALHOST";
    return dds::PublisherOptions{domain ? *domain : domain_of_ros(), is_reliable, is_local};
}

void WatchArguments::add_to(Command& command) {
    sources.add_to(command);
    add_follower_options(command, follower,
                         "Sheet file: also report the sheet, and track the robot in the world");
    add_track_options(command, follower.options.track, follower.options.space_track);
    add_output_options(command, *this);
    add_publish_options(command, outputs);
    dds.add_to(command);
    add_web_options(command, *this);
}

}  // namespace dotpose::cli
