#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/tools/flip.hpp"
#include "dotpose/tools/image_file.hpp"
#include "exit_codes.hpp"
#include "failure_hint.hpp"
#include "frame_saver.hpp"
#include "progress.hpp"
#include "reading.hpp"
#include "run_files.hpp"
#include "terminal_text.hpp"
#include "video/camera_list.hpp"
#include "watch_arguments.hpp"
#include "watch_outputs.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kWatchExamples =
    "Examples:\n"
    "  dotpose watch --list-cameras\n"
    "  dotpose watch 0 --size 640x480 --exposure 50\n"
    "  dotpose watch 0 --save frames            and then: dotpose calibrate frames\n"
    "  dotpose watch http://192.168.4.1:81/stream --sheets sheets.json\n"
    "  dotpose watch run.mp4 --sheets sheets.json --log run.csv --draw run.svg\n"
    "  dotpose watch 'frames/*.pgm' --fps 50 --record run-overlay.mp4\n"
    "  ffmpeg -i run.mp4 -f rawvideo -pix_fmt gray - | dotpose watch - --size 640x480 --fps 30\n\n"
    "One line per frame with the raw and the tracked pose (docs/live.md). A camera delivers its\n"
    "newest frame; the frames in between are dropped and counted. Other sources deliver every\n"
    "frame. Ctrl-C ends.\n";

void report(const WatchOutputs& outputs, std::int64_t dropped) {
    const WatchTally& tally = outputs.tally();
    notify(fmt::format(
        "{} frames, {} fixes, {} times lost, {} times kidnapped, {} frames dropped, "
        "{:.1f} frames/s",
        tally.frames, tally.fixes, tally.lost, tally.kidnapped, dropped, outputs.rate()));
}

RunFiles files_of(const WatchArguments& arguments, const Sources& sources) {
    const OutputOptions& outputs = arguments.outputs;
    RunFiles files;
    sources.add_files(files);
    arguments.calibration.add_files(arguments.follower, files);
    files.reads("--mqtt-ca", outputs.publish.mqtt.ca_file);
    files.reads("--web-token-file", arguments.web.token_file());
    files.writes_lines(outputs.lines.out, content_of(outputs.lines.format));
    files.writes("--log", outputs.log, Content::csv);
    files.writes("--draw", outputs.map, Content::svg);
    files.writes("--record", outputs.screen.record, Content::own);
    files.writes("--packets", outputs.packets, Content::packets);
    files.writes("--mcap", outputs.messages.mcap, Content::mcap);
    return files;
}

/// If most frames fail, reports the reason on standard error. Also reports the first warning of
/// each kind.
void report_problems(const Reading& reading, ImageView image, const Follower& follower,
                     double bits_per_px, FailureHint& hint,
                     std::array<bool, kWarnings>& was_reported) {
    const std::string advice = hint.after(reading, image, follower.used_options(), bits_per_px);
    if (!advice.empty()) notify(advice);
    const auto doubts = warnings(reading.record);
    for (std::size_t i = 0; i < doubts.size(); ++i) {
        if (doubts[i].empty() || std::exchange(was_reported[i], true)) continue;
        notify(fmt::format("frame {}: {}", reading.index, doubts[i]));
    }
}

FollowerOptions options_of(const WatchArguments& arguments) {
    FollowerOptions options = arguments.follower.read();
    options.locate.show_stages = true;  // for the window, its recording and the web page
    options.track.spacing_mm = static_cast<float>(options.spacing_mm);
    return options;
}

/// Saves a frame in its original form, without the inversion and the flip.
void save(FrameSaver& saver, GreyImage& image, const Fix& fix, const WatchArguments& arguments) {
    const auto undo_or_redo = [&] {
        if (arguments.follower.is_inverted) invert(image);
        if (arguments.sources.options.flip) flip(image);
    };
    undo_or_redo();
    saver.take(image.view(), fix);
    undo_or_redo();
}

/// Delays each recorded frame until it is due, to reproduce the timing of the recording.
class Pace {
  public:
    void wait_for(const capture::Frame& frame) {
        using namespace std::chrono;
        // A live frame is due when it arrives, and the first recorded frame is due immediately.
        if (frame.is_live) return;
        if (!begun_) begun_ = steady_clock::now() - microseconds(frame.time_us);
        const auto due = *begun_ + microseconds(frame.time_us);
        while (!interrupted() && steady_clock::now() < due) {
            constexpr steady_clock::duration kMaxSleep = milliseconds(50);
            std::this_thread::sleep_for(std::min(kMaxSleep, due - steady_clock::now()));
        }
    }

