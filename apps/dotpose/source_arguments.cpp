#include "source_arguments.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "capture/source_kind.hpp"
#include "common.hpp"
#include "dotpose/tools/image_file.hpp"
#include "live_sources.hpp"

namespace dotpose::cli {
namespace {

capture::Region parse_region(const std::string& text) {
    const auto numbers = whole_numbers(text, ",,x", kMaxImageSide_px);
    if (!numbers) {
        throw ValidationError(
            "--roi",
            fmt::format("'{}' is not LEFT,TOP,WIDTHxHEIGHT in px, such as 10,20,640x480", text));
    }
    const auto number = [&numbers](std::size_t i) { return static_cast<int>((*numbers)[i]); };
    return {number(0), number(1), number(2), number(3)};
}

const SourceArguments& checked(const SourceArguments& arguments) {
    if (!arguments.is_given()) {
        throw BadArgument(
            "no source of frames given: name images, a folder, a video or a camera, or use --list");
    }
    if (arguments.reads_of_standard_input() > 1) throw BadArgument("standard input is named twice");
    return arguments;
}

}  // namespace

std::int64_t SourceArguments::reads_of_standard_input() const {
    return std::ranges::count(names, "-") + (list == "-" ? 1 : 0);
}

void SourceArguments::add_to(Command& command) {
    command.add_option("sources", names, kSourcesHelp)->type_name("SOURCE");
    command
        .add_option("--list", list, "Read names of sources from a file, or from - (standard input)")
        ->type_name("FILE|-");
    add_frame_options(command);
}

void SourceArguments::add_frame_options(Command& command) {
    command
        .add_option_function<std::string>(
            "--size",
            [this](const std::string& text) {
                const FrameSize size = parse_frame_size("--size", text);
                options.width_px = size.width_px;
                options.height_px = size.height_px;
            },
            "Size of raw frames; of a camera, the size to request")
        ->type_name("WxH");
    command.add_option("--fps", options.fps, "Frames per second of sources that have no times")
        ->type_name("N")
        ->check(Range(0.001, 1e6));
    command
        .add_option("--exposure", options.exposure,
                    "Exposure of a camera, in the unit of its driver")
        ->type_name("N");
    command.add_option("--gain", options.gain, "Gain of a camera, in the unit of its driver")
        ->type_name("N");
    add_flip_option(command, options.flip);
    command
        .add_option_function<std::string>(
            "--roi", [this](const std::string& text) { options.region = parse_region(text); },
            "Part of the frame to use")
        ->type_name("X,Y,WxH");
}

void SourceArguments::flip_as(std::optional<Camera>& camera) {
    if (!camera) return;
    options.flip = options.flip || camera->flip;
    camera->flip = false;
}

bool SourceArguments::fit_to(std::optional<Camera>& camera) {
    flip_as(camera);
    if (!camera) return false;
    const auto& part = options.region;
    const bool is_of_part =
        part && camera->width_px == part->width && camera->height_px == part->height;
    if (!part || is_of_part) return false;
    options.whole_size_px = {camera->width_px, camera->height_px};
    camera = part_of(*camera, part->left, part->top, part->width, part->height);
    return true;
}

Sources::Sources(const SourceArguments& arguments)
    : list_(arguments.list), names_(checked(arguments).names, arguments.list) {
    const bool needs_live = std::ranges::any_of(names_.known(), [](const std::string& name) {
        return capture::needs_video_libraries(capture::kind_of(name));
    });
    if (needs_live) hand_over();
    if (names_.has_pipe()) hand_over_if_possible();
}

void Sources::add_files(RunFiles& files) const {
    files.reads("--list", list_);
    for (const std::string& name : names_.known()) {
        std::vector<std::string> its_files;
        try {
            its_files = capture::files_of(name);
        } catch (const Error&) {
            continue;  // the error is reported when the source is opened
        }
        files.reads("", its_files);
    }
}

std::int64_t Sources::number_of_images() const {
    if (names_.has_pipe()) return 0;
    std::int64_t images = 0;
    for (const std::string& name : names_.known()) {
        const capture::SourceKind kind = capture::kind_of(name);
        if (kind != capture::SourceKind::image && kind != capture::SourceKind::images) return 0;
        try {
            images += static_cast<std::int64_t>(capture::files_of(name).size());
        } catch (const Error&) {
            return 0;  // the error is reported when the source is opened
        }
    }
    return images;
}

std::vector<std::string> Sources::all_names() {
    std::vector<std::string> all;
    while (const auto name = names_.next())
        all.push_back(*name);
    return all;
}

std::vector<std::string> Sources::all_images() {
    std::vector<std::string> images;
    for (const std::string& name : all_names()) {
        const capture::SourceKind kind = capture::kind_of(name);
        if (kind != capture::SourceKind::image && kind != capture::SourceKind::images) {
            throw BadArgument(name + ": --threads is for images, folders and globs");
        }
        const std::vector<std::string> files = capture::files_of(name);
        images.insert(images.end(), files.begin(), files.end());
    }
    return images;
}

std::unique_ptr<capture::SourceList> Sources::open(capture::SourceOptions options) {
    options.open_live = open_live;
    return std::make_unique<capture::SourceList>([this] { return names_.next(); },
                                                 std::move(options));
}

}  // namespace dotpose::cli
