#include "dotpose/tools/simulate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "live_sources.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "simulate_output.hpp"
#include "simulated_drive.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kSimulateExamples =
    "Writes frame_000000.pgm, frame_000001.pgm, ... to DIR, and their true poses to truth.csv\n"
    "there. Frames of an earlier run in DIR are removed. The true poses of drive.mp4 are in\n"
    "drive-truth.csv, for dotpose evaluate --poses. Equal options give equal bytes. Angle, place,\n"
    "section and the imperfections of the preset are drawn anew for each frame unless an option\n"
    "fixes them; those of a drive are drawn once.\n\n"
    "Examples:\n"
    "  dotpose simulate -o frames --frames 100 --preset hard\n"
    "  dotpose simulate -o still --preset clean --angle 30 --at 5000.25,7000.5 --noise 3\n"
    "  dotpose simulate -o foreign --scene plain_grid\n"
    "  dotpose simulate -o drive.mp4 --drive --sheets sheets.json --speed 200 --size 320x240\n";

// A command-line option that sets one numeric member of Imperfections.
struct NumberOption {
    const char* flag;
    const char* unit;
    const char* help;
    double Imperfections::*member;
};
constexpr NumberOption kNumberOptions[] = {
    {"--paper-level", "LEVEL", "Grey level of paper at the image centre",
     &Imperfections::paper_level},
    {"--ink", "FRACTION", "Reflectance of ink, relative to paper", &Imperfections::ink_reflectance},
    {"--palest-ink", "FRACTION", "Contrast of the palest of four inks, one for each direction",
     &Imperfections::palest_ink},
    {"--ink-variation", "FRACTION", "Standard deviation of the ink between dots",
     &Imperfections::ink_variation},
    {"--vignetting", "FRACTION", "Loss of light in the corners", &Imperfections::vignetting},
    {"--fall", "FRACTION", "Change of light from side to side", &Imperfections::fall},
    {"--blur", "PX", "Sigma of the lens's blur", &Imperfections::blur_sigma_px},
    {"--noise", "LEVELS", "Sigma of the sensor's noise", &Imperfections::noise_sigma},
    {"--fixed-pattern", "LEVELS", "Sigma of the offsets of the pixels, the same in all frames",
     &Imperfections::fixed_pattern},
    {"--salt-pepper", "FRACTION", "Black or white pixels", &Imperfections::salt_and_pepper},
    {"--jitter", "MM", "Standard deviation of the dot positions, per axis",
     &Imperfections::jitter_mm},
    {"--missing", "FRACTION", "Dots that are missing", &Imperfections::missing},
    {"--texture", "FRACTION", "Standard deviation of the paper's reflectance",
     &Imperfections::texture},
};

// Two numbers given as one argument, "A,B".
struct Pair {
    std::vector<double> values;
    bool given() const { return values.size() == 2; }
};

struct SimulateArguments {
    std::string out;
    int frames = 10;
    bool drives = false;
    std::string sheets;
    DriveOptions drive;
    Setup setup;
    PatternArguments pattern;
    std::optional<Scene> scene;
    double density = 0.5;
    std::optional<double> angle_deg;
    Pair at_grid;
    Pair motion_px;
    Pair readout_px;
    std::optional<double> readout_turn_deg;
    Pair tilt_deg;
    Pair covered;
    int islands = 0;
    bool on_table = false;
    std::optional<int> dirt_blobs;
    std::optional<int> graphics;
    std::optional<double> numbers[std::size(kNumberOptions)];
};

Vec2 to_vec(const Pair& pair) {
    return {pair.values[0], pair.values[1]};
}

