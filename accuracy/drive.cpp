// Measures how accurately a robot is tracked. Processes the simulated drive from the tests in the
// same way as `dotpose watch`, at several speeds and on paper with and without printing errors.
//
//   dotpose_tables drive [--speeds V...] [--width W] [--height H] [--draw FILE] [--threads N]
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "dotpose/tools/track_names.hpp"
#include "drive_run.hpp"
#include "evaluate/plot.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

using test::Drive;
using test::DriveErrors;
using test::DriveReading;

struct DriveOptions {
    std::vector<double> speeds_mm_s = {0, 10, 30, 100, 300};
    int width_px = 320;
    int height_px = 240;
    std::string picture;
};

/// Printing errors and sensor noise in a drive.
struct DriveKind {
    const char* name;
    bool has_printing_errors;
    double noise;  ///< ratio of the noise sigma to that of the `nominal` preset
};
constexpr std::array kDriveKinds{DriveKind{"nominal", true, 1},
                                 DriveKind{"nominal, four times the noise", true, 4},
                                 DriveKind{"no printing errors", false, 1},
                                 DriveKind{"no printing errors, four times the noise", false, 4}};

struct Sample {
    double t_s = 0;
    test::DriveState truth;
    DriveReading reading;
};

struct DriveSamples {
    std::vector<Sample> samples;
    DriveErrors errors;
    std::string events;
};

DriveReading reading_of(const Followed& now) {
    DriveReading reading;
    reading.has_fix = now.located.fix.status == Status::ok && now.located.place;
    if (reading.has_fix) {
        const auto world = world_place(*now.located.place);
        reading.raw = {world->x_m * 1000, world->y_m * 1000, world->yaw_rad};
    }
    const Track& track = now.track;
    const TrackedPose& pose = track.pose;
    reading.is_accepted = track.verdict == Verdict::accepted;
    reading.events = event_names(track.events);
    reading.filtered = {pose.x_mm(), pose.y_mm(), pose.theta_rad()};
    reading.vx_mm_s = static_cast<double>(pose.vx_mm_s);
    reading.vy_mm_s = static_cast<double>(pose.vy_mm_s);
    reading.turn_rad_s = static_cast<double>(pose.turn_rad_s);
    return reading;
}

DriveSamples follow(const DriveOptions& options, double speed_mm_s, const DriveKind& kind) {
    Imperfections imperfections = test::DriveCamera::nominal();
    imperfections.noise_sigma *= kind.noise;
    if (!kind.has_printing_errors) imperfections.jitter_mm = imperfections.missing = 0;
    const test::DriveCamera camera(options.width_px, options.height_px, imperfections);
    DriveSamples run;
    const auto take = [&run](int index, const test::DriveState& truth, const Followed& now) {
        const Sample sample{index / test::kDriveFps, truth, reading_of(now)};
        run.errors.add(truth, sample.reading);
        if (!sample.reading.events.empty()) {
            run.events += fmt::format("{}{} {}", run.events.empty() ? "" : ", ",
                                      sample.reading.events, index);
        }
        run.samples.push_back(sample);
    };
    follow_drive(Drive({.speed_mm_s = speed_mm_s}), camera, 1, take);
    return run;
}

void print_drive_row(const DriveKind& kind, double speed_mm_s, const DriveErrors& errors) {
    fmt::print("| {} | {:g} | {} | {} | {:.3f} | {:.3f} | {:.4f} | {:.4f} | {:.3f} | {:.2f} |\n",
               kind.name, speed_mm_s, errors.fixes(), errors.wrong(), errors.raw_um(),
               errors.filtered_um(), errors.raw_deg(), errors.filtered_deg(),
               errors.velocity_mm_s(), errors.turn_deg_s());
}

using plot::Point;

/// A panel of the picture: curves of one quantity over time.
struct Panel {
    const char* label;
    double max;
    std::vector<std::pair<const char*, double (*)(const Sample&)>> curves;
};

double length_um(const test::DrivePose& off) {
    return 1000 * std::hypot(off.x_mm, off.y_mm);
}
double raw_um(const Sample& s) {
    return length_um(DriveErrors::difference(s.reading.raw, s.truth));
}
double filtered_um(const Sample& s) {
    return length_um(DriveErrors::difference(s.reading.filtered, s.truth));
}
double velocity(const Sample& s) {
    return std::hypot(s.reading.vx_mm_s - s.truth.vx_mm_s, s.reading.vy_mm_s - s.truth.vy_mm_s);
}
double turn(const Sample& s) {
    return std::abs(s.reading.turn_rad_s - s.truth.turn_rad_s) * 180 / std::numbers::pi;
}
double speed(const Sample& s) {
    return std::hypot(s.truth.vx_mm_s, s.truth.vy_mm_s);
}

