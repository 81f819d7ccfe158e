#include "follower_arguments.hpp"

#include <cmath>

#include <fmt/core.h>

#include "choices.hpp"
#include "system/path.hpp"

namespace dotpose::cli {
namespace {

/// Maximum distance of a reference point from the image centre, in px. This limit exceeds the size
/// of any image but is well within the range of fixed-point poses.
constexpr double kMaxReference_px = 10'000;

PixelPoint parse_reference_px(const std::string& text) {
    PixelPoint point;
    const std::size_t comma = text.find(',');
    const auto parse = [](const std::string& number, double& value) {
        return parse_number(number, value) && std::abs(value) <= kMaxReference_px;
    };
    if (comma == std::string::npos || !parse(text.substr(0, comma), point.u) ||
        !parse(text.substr(comma + 1), point.v)) {
        throw ValidationError(
            "--reference",
            fmt::format("'{}' must be two numbers from {} to {}, separated by a comma", text,
                        -kMaxReference_px, kMaxReference_px));
    }
    return point;
}

}  // namespace

void FollowerArguments::fit_to(SourceArguments& sources) {
    if (!sources.fit_to(camera.camera) || !options.reference_px) return;
    options.reference_px->u -= sources.options.region->left;
    options.reference_px->v -= sources.options.region->top;
}

void FollowerArguments::add_files(RunFiles& files) const {
    files.reads("--sheets", sheets);
    files.reads("--camera", camera.path);
    files.reads("--print-map", print_map);
}

FollowerOptions FollowerArguments::read() const {
    FollowerOptions result = options;
    result.camera = camera.camera;
    if (options.fits_space_pose) {
        if (!camera.camera) throw BadArgument("--pose space needs --camera FILE");
        try {
            require_focal_length(*camera.camera);
        } catch (const BadArgument& error) {
            throw Error(fmt::format("{}: {}", camera.path, error.what()));
        }
    }
    if (sheets.empty()) return result;
    result.sheets = read_sheets(system::path_of(sheets));
    if (result.sheets.empty()) throw Error(sheets + " has no sheets");
    if (print_map.empty()) return result;
    result.print_map = read_print_map(system::path_of(print_map));
    try {
        require_pages(result.print_map, result.sheets);
    } catch (const Error& error) {
        throw Error(fmt::format("{}: {}", print_map, error.what()));
    }
    return result;
}

void add_follower_options(Command& command, FollowerArguments& arguments,
                          const std::string& sheets_help) {
    FollowerOptions& options = arguments.options;
    add_spacing_option(command, options.spacing_mm);
    add_code_option(command, options.code);
    Option* const sheets = add_sheets_option(command, arguments.sheets, sheets_help)
                               ->excludes(command.get_option("--spacing"))
                               ->excludes(command.get_option("--code"));
    command
        .add_flag("--only-sheets", options.has_only_sheets,
                  "No other sheet than those of --sheets can be in view: smaller views suffice")
        ->needs(sheets);
    command
        .add_option("--print-map", arguments.print_map,
                    "Map of the printed pages, from 'dotpose calibrate --print-map': correct the "
                    "errors of the print")
        ->type_name("FILE")
        ->needs(sheets);
    command.add_flag("--inverted", arguments.is_inverted, "The dots are white on black");
    add_camera_option(command, arguments.camera,
                      "Camera file from 'dotpose calibrate' or ROS: lens, reference, heading")
        ->excludes(add_lens_option(command, options.locate.lens));
    command
        .add_option_function<std::string>(
            "--reference",
            [&options](const std::string& text) {
                options.reference_px = parse_reference_px(text);
            },
            "Pixel whose place is reported, undistorted; (0, 0) is the centre of the first pixel "
            "of the frame, or of --roi")
        ->type_name("U,V")
        ->default_str("image centre");
    command
        .add_option_function<std::string>(
            "--pose",
            [&options](const std::string& name) { options.fits_space_pose = name == "space"; },
            "Pose to find: plane (of the pattern under the camera), or also that of the camera in "
            "space, which needs --camera with a focal length")
        ->type_name("NAME")
        ->default_str("plane")
        ->check(one_of({"plane", "space"}));
    add_attempt_options(command, ErrorRates::known_or_measured, options.locate);
}

void invert(GreyImage& image) {
    for (std::uint8_t& grey : image.pixels)
        grey = static_cast<std::uint8_t>(255 - grey);
}

}  // namespace dotpose::cli