// Returns the shot for a frame. Values from the command line replace random values.
Shot shot_of(const SimulateArguments& arguments, int index) {
    Shot shot = draw_shot(arguments.setup, static_cast<std::uint64_t>(index));
    Imperfections& seen = shot.imperfections;
    for (std::size_t i = 0; i < std::size(kNumberOptions); ++i) {
        if (arguments.numbers[i]) seen.*kNumberOptions[i].member = *arguments.numbers[i];
    }
    if (arguments.dirt_blobs) seen.dirt_blobs = *arguments.dirt_blobs;
    if (arguments.graphics) seen.graphics = *arguments.graphics;
    if (arguments.motion_px.given()) seen.motion_px = to_vec(arguments.motion_px);
    if (arguments.readout_px.given()) shot.camera.readout_px = to_vec(arguments.readout_px);
    if (arguments.readout_turn_deg)
        shot.camera.readout_turn_rad = *arguments.readout_turn_deg / kDegrees;

    CameraPose& pose = shot.pose;
    if (arguments.angle_deg) {
        // Normalises the angle to the range (-180, 180] degrees.
        pose.theta_rad = -std::remainder(-*arguments.angle_deg, 360) / kDegrees;
    }
    if (arguments.tilt_deg.given()) {
        pose.tilt_x_rad = to_vec(arguments.tilt_deg).x / kDegrees;
        pose.tilt_y_rad = to_vec(arguments.tilt_deg).y / kDegrees;
    }
    if (arguments.at_grid.given()) {
        const Vec2 at = to_vec(arguments.at_grid);
        pose.cell = {static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y)};
        pose.fraction_x = at.x - pose.cell.x;
        pose.fraction_y = at.y - pose.cell.y;
    }
    if (arguments.covered.given() || arguments.islands > 0 || arguments.on_table) {
        PartialView view;
        view.islands = arguments.islands;
        view.on_table = arguments.on_table;
        if (arguments.covered.given()) {
            view.min_fraction = to_vec(arguments.covered).x;
            view.max_fraction = to_vec(arguments.covered).y;
            view.min_dots = 0;
        }
        cover_partly(shot, view);
    }
    return shot;
}

/// True pose of a simulated frame, and the pattern that the frame shows.
struct Truth {
    /// None if the frame shows a scene, or if the image centre is between sheets.
    std::optional<CameraPose> pose;
    Pattern pattern;
};

/// Returns a row of truth.csv. The pose columns of a frame without a pose are empty.
std::string truth_row(const SimulateArguments& arguments, const std::string& file,
                      const Truth& truth) {
    const Pattern& pattern = truth.pattern;
    std::string pose = ",,,,,,";
    if (truth.pose) {
        const double x = x_grid(*truth.pose);
        const double y = y_grid(*truth.pose);
        pose = fmt::format("{:.7f},{:.7f},{:.9f},{:.8f},{:.8f},{},{}", x * pattern.spacing_mm,
                           y * pattern.spacing_mm, truth.pose->theta_rad * kDegrees, x, y,
                           pattern.section.u, pattern.section.v);
    }
    return fmt::format("{},{},{},{},{:.9g},{},{}\n", file, pose, code_name(pattern.code),
                       pattern.spacing_mm, pattern.spacing_mm / arguments.setup.camera.mm_per_px,
                       name(arguments.setup.preset), arguments.setup.seed);
}

struct MadeFrame {
    GreyImage image;
    Truth truth;
};

MadeFrame make_frame(const SimulateArguments& arguments, const std::optional<SimulatedDrive>& drive,
                     int index) {
    if (drive) {
        const PoseOnSheet place = drive->pose(index);
        return {drive->image(index),
                {place.is_on_page ? std::optional(place.pose) : std::nullopt,
                 place.entry->sheet.pattern}};
    }
    const Shot shot = shot_of(arguments, index);
    if (!arguments.scene) return {render(shot), {shot.pose, shot.page.pattern}};
    return {render_scene(*arguments.scene, shot, arguments.density), {{}, shot.page.pattern}};
}

/// Renders the frames from `first` to `end` - 1 on all cores.
std::vector<MadeFrame> make_frames(const SimulateArguments& arguments,
                                   const std::optional<SimulatedDrive>& drive, int first, int end) {
    std::vector<MadeFrame> frames(static_cast<std::size_t>(end - first));
    std::vector<std::exception_ptr> errors(frames.size());
    std::atomic<int> next = first;
    const auto work = [&] {
        for (int index = next++; index < end; index = next++) {
            const auto slot = static_cast<std::size_t>(index - first);
            try {
                frames[slot] = make_frame(arguments, drive, index);
            } catch (...) {
                errors[slot] = std::current_exception();
            }
        }
    };
    {
        std::vector<std::jthread> threads;
        const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
        for (unsigned i = 1; i < cores; ++i)
            threads.emplace_back(work);
        work();
    }
    for (const std::exception_ptr& error : errors) {
        if (error) std::rethrow_exception(error);
    }
    return frames;
}