/// Plots the errors of a drive over time, with gaps where the robot is not tracked.
void draw_drive(const DriveSamples& run, const std::string& title, const std::string& file) {
    constexpr double kWidth = 900;
    constexpr double kLeft = 80;
    constexpr double kPanel = 130;
    constexpr double kPitch = 190;
    const std::vector<Panel> panels = {
        {"speed, mm/s", 320, {{plot::style::kAll, speed}}},
        {"position error, µm: raw (orange) and filtered (blue)",
         2,
         {{plot::style::kWindow, raw_um}, {plot::style::kAll, filtered_um}}},
        {"error of the velocity, mm/s", 1, {{plot::style::kAll, velocity}}},
        {"error of the heading rate, degrees/s", 4, {{plot::style::kAll, turn}}},
    };
    plot::Svg svg(kWidth, 130 + kPitch * static_cast<double>(panels.size()), title);
    plot::draw_title(svg, kLeft, title);
    double top = 100;
    for (const Panel& panel : panels) {
        const plot::Axes axes(svg, {kLeft, top, kWidth - kLeft - 40, kPanel},
                              {0, run.samples.back().t_s}, {0, panel.max});
        axes.draw_y(panel.label);
        axes.draw_x(&panel == &panels.back() ? "time, s" : "");
        for (const auto& [colour, value] : panel.curves) {
            std::vector<Point> data;
            for (const Sample& sample : run.samples) {
                const bool is_shown = sample.reading.is_accepted || value == speed;
                data.push_back(
                    {sample.t_s, is_shown ? std::min(value(sample), panel.max) : std::nan("")});
            }
            axes.curve(data, {.colour = colour, .has_marks = false});
        }
        top += kPitch;
    }
    draw::write_file(file, [&](std::ostream& out) { out << std::move(svg).finish(); });
}

struct AllDrives {
    std::map<std::uint64_t, DriveSamples> by_index;
    AllDrives& operator+=(const AllDrives& other) {
        by_index.insert(other.by_index.begin(), other.by_index.end());
        return *this;
    }
};

}  // namespace

bool drive_table(TableRun& run) {
    DriveOptions options;
    run.command.add_option("--speeds", options.speeds_mm_s, "Highest speeds of the drives, mm/s")
        ->check(cli::Range(0.0, 350.0))
        ->capture_default_str();
    run.command.add_option("--width", options.width_px, "Size of a frame, px")
        ->capture_default_str();
    run.command.add_option("--height", options.height_px, "Size of a frame, px")
        ->capture_default_str();
    run.command.add_option("--draw", options.picture,
                           "Picture (SVG) of the last drive on nominal paper");
    run.add_threads();
    if (!run.parse()) return true;

    const std::vector<double>& speeds_mm_s = options.speeds_mm_s;
    const std::size_t speeds = speeds_mm_s.size();
    const auto count = run.count<AllDrives>(
        "drives", speeds * kDriveKinds.size(), [&](std::uint64_t index, AllDrives& drives) {
            drives.by_index[index] =
                follow(options, speeds_mm_s[index % speeds], kDriveKinds[index / speeds]);
        });
    if (!count.is_complete()) return false;
    fmt::print(
        "| | speed, mm/s | fixes | wrong | position, µm: raw | filtered | heading, degrees: raw | "
        "filtered | velocity, mm/s | heading rate, degrees/s |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const auto& [index, drive] : count.tally.by_index)
        print_drive_row(kDriveKinds[index / speeds], speeds_mm_s[index % speeds], drive.errors);
    fmt::print("\n");
    for (std::size_t i = 0; i < speeds; ++i) {
        fmt::print("{:g} mm/s, {}: {}\n", speeds_mm_s[i], kDriveKinds.front().name,
                   count.tally.by_index.at(i).events);
    }
    if (!options.picture.empty()) {
        draw_drive(count.tally.by_index.at(speeds - 1),
                   fmt::format("A simulated drive at up to {:g} mm/s", speeds_mm_s.back()),
                   options.picture);
    }
    return true;
}

}  // namespace dotpose::tables