  private:
    /// Time on the steady clock that corresponds to time 0 of the source, or nullopt before the
    /// first recorded frame.
    std::optional<std::chrono::steady_clock::time_point> begun_;
};

/// Warns on standard error about sheets without a world pose. Also warns if poses are published
/// without a sheet file, because the published poses are then not in world coordinates.
void tell_frame_of_poses(const WatchArguments& arguments, const Follower& follower) {
    const OutputOptions& outputs = arguments.outputs;
    const bool is_published = !outputs.publish.mqtt.url.empty() || outputs.messages.is_wanted();
    if (follower.sheets().empty()) {
        if (!is_published) return;
        notify(
            "poses are published in the frame of the pattern (y down, angles clockwise): give "
            "--sheets with sheets that have a place in the world (dotpose sheets place)");
        return;
    }
    const auto unplaced = std::ranges::find_if(
        follower.sheets(), [](const SheetEntry& entry) { return !entry.world; });
    if (unplaced == follower.sheets().end()) return;
    constexpr const char* kPartly =
        "the robot is lost on sheets without a place in the world, such as '{}': place them "
        "(dotpose sheets place, dotpose calibrate --stitch)";
    constexpr const char* kPattern =
        "no sheet has a place in the world, so the robot is tracked in the frame of the pattern (y "
        "down, angles clockwise): place the sheets first (dotpose sheets place)";
    notify(follower.is_in_world() ? fmt::format(kPartly, unplaced->name) : kPattern);
}

/// Returns the number of frames to process, or 0 if unknown.
std::int64_t length_of(const WatchArguments& arguments, const Sources& sources,
                       const capture::FrameSource& source) {
    if (arguments.frames > 0) return arguments.frames;
    const std::int64_t images = sources.number_of_images();
    return images > 0 ? images : source.length();
}

/// If the web page or another program has changed the sheets, uses the changed sheets for the
/// following frames.
void use_changed_sheets(Follower& follower, WatchOutputs& outputs) {
    std::optional<std::vector<SheetEntry>> sheets = outputs.take_changed_sheets();
    if (!sheets) return;
    const bool was_in_world = follower.is_in_world();
    try {
        follower.set_sheets(std::move(*sheets));
    } catch (const Error& error) {
        notify(fmt::format("the changed sheets are not used: {}", error.what()));
        return;
    }
    outputs.use_sheets(was_in_world);
}

/// If a camera was calibrated on the web page, uses this camera for the following frames.
void use_calibrated_camera(WatchOutputs& outputs, Follower& follower) {
    const std::optional<Camera> camera = outputs.take_camera();
    if (!camera) return;
    follower.set_camera(*camera);
    notify("a calibration was saved in the page; the next frames are located with it");
}

/// Follows the robot through all frames. `length` is the number of frames, or 0 if unknown. Returns
/// the exit status. Throws BadArgument if the arguments do not match the frames.
int follow(const WatchArguments& arguments, capture::FrameSource& source, std::int64_t length,
           Follower& follower, std::optional<FrameSaver>& saver, WatchOutputs& outputs,
           FailureHint& hint) {
    try {
        capture::Frame frame;
        std::array<bool, kWarnings> was_reported{};
        bool goes_on = true;
        Pace pace;
        ProgressLine progress("following", arguments.outputs.lines.out);
        while (goes_on && source.next(frame)) {
            if (arguments.is_realtime) pace.wait_for(frame);
            use_changed_sheets(follower, outputs);
            if (arguments.follower.is_inverted) invert(frame.image);
            const Reading reading = read(frame, follower);
            report_problems(reading, frame.image.view(), follower, source.bits_per_px(), hint,
                            was_reported);
            if (saver) save(*saver, frame.image, reading.record.fix, arguments);
            goes_on = outputs.take(frame, reading, {source.dropped(), source.bits_per_px()});
            use_calibrated_camera(outputs, follower);
            progress.update(outputs.tally().frames, length);
            if (arguments.frames > 0 && outputs.tally().frames >= arguments.frames) break;
        }
    } catch (const BadArgument&) {
        throw;
    } catch (const Error& error) {
        // Returns an exit status rather than throwing, because the map and the report must still be
        // written for the frames before the failure.
        notify(error.what());
        return kExitFailed;
    }
    return 0;
}