/// Returns the drive over the sheets in the file `arguments.sheets`, or nullopt if --drive is not
/// given. All frames have the imperfections of the first shot. If `has_length` is false, also sets
/// `arguments.frames` to the number of frames in one lap.
std::optional<SimulatedDrive> drive_of(SimulateArguments& arguments, bool has_length) {
    if (!arguments.drives) return std::nullopt;
    const std::vector<SheetEntry> sheets = read_sheets(system::path_of(arguments.sheets));
    const Setup& setup = arguments.setup;
    SimulatedDrive drive(sheets, arguments.drive, setup.camera, shot_of(arguments, 0).imperfections,
                         setup.seed);
    if (!has_length) arguments.frames = drive.frames_per_lap();
    return drive;
}

/// Sets the image size and the scale to those of a mouse sensor, 36 x 36 px and 6 px per spacing,
/// unless they are given on the command line.
void use_mouse_sensor(const Command& command, Setup& setup) {
    constexpr int kSide_px = 36;
    constexpr double kSpacing_px = 6;
    CameraModel& camera = setup.camera;
    if (command.count("--size") == 0) camera.width_px = camera.height_px = kSide_px;
    if (command.count("--mm-per-px") == 0)
        camera.mm_per_px = setup.pattern.spacing_mm / kSpacing_px;
}

void prepare(SimulateArguments& arguments, bool section_given) {
    if (arguments.out == kStandardOutput) {
        throw BadArgument("-o takes a folder here; frames cannot go to standard output");
    }
    arguments.setup.pattern = arguments.pattern.pattern();
    arguments.setup.random_section = !section_given;
    for (const double coordinate : arguments.at_grid.values) {
        if (!(coordinate >= 0 && coordinate < kPositionsPerAxis)) {
            throw BadArgument(fmt::format("--at takes coordinates from 0 to {}, not {}",
                                          kPositionsPerAxis - 1, coordinate));
        }
    }
}

void run(SimulateArguments& arguments, const Command& command, int& exit_code) {
    if (is_video_name(arguments.out)) hand_over();
    prepare(arguments, command.count("--section") > 0);
    if (arguments.setup.preset == Preset::mouse) use_mouse_sensor(command, arguments.setup);
    const std::optional<SimulatedDrive> drive = drive_of(arguments, command.count("--frames") > 0);
    const auto output = open_simulate_output(arguments.out, arguments.drive.fps);
    std::ofstream truth(output->truth_path());
    truth << kTruthHeader;

    catch_interrupts();
    int done = 0;
    {
        ProgressLine line("simulating " + arguments.out);
        // Small batches keep the file of true poses up to date and make the program respond quickly
        // to Ctrl-C.
        const int batch = 4 * static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
        while (done < arguments.frames && truth && !interrupted()) {
            const int end = std::min(arguments.frames, done + batch);
            for (const MadeFrame& frame : make_frames(arguments, drive, done, end)) {
                output->write(done, frame.image);
                truth << truth_row(arguments, output->name(done), frame.truth);
                ++done;
            }
            truth.flush();
            line.update(done, arguments.frames);
        }
    }
    output->finish();
    if (!truth) throw Error("cannot write " + output->truth_path().string());
    fmt::print("{}: {} frames of {} x {} px, preset {}, seed {}, {}\n", printable(arguments.out),
               done, arguments.setup.camera.width_px, arguments.setup.camera.height_px,
               name(arguments.setup.preset), arguments.setup.seed,
               printable(output->truth_path().filename().string()));
    if (done < arguments.frames) {
        notify("interrupted; the frames so far are complete");
        exit_code = kExitFailed;
    }
}

void add_pair(Command& command, const std::string& flag, const std::string& unit, Pair& pair,
              const std::string& help) {
    command.add_option(flag, pair.values, help)->type_name(unit)->delimiter(',')->expected(2);
}

void add_camera_options(Command& command, CameraModel& camera) {
    add_size_option(command, camera);
    command.add_option("--mm-per-px", camera.mm_per_px, "Size of a pixel on the paper")
        ->type_name("MM")
        ->capture_default_str();
    command.add_option("--k", camera.k, "Radial distortion; below 0 is barrel")
        ->type_name("1/PX^2")
        ->capture_default_str();
    command
        .add_option("--working-distance", camera.working_distance_mm,
                    "From the camera to the paper; matters with tilt")
        ->type_name("MM")
        ->capture_default_str();
}

