#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "calibrate_arguments.hpp"
#include "calibrate_print_map.hpp"
#include "calibrate_report.hpp"
#include "calibration_frames.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/camera_file.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/tools/flat_field.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "kept_camera.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "sheet_text.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kCalibrateExamples =
    "Examples:\n"
    "  dotpose calibrate --live 0 -o camera.yaml\n"
    "  dotpose calibrate frames/*.png -o camera.yaml --draw camera.svg\n"
    "  dotpose calibrate video.mp4 --sheets sheets.json -o camera.yaml\n"
    "  dotpose calibrate --camera camera.yaml -o camera.yaml --spin turn/*.png --drive line/*.png\n"
    "  dotpose calibrate --camera camera.yaml -o camera.yaml --pivot pen/*.png\n"
    "  dotpose calibrate --stitch --sheets sheets.json --camera camera.yaml seams/*.png\n"
    "  dotpose calibrate --print-map run.mp4 --sheets sheets.json -o desk.map\n\n"
    "Take 5 to 50 frames of any printed sheet, some centimetres apart and at any angles; for\n"
    "--spin, 12 frames of the robot turning on the spot; for --drive, some frames of it driving\n"
    "straight ahead; for --pivot, 30 frames of a pen that is tilted to all sides while its tip\n"
    "rests; for --rolling, all images of a fast drive; for --flat, 20 or more images of\n"
    "different places in constant light; for --print-map, several hundred frames of a drive over\n"
    "the whole page, in different directions. From a video or a camera, up to 50 frames that\n"
    "show new places are taken; Ctrl-C ends the reading. With --live, a window (or, without a\n"
    "display, the terminal) shows what is still missing while you move the camera; frames are\n"
    "taken until they suffice, or until q or Ctrl-C. Exit status 1 if the frames do not determine\n"
    "the requested values.\n";

/// Frame sources for each part of the calibration. A part without sources is skipped.
struct Series {
    std::optional<Sources> lens;
    std::optional<Sources> spin;
    std::optional<Sources> drive;
    std::optional<Sources> pivot;
    std::optional<Sources> rolling;
    std::optional<Sources> flat;
};

/// Returns a copy of the arguments with `names` as the sources and without a list file.
SourceArguments with_names(SourceArguments arguments, const std::vector<std::string>& names) {
    arguments.names = names;
    arguments.list.clear();
    return arguments;
}

Series series_of(const CalibrateArguments& arguments) {
    const SourceArguments spin = with_names(arguments.sources, arguments.spin);
    const SourceArguments drive = with_names(arguments.sources, arguments.drive);
    const SourceArguments pivot = with_names(arguments.sources, arguments.pivot);
    const SourceArguments rolling = with_names(arguments.sources, arguments.rolling);
    const SourceArguments flat = with_names(arguments.sources, arguments.flat);
    if (arguments.sources.reads_of_standard_input() + spin.reads_of_standard_input() +
            drive.reads_of_standard_input() + pivot.reads_of_standard_input() +
            rolling.reads_of_standard_input() + flat.reads_of_standard_input() >
        1) {
        throw BadArgument("standard input is named twice");
    }
    Series series;
    if (arguments.sources.is_given()) series.lens.emplace(arguments.sources);
    if (spin.is_given()) series.spin.emplace(spin);
    if (drive.is_given()) series.drive.emplace(drive);
    if (pivot.is_given()) series.pivot.emplace(pivot);
    if (rolling.is_given()) series.rolling.emplace(rolling);
    if (flat.is_given()) series.flat.emplace(flat);
    return series;
}

/// Calls `work(frame_count, frame_at, options)` with the frames from the sources and returns its
/// result. Shows a progress line while `work` runs. If the camera has a flat field, `frame_at`
/// applies the flat-field correction.
template <typename Work>
auto with_progress(const CalibrateArguments& arguments, Sources& sources,
                   const std::optional<Camera>& camera, const std::string& what, Work work) {
    CalibrateOptions options = arguments.options;
    const CalibrationFrames frames(arguments.sources, sources, options);
    std::optional<FlatFieldCorrection> correction;
    if (camera && !camera->flat_field.empty()) correction.emplace(*camera);
    const auto frame_at = [&](int index) {
        GreyImage frame = frames.at(index);
        return correction ? correction->corrected(frame.view()) : frame;
    };
    ProgressLine line(what);
    options.progress = [&line](int done, int total) {
        line.update(done, total);
        return !interrupted();
    };
    try {
        return work(frames.count(), frame_at, options);
    } catch (const BadArgument&) {
        throw;
    } catch (const Error& error) {
        if (interrupted() || !frames.are_mirrored(options)) throw;
        throw Error(kMirrored);
    }
}