/// Returns the options for the web page, or nullopt if --web is not given.
std::optional<WebOptions> web_options(const WatchArguments& arguments, const Follower& follower) {
    const auto server = arguments.web.options();
    if (!server) return std::nullopt;
    return WebOptions{
        *server,
        arguments.sources.names,
        arguments.web_recordings,
        arguments.outputs.log,
        arguments.outputs.messages,
        {arguments.follower.sheets, arguments.web_edits_sheets, arguments.follower.camera.camera},
        arguments.calibration.options(arguments.follower, arguments.sources, follower)};
}

void print_cameras() {
    const std::vector<video::FoundCamera> cameras = video::find_cameras();
    if (cameras.empty()) fmt::print("{}\n", video::in_one_line(cameras));
    for (const video::FoundCamera& camera : cameras) {
        fmt::print("{}  {}{}{}\n", camera.device, printable(camera.name),
                   camera.problem.empty() ? "" : ": ", camera.problem);
        for (const video::CameraSize& size : camera.sizes) {
            std::string rates;
            for (const double rate : size.rates)
                rates +=
                    fmt::format("{}{:g}", rates.empty() ? "" : ", ", std::round(rate * 100) / 100);
            fmt::print("  {:<12}{:<24}{}\n", size.size, rates.empty() ? "" : rates + " frames/s",
                       fmt::join(size.formats, ", "));
        }
    }
}

/// Runs the command and returns the exit status.
int run(WatchArguments& arguments) {
    if (arguments.lists_cameras) {
        print_cameras();
        return 0;
    }
    if (arguments.save.every > 0 && arguments.save.folder.empty()) {
        throw BadArgument("--save-every needs a folder: --save DIR");
    }
    arguments.calibration.require_page(arguments.web);
    if (arguments.outputs.messages.has_images && arguments.outputs.messages.mcap.empty()) {
        throw BadArgument("--mcap-images needs a file: --mcap FILE");
    }
    if (arguments.outputs.messages.has_images && arguments.save.format == ImageEncoding::pgm) {
        throw BadArgument("--mcap-images records png or jpeg: --image-format jpeg is faster");
    }
    Sources sources(arguments.sources);
    const RunFiles files = files_of(arguments, sources);
    arguments.calibration.require_writable_file();
    catch_interrupts();
    ignore_broken_pipes();
    bool is_unreadable = false;
    capture::SourceOptions source_options = arguments.sources.options;
    source_options.stop = interrupted;
    source_options.notify = notify;
    source_options.before_reading = [&files](const std::string& file) {
        files.require_not_written(file);
    };
    source_options.on_unreadable = [&is_unreadable](const std::string&, const Error& error) {
        notify(error.what());
        is_unreadable = true;
    };
    const auto source = sources.open(source_options);
    source->open();
    Follower follower(options_of(arguments));
    arguments.outputs.messages.dds = arguments.dds.publisher();
    tell_frame_of_poses(arguments, follower);
    arguments.outputs.sheets = arguments.follower.sheets;
    if (source->rate() > 0) arguments.outputs.screen.fps = source->rate();
    arguments.outputs.screen.notify = notify;
    arguments.outputs.messages.robot = arguments.outputs.publish.robot;
    arguments.outputs.messages.camera = arguments.follower.camera.camera;
    arguments.outputs.messages.has_space_pose = follower.fits_space_pose();
    arguments.outputs.screen.has_window = !arguments.has_no_window && video::has_display();
    arguments.outputs.web = web_options(arguments, follower);
    std::optional<FrameSaver> saver;
    if (!arguments.save.folder.empty()) saver.emplace(arguments.save);
    WatchOutputs outputs(arguments.outputs, follower);
    FailureHint hint;
    const std::int64_t length = length_of(arguments, sources, *source);
    int exit_code = follow(arguments, *source, length, follower, saver, outputs, hint);
    try {
        outputs.finish();
    } catch (const Error& error) {
        notify(error.what());
        exit_code = kExitFailed;
    }
    report(outputs, source->dropped());
    if (saver) notify(fmt::format("{} frames saved in {}", saver->saved(), arguments.save.folder));
    if (const std::string why = hint.at_end(); !why.empty()) notify(why);
    // Unreadable images are skipped, but the run fails if none of the images could be read.
    return is_unreadable && outputs.tally().frames == 0 ? kExitFailed : exit_code;
}

}  // namespace

void add_watch(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<WatchArguments>();
    Command* command =
        app.add_subcommand("watch", "Follow a camera live, or a video frame by frame");
    command->footer(kWatchExamples);
    arguments->add_to(*command);
    command->callback([arguments, &exit_code] {
        arguments->calibration.use_replaced_camera(arguments->follower);
        arguments->follower.fit_to(arguments->sources);
        exit_code = run(*arguments);
    });
}

}  // namespace dotpose::cli