// Adds the options that replace random values of each frame with fixed values.
void add_overrides(Command& command, SimulateArguments& arguments) {
    command.add_option("--angle", arguments.angle_deg, "Angle of the camera on the page")
        ->type_name("DEG");
    add_pair(command, "--at", "X,Y", arguments.at_grid,
             "Place under the image centre, in grid units");
    add_pair(command, "--tilt", "X,Y", arguments.tilt_deg,
             "Degrees of tilt about the image x and y axes");
    add_pair(command, "--motion", "U,V", arguments.motion_px, "Motion during exposure, in px");
    add_pair(command, "--readout", "U,V", arguments.readout_px,
             "Motion while a rolling shutter reads the rows, in px");
    command
        .add_option("--readout-turn", arguments.readout_turn_deg,
                    "Rotation of the scene while a rolling shutter reads the rows, clockwise")
        ->type_name("DEG");
    for (std::size_t i = 0; i < std::size(kNumberOptions); ++i) {
        const NumberOption& option = kNumberOptions[i];
        command.add_option(option.flag, arguments.numbers[i], option.help)->type_name(option.unit);
    }
    add_pair(command, "--covered", "FROM,TO", arguments.covered,
             "Fraction of the frame that shows dots, along a border or in a corner");
    command
        .add_option("--islands", arguments.islands, "Rectangles of dots in each frame, else none")
        ->type_name("N");
    command.add_flag("--table", arguments.on_table,
                     "Show the edge of the sheet, with a dark table beyond it");
    command.add_option("--dirt", arguments.dirt_blobs, "Dark specks in each frame")->type_name("N");
    command.add_option("--graphics", arguments.graphics, "Thick strokes or words in each frame")
        ->type_name("N");
}

void add_drive_options(Command& command, SimulateArguments& arguments) {
    Option* drive =
        command.add_flag("--drive", arguments.drives,
                         "Drive over the sheets of a sheet file; --frames is one lap if not given");
    Option* sheets = add_sheets_option(command, arguments.sheets, "Sheet file to drive over");
    drive->needs(sheets);
    sheets->needs(drive);
    const auto add = [&](const char* flag, double& value, const char* unit, const char* help) {
        return command.add_option(flag, value, help)
            ->type_name(unit)
            ->capture_default_str()
            ->check(Range(0.001, 1e6));
    };
    add("--speed", arguments.drive.speed_mm_s, "MM/S", "Speed of the robot")->needs(drive);
    add("--fps", arguments.drive.fps, "N", "Frames per second of the drive or video");
    for (const char* fixed : {"--at", "--angle", "--section", "--code", "--spacing", "--dot",
                              "--displacement", "--tilt", "--motion", "--readout", "--readout-turn",
                              "--covered", "--islands", "--table", "--scene"}) {
        drive->excludes(command.get_option(fixed));
    }
}

}  // namespace

void add_simulate(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<SimulateArguments>();
    Command* command =
        app.add_subcommand("simulate", "Render camera frames with exactly known poses");
    command->footer(kSimulateExamples);
    command
        ->add_option("-o,--out", arguments->out,
                     "Folder for the frames, made if missing, or a video: .mp4 or .avi")
        ->type_name("FILE|-|DIR")
        ->required();
    command->add_option("--frames", arguments->frames, "Number of frames")
        ->type_name("N")
        ->check(Range(1, 1'000'000))
        ->capture_default_str();
    add_named(*command, "--preset", kPresets, name(arguments->setup.preset),
              "Conditions to draw from", [arguments](Preset p) { arguments->setup.preset = p; });
    command->add_option("--seed", arguments->setup.seed, "Seed of the random numbers")
        ->type_name("N")
        ->capture_default_str();
    add_camera_options(*command, arguments->setup.camera);
    arguments->pattern.add_to(*command);
    command->get_option("--section")->default_str("random");
    add_overrides(*command, *arguments);
    add_named(*command, "--scene", kScenes, "",
              "A scene that is not a valid pattern and must be rejected",
              [arguments](Scene s) { arguments->scene = s; });
    command
        ->add_option("--density", arguments->density,
                     "Density of the scenes noise and scattered_dots")
        ->type_name("FRACTION")
        ->capture_default_str();
    add_drive_options(*command, *arguments);
    command->callback([arguments, command, &exit_code] { run(*arguments, *command, exit_code); });
}

}  // namespace dotpose::cli