/// Returns the path of the spin calibration picture. This is the path given to --draw, with "-spin"
/// inserted before the extension if the lens picture is also drawn.
std::string spin_picture_of(const CalibrateArguments& arguments) {
    const bool is_only_picture = arguments.spin.empty() || !arguments.sources.is_given();
    if (arguments.picture.empty() || is_only_picture) return arguments.picture;
    const std::filesystem::path lens = system::path_of(arguments.picture);
    const std::string name = lens.stem().string() + "-spin" + lens.extension().string();
    return (lens.parent_path() / system::path_of(name)).string();
}

/// Writes the camera file to `out`, the value of -o. "-" means standard output. Writes nothing if
/// `out` is empty.
void write_result(const std::string& out, const Camera& camera) {
    if (out.empty()) return;
    const DocumentOutput output(out, ".yaml");
    write_camera(output.path(), camera);
    output.finish();
}

/// Returns the camera for --pivot. Throws BadArgument if no camera is given. Throws Error if the
/// camera has no focal length.
Camera pivot_camera(const std::optional<Camera>& camera, const std::string& path) {
    if (!camera) throw BadArgument("--pivot needs --camera FILE, with a focal length");
    try {
        require_focal_length(*camera);
    } catch (const BadArgument& error) {
        throw Error(path.empty() ? error.what() : fmt::format("{}: {}", path, error.what()));
    }
    return *camera;
}

/// Calibrates the flat field, the lens, the mount, the heading, the pen tip and the readout, in
/// this order. Skips each part that has no frames. Writes the camera file and the pictures, and
/// returns a report.
std::string calibrate_camera(const CalibrateArguments& arguments, Series& series) {
    std::string report;
    std::optional<Camera> camera = arguments.camera.camera;
    if (series.flat) {
        const FlatFieldCalibration flat = with_progress(
            arguments, *series.flat, {}, "measuring the flat field",
            [&](int frames, const FrameAt& frame_at, const CalibrateOptions& options) {
                return calibrate_flat_field(frames, frame_at, camera, options);
            });
        camera = flat.camera;
        report += flat_field_report(flat);
    }
    std::optional<LensCalibration> lens;
    if (series.lens) {
        lens = arguments.is_live ? calibrate_live(arguments.sources, *series.lens,
                                                  arguments.options, arguments.live)
                                 : with_progress(arguments, *series.lens, camera,
                                                 "calibrating the lens", calibrate_lens);
        if (camera) {
            require_size(*camera, lens->camera, arguments.camera.path);
            keep_mount(*camera, lens->camera);
        }
        camera = lens->camera;
        report += lens_report(*lens, arguments.spacing);
        if (arguments.is_live) report += corner_report(*camera);
    }
    const auto go_on = [&](std::optional<Sources>& sources, const char* what, auto calibrate,
                           auto report_of) {
        if (!sources) return;
        const auto found = with_progress(
            arguments, *sources, camera, what,
            [&](int frames, const FrameAt& frame_at, const CalibrateOptions& options) {
                return calibrate(frames, frame_at, camera, options);
            });
        camera = found.camera;
        report += report_of(found);
    };
    go_on(series.spin, "calibrating the mount", calibrate_spin, [&](const SpinCalibration& spin) {
        const std::string picture = spin_picture_of(arguments);
        if (!picture.empty()) draw_spin(system::path_of(picture), spin);
        return spin_report(spin);
    });
    go_on(series.drive, "calibrating the heading", calibrate_drive, drive_report);
    const auto pivot = [&](int frames, const FrameAt& frame_at, const std::optional<Camera>& of,
                           const CalibrateOptions& options) {
        return calibrate_pivot(frames, frame_at, pivot_camera(of, arguments.camera.path), options);
    };
    go_on(series.pivot, "calibrating the tip", pivot, pivot_report);
    const auto readout = [&](int frames, const FrameAt& frame_at, const std::optional<Camera>& of,
                             const CalibrateOptions& options) {
        return calibrate_readout(frames, frame_at, of.value_or(Camera{}),
                                 1000 / *arguments.sources.options.fps, options);
    };
    go_on(series.rolling, "measuring the readout", readout, readout_report);
    if (lens && !arguments.picture.empty())
        draw_calibration(system::path_of(arguments.picture), *lens);
    camera->flip = arguments.sources.options.flip;
    write_result(arguments.out, *camera);
    return report;
}

/// Computes the world poses and print scales of all sheets and writes them to the sheet file.
/// Returns a report.
std::string stitch(const CalibrateArguments& arguments, Sources& sources) {
    SheetFile file(system::path_of(arguments.sheets), {.notify = notify, .stop = interrupted});
    const Stitching stitching = with_progress(
        arguments, sources, arguments.camera.camera, "stitching",
        [&](int frames, const FrameAt& frame_at, const CalibrateOptions& options) {
            return stitch_sheets(frames, frame_at, file.sheets(), arguments.camera.camera, options,
                                 arguments.reference);
        });
    if (!arguments.picture.empty())
        draw_stitching(system::path_of(arguments.picture), file.sheets(), stitching);
    for (const SheetEntry& entry : stitching.sheets)
        file.replace(entry);
    file.save();
    return stitching_report(stitching);
}

