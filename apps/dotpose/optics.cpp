#include "dotpose/tools/optics.hpp"

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/degrees.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kOpticsExamples =
    "Examples:\n"
    "  dotpose optics --device paper\n"
    "  dotpose optics --size 640x480 --pixel 3 --focal 4 --distance 25 --speed 500 --turn 120\n\n"
    "Lengths are those of a thin lens that is focused on the paper. Exit status 1 if the device\n"
    "would not work well.\n";

struct OpticsArguments {
    Optics optics;
    CameraModel size;  ///< only the width and the height are used
    bool is_paper = false;
    double exposures_per_s = 7684;
};

/// Text that explains how the paper rounds its numbers (paper, section III-A).
constexpr const char* kRounding =
    "\nThe paper's numbers, and where it rounds:\n"
    "  5.39 mm    sqrt(2) x 0.508 x 7.5 = 5.388\n"
    "  10.19 mm   diagonal of 8.59 x 5.48 mm = 10.189\n"
    "  0.046 mm   per px: 8.59 / 188 = 0.0457, 5.48 / 120 = 0.0457, rounded up\n"
    "  353 mm/s   0.046 mm x 7684 / s = 353.5, cut off; from 0.0457 it would be 351\n"
    "  4.29 mm    8.59 / 2 = 4.295, cut off\n"
    "  785 rpm    353.5 / 4.295 = 82.3 rad/s = 785.9, cut off; from 4.29 mm it would be 786.8\n"
    "  4.29 mm is the far edge's distance along one axis: a turn blurs along either image axis by\n"
    "  at most this much. The corner, 5.09 mm away, moves by more (one px, 0.046 mm, at 662 "
    "rpm).\n";

int run(OpticsArguments& arguments) {
    if (arguments.is_paper) arguments.optics = paper_optics();
    const Optics& o = arguments.optics;
    const OpticsReport r = design_optics(o);
    fmt::print(
        "field         {:.2f} x {:.2f} mm, diagonal {:.2f} mm ({:.0f} degrees), {:.0f} dots\n",
        r.field_width_mm, r.field_height_mm, r.field_diagonal_mm, r.field_angle_rad * kDegrees,
        r.dots_in_view);
    fmt::print("scale         {:.4f} mm per px, spacing {:.1f} px, dot diameter {:.1f} px\n",
               r.mm_per_px, r.px_per_spacing, r.px_per_dot);
    fmt::print("8 x 8 dots    {:.2f} mm along the diagonal: {}\n", r.block_diagonal_mm,
               r.block_fits_anywhere ? "fit at any angle and place"
               : r.block_fits        ? "fit at any angle"
                                     : "do not fit at every angle");
    // Rounds the speeds down, because they are upper limits.
    fmt::print("exposure      1/{:.0f} s: blur under {:g} px up to {:.0f} mm/s, or {:.0f} rpm\n",
               1 / o.exposure_s, o.largest_blur_px, std::floor(r.fastest_mm_s),
               std::floor(r.fastest_turn_rpm));
    fmt::print("motion        {:g} mm/s and {:g} rpm: blur {:.2f} px; expose at most 1/{:.0f} s\n",
               o.speed_mm_s, o.turn_rpm, r.blur_px, std::ceil(1 / r.longest_exposure_s));
    fmt::print("sharp         from {:.2f} to {:.2f} mm from the lens ({:.2f} mm), f/{:g}\n",
               r.near_mm, r.far_mm, r.depth_mm(), o.f_number);
    int exit_code = 0;
    for (const OpticsAdvice& advice : r.advice) {
        const char* const kind = advice.is_fault ? "CHANGE:" : "note:";
        fmt::print("{}", for_standard_output(fmt::format("{} {}\n", kind, advice.text)));
        if (advice.is_fault) exit_code = kExitFailed;
    }
    if (arguments.is_paper) std::fputs(kRounding, stdout);
    return exit_code;
}

}  // namespace

void add_optics(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<OpticsArguments>();
    Optics& optics = arguments->optics;
    Command* command =
        app.add_subcommand("optics", "What a camera of given parts would see, and what to change");
    command->footer(kOpticsExamples);
    const auto add = [command](const char* flag, auto& value, const char* unit, const char* help) {
        return command->add_option(flag, value, help)->type_name(unit)->capture_default_str();
    };
    Option* paper =
        command
            ->add_option_function<std::string>(
                "--device", [arguments](const std::string&) { arguments->is_paper = true; },
                "paper: the paper's device, and where the paper rounds")
            ->type_name("NAME")
            ->check(one_of({"paper"}));
    add_size_option(*command, arguments->size);
    add("--pixel", optics.pixel_um, "UM", "From pixel to pixel on the sensor, after binning");
    add("--focal", optics.focal_mm, "MM", "Focal length");
    add("--distance", optics.distance_mm, "MM", "From the lens to the paper");
    add("--f-number", optics.f_number, "N", "Focal length over aperture");
    add_spacing_option(*command, optics.spacing_mm);
    double& dot_mm = optics.dot_mm;
    Option* dot = command->add_option("--dot", dot_mm, "Diameter of a dot")
                      ->type_name("MM")
                      ->default_str("spacing/6");
    command->add_option("--exposure", arguments->exposures_per_s, "Exposure time is 1/N s")
        ->type_name("N")
        ->capture_default_str();
    add("--speed", optics.speed_mm_s, "MM/S", "Fastest straight motion");
    add("--turn", optics.turn_rpm, "RPM", "Fastest turn on the spot");
    add("--blur", optics.largest_blur_px, "PX", "Largest motion during the exposure");
    command->add_option("--mm-per-px", optics.mm_per_px, "Measured scale on the paper")
        ->type_name("MM")
        ->default_str("as of a thin lens");
    for (Option* option : command->get_options()) {
        if (option != paper && option->get_name() != "--help") paper->excludes(option);
    }
    command->callback([arguments, dot, &exit_code] {
        Optics& o = arguments->optics;
        o.width_px = arguments->size.width_px;
        o.height_px = arguments->size.height_px;
        o.exposure_s = 1 / arguments->exposures_per_s;
        if (dot->count() == 0) o.dot_mm = o.spacing_mm / 6;
        exit_code = run(*arguments);
    });
}

}  // namespace dotpose::cli
