#include "calibrate_arguments.hpp"

#include <fmt/core.h>

#include "common.hpp"
#include "output_arguments.hpp"

namespace dotpose::cli {
namespace {

/// Parses "camera" or "SHEET=MM".
ScaleReference parse_scale_reference(const std::string& text) {
    if (text == "camera") return {ScaleReference::By::camera, "", 0};
    const std::size_t sign = text.rfind('=');
    ScaleReference reference{ScaleReference::By::width, text.substr(0, sign), 0};
    if (sign == std::string::npos || !parse_number(text.substr(sign + 1), reference.width_mm)) {
        throw ValidationError(
            "--true-scale", fmt::format("'{}' must be camera, or SHEET=MM with the true width of a "
                                        "sheet",
                                        text));
    }
    return reference;
}

void add_live_options(Command& command, CalibrateArguments& arguments) {
    Option* live = command.add_flag(
        "--live", arguments.is_live,
        "Take frames automatically while you move the camera, and show what is still missing");
    for (const char* other :
         {"--spin", "--drive", "--pivot", "--rolling", "--flat", "--stitch", "--print-map"})
        live->excludes(command.get_option(other));
    command
        .add_flag("--no-window", arguments.live.has_no_window,
                  "Show it in the terminal, even if there is a display")
        ->needs(live);
    command
        .add_option("--save", arguments.live.save, "Also save the frames that are taken, as PNG")
        ->type_name("DIR")
        ->needs(live);
}

void add_frame_options(Command& command, CalibrateArguments& arguments) {
    command
        .add_option("--spin", arguments.spin,
                    "Frames of the robot turning on the spot: find its centre (reference_px)")
        ->type_name("SOURCE");
    command
        .add_option("--drive", arguments.drive,
                    "Frames of a straight drive ahead, in order: find the heading (theta_offset)")
        ->type_name("SOURCE");
    command
        .add_option("--pivot", arguments.pivot,
                    "Frames of a pen that pivots about its tip, which rests at one point: find "
                    "the tip (tip_mm); needs the focal length")
        ->type_name("SOURCE");
    command
        .add_option("--rolling", arguments.rolling,
                    "All images of a drive, in order, at the rate of --fps: find the readout time "
                    "of a rolling shutter (readout_ms)")
        ->type_name("IMAGE");
    command
        .add_option("--flat", arguments.flat,
                    "At least 20 images of a sheet under the moving camera, with constant light: "
                    "find the vignetting (flat_field), which is then removed from all frames")
        ->type_name("IMAGE");
    Option* print_map =
        command
            .add_option("--print-map", arguments.print_map,
                        "Frames from all over the pages of --sheets: measure the offset of each "
                        "dot, and write them to the map file of -o, which is updated if it exists")
            ->type_name("SOURCE");
    for (const char* other : {"--spin", "--drive", "--rolling", "--flat"})
        print_map->excludes(command.get_option(other));
}

void add_sheet_options(Command& command, CalibrateArguments& arguments) {
    Option* stitch = command.add_flag("--stitch", arguments.stitch,
                                      "Find the poses of the sheets of a sheet file from frames "
                                      "that show two sheets, and write them into the file");
    Option* sheets = add_sheets_option(command, arguments.sheets,
                                       "Sheet file with the code and spacing of the sheets that "
                                       "the frames show; with --stitch, the sheets to stitch");
    command
        .add_option_function<std::string>(
            "--true-scale",
            [&arguments](const std::string& text) {
                arguments.reference = parse_scale_reference(text);
            },
            "Reference of the print scales: the mm_per_px of the camera file, or the true distance "
            "between the first and the last column of dots of a sheet")
        ->type_name("camera|SHEET=MM")
        ->default_str("the mean of the first sheet")
        ->needs(stitch);
    stitch->needs(sheets);
    stitch->excludes(command.get_option("--out"));
    stitch->excludes(command.get_option("--print-map"));
}

}  // namespace

void CalibrateArguments::add_to(Command& command) {
    sources.add_to(command);
    command
        .add_option("-o,--out", out,
                    "Camera file to write (YAML), or - for standard output; with --print-map, the "
                    "map")
        ->type_name("FILE|-");
    add_draw_option(
        command, picture,
        "Also draw residuals and coverage of the image; with --spin, the turn (as NAME-spin.svg if "
        "the lens is drawn, too); with --stitch, the sheets before and after; with --print-map, "
        "the map of the first page");
    add_camera_option(command, camera,
                      "Camera file to start from: the values that are not calibrated now (lens or "
                      "mount) are kept; without --camera, the file of -o if it exists");
    add_frame_options(command, *this);
    add_sheet_options(command, *this);
    add_live_options(command, *this);
    add_spacing_option(command, options.pattern.spacing_mm);
    add_code_option(command, code);
    command.get_option("--sheets")->excludes(command.get_option("--spacing"));
    command.get_option("--sheets")->excludes(command.get_option("--code"));
}

}  // namespace dotpose::cli