/// If --camera is not given and the file given to -o exists, uses this file as the camera file. The
/// values that the calibration does not determine, such as the mount, are then kept.
void keep_camera_of(const std::string& out, CameraArgument& camera) {
    if (!camera.path.empty()) return;
    camera.camera = replaced_camera("-o", out);
    if (!camera.camera) return;
    camera.path = out;
    notify(fmt::format("{} exists: values that are not calibrated now, such as the mount, are kept",
                       out));
}

/// Reads the code and the spacing from the sheet file given to --sheets.
void use_sheets(CalibrateArguments& arguments) {
    if (arguments.sheets.empty() || arguments.stitch) return;
    arguments.spacing = SpacingSource::sheets;
    arguments.options.sheets = read_sheets(system::path_of(arguments.sheets));
    const auto code = common_code(arguments.sheets, arguments.options.sheets);
    arguments.options.any_code = !code;
    if (code) arguments.options.pattern.code = *code;
}

void require_apart(const CalibrateArguments& arguments, const Series& series) {
    RunFiles files;
    for (const auto* sources : {&series.lens, &series.spin, &series.drive, &series.pivot,
                                &series.rolling, &series.flat}) {
        if (*sources) (*sources)->add_files(files);
    }
    if (arguments.stitch) {
        files.updates("--sheets", arguments.sheets, Content::json);
    } else {
        files.reads("--sheets", arguments.sheets);
    }
    // -o and --camera may name the same file. The calibration then replaces only the values that it
    // determines.
    const auto camera = identity_of(arguments.camera.path);
    if (camera && camera == identity_of(arguments.out) &&
        !is_camera_info(system::path_of(arguments.camera.path))) {
        files.updates("-o", arguments.out, Content::yaml);
    } else {
        files.reads("--camera", arguments.camera.path);
        files.writes("-o", arguments.out, Content::yaml);
    }
    files.writes("--draw", arguments.picture, Content::svg);
    const std::string spin_picture = spin_picture_of(arguments);
    if (!arguments.spin.empty() && spin_picture != arguments.picture) {
        files.writes("--draw", spin_picture, Content::svg);
    }
}

/// Creates a print map instead of a camera file. Returns the exit status.
int run_print_map(const CalibrateArguments& arguments) {
    if (arguments.sources.is_given())
        throw BadArgument(
            "--print-map names its frames itself: write all of them after --print-map");
    make_print_map({with_names(arguments.sources, arguments.print_map), arguments.sheets,
                    arguments.camera.path, arguments.camera.camera, arguments.out,
                    arguments.picture});
    return 0;
}

int run(CalibrateArguments& arguments) {
    if (!arguments.print_map.empty()) return run_print_map(arguments);
    const bool has_series = !arguments.spin.empty() || !arguments.drive.empty() ||
                            !arguments.pivot.empty() || !arguments.rolling.empty() ||
                            !arguments.flat.empty();
    if (!arguments.sources.is_given() && !has_series) {
        throw BadArgument("no frames given: name 5 to 50 images, or a video or camera");
    }
    if (arguments.stitch && has_series)
        throw BadArgument(
            "--stitch cannot be combined with --spin, --drive, --pivot, --rolling or --flat");
    if (!arguments.rolling.empty() && !arguments.sources.options.fps.value_or(0))
        throw BadArgument("--rolling needs --fps, the number of frames per second");
    Series series = series_of(arguments);
    require_apart(arguments, series);
    keep_camera_of(arguments.out, arguments.camera);
    use_sheets(arguments);
    // Reports an unwritable output before the user spends minutes moving the camera.
    if (arguments.is_live && !arguments.out.empty())
        require_writable(system::path_of(arguments.out));
    catch_interrupts();
    const std::string report =
        arguments.stitch ? stitch(arguments, *series.lens) : calibrate_camera(arguments, series);
    if (arguments.out == kStandardOutput) {
        std::fputs(report.c_str(), stderr);
    } else {
        std::fputs(for_standard_output(report).c_str(), stdout);
    }
    return 0;
}

}  // namespace

void add_calibrate(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<CalibrateArguments>();
    Command* command =
        app.add_subcommand("calibrate", "Find lens and mount of a camera from frames of a sheet");
    command->footer(kCalibrateExamples);
    arguments->add_to(*command);
    command->callback([arguments, command, &exit_code] {
        arguments->sources.flip_as(arguments->camera.camera);
        arguments->options.any_code = !arguments->code;
        arguments->options.pattern.code = arguments->code.value_or(CodeVariant::anoto);
        if (command->count("--spacing") > 0) arguments->spacing = SpacingSource::option;
        exit_code = run(*arguments);
    });
}

}  // namespace dotpose::cli
