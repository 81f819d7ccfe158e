#include "dotpose/calibrate.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calibrate_report.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/image_file.hpp"
#include "progress.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  dotpose calibrate frames/*.png -o camera.yaml --draw camera.svg\n"
    "  dotpose locate --camera camera.yaml frame.png\n\n"
    "Take 5 to 50 frames of any printed sheet, some centimetres and any angle apart.\n"
    "Exit status 1 if the frames do not tell the lens.\n";

struct CalibrateArguments {
    std::vector<std::string> images;
    std::string out;
    std::string picture;
    CalibrateOptions options;
};

int calibrate_lens_of(const CalibrateArguments& arguments) {
    CalibrateOptions options = arguments.options;
    LensCalibration result;
    {
        ProgressLine line("calibrating");
        options.progress = [&line](int done, int total) {
            line.update(done, total);
            return !interrupted();
        };
        const auto frame_at = [&](int index) {
            return read_image(arguments.images[static_cast<std::size_t>(index)]);
        };
        result = calibrate_lens(static_cast<int>(arguments.images.size()), frame_at, options);
    }
    if (!arguments.picture.empty()) draw_calibration(arguments.picture, result);
    if (!arguments.out.empty()) write_camera(arguments.out, result.camera);
    std::fputs(lens_report(result).c_str(), stdout);
    return 0;
}

/// Returns the exit status.
int run(const CalibrateArguments& arguments) {
    if (arguments.images.empty()) throw BadArgument("no images given: name 5 to 50 frames");
    catch_interrupts();
    return calibrate_lens_of(arguments);
}

}  // namespace

void add_calibrate(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<CalibrateArguments>();
    CLI::App* command =
        app.add_subcommand("calibrate", "Find lens and mount of a camera from frames of a sheet");
    command->footer(kExamples);
    command->add_option("images", arguments->images, "PGM, PNG, JPEG, BMP or TIFF files")
        ->type_name("IMAGE");
    command->add_option("-o,--out", arguments->out, "Camera file to write (YAML)")
        ->type_name("FILE");
    command
        ->add_option("--draw", arguments->picture,
                     "Also draw residuals and coverage of the image (.svg)")
        ->type_name("FILE");
    add_spacing_option(*command, arguments->options.pattern.spacing_mm);
    add_code_option(*command, arguments->options.pattern.profile);
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace dotpose::cli
