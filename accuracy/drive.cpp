// Measures how exactly a robot is tracked: the frames of the tests' simulated drive, at several
// speeds and on paper with and without printing errors, are processed as in `dotpose watch`.
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "../tests/drive_errors.hpp"
#include "../tests/temporary_directory.hpp"
#include "counting.hpp"
#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/track_names.hpp"
#include "evaluate/plot.hpp"

namespace dotpose {
namespace {

using test::Drive;
using test::DriveErrors;
using test::DriveReading;

struct Arguments {
    std::vector<double> speeds_mm_s = {0, 10, 30, 100, 300};
    int width_px = 320;
    int height_px = 240;
    std::string picture;
    unsigned threads = Counting{}.threads;
};

/// The paper and the camera of a drive.
struct Kind {
    const char* name;
    bool has_printing_errors;
    double noise;  ///< sensor noise relative to that of the preset nominal
};
constexpr std::array kKinds{Kind{"nominal", true, 1},
                            Kind{"nominal, four times the noise", true, 4},
                            Kind{"no printing errors", false, 1},
                            Kind{"no printing errors, four times the noise", false, 4}};

/// The results of one frame of a drive.
struct Sample {
    double t_s = 0;
    test::DriveState truth;
    DriveReading reading;
};

struct Run {
    std::vector<Sample> samples;
    DriveErrors errors;
    std::string events;
};

DriveReading reading_of(const Followed& now) {
    DriveReading told;
    told.has_fix = now.located.fix.status == Status::ok && now.located.place;
    if (told.has_fix) {
        const auto world = world_place(*now.located.place);
        told.raw = {world->x_m * 1000, world->y_m * 1000, world->yaw_rad};
    }
    const Track& track = now.track;
    const TrackedPose& pose = track.pose;
    told.is_believed = track.verdict == Verdict::believed;
    told.events = event_names(track.events);
    told.filtered = {pose.x_mm(), pose.y_mm(), pose.theta_rad()};
    told.vx_mm_s = static_cast<double>(pose.vx_mm_s);
    told.vy_mm_s = static_cast<double>(pose.vy_mm_s);
    told.turn_rad_s = static_cast<double>(pose.turn_rad_s);
    return told;
}

Run follow(const Arguments& arguments, double speed_mm_s, const Kind& kind,
           const std::string& sheets) {
    Imperfections imperfections = test::DriveCamera::nominal();
    imperfections.noise_sigma *= kind.noise;
    if (!kind.has_printing_errors) imperfections.jitter_mm = imperfections.missing = 0;
    const test::DriveCamera camera(arguments.width_px, arguments.height_px, imperfections);
    const Drive drive({.speed_mm_s = speed_mm_s});
    FollowerOptions options;
    options.sheets = read_sheets(sheets);
    options.locate.show_stages = true;  // as `dotpose watch` does
    options.track.max_speed_mm_s = 400;
    Follower follower(options);
    Run run;
    for (int index = 0; index < drive.frames() && !cli::interrupted(); ++index) {
        const GreyImage image = camera.frame(drive, index);
        const auto time_us = std::llround(index * 1e6 / test::kDriveFps);
        const Sample sample{index / test::kDriveFps, drive.at(index),
                            reading_of(follower.follow(image.view(), time_us))};
        run.errors.add(sample.truth, sample.reading);
        if (!sample.reading.events.empty()) {
            run.events += fmt::format("{}{} {}", run.events.empty() ? "" : ", ",
                                      sample.reading.events, index);
        }
        run.samples.push_back(sample);
    }
    return run;
}

void print_row(const Kind& kind, double speed_mm_s, const DriveErrors& errors) {
    fmt::print("| {} | {:g} | {} | {} | {:.3f} | {:.3f} | {:.4f} | {:.4f} | {:.3f} | {:.2f} |\n",
               kind.name, speed_mm_s, errors.fixes(), errors.wrong(), errors.raw_um(),
               errors.filtered_um(), errors.raw_deg(), errors.filtered_deg(),
               errors.velocity_mm_s(), errors.turn_deg_s());
}

using plot::Point;

/// One panel of the picture: curves of a quantity over time.
struct Panel {
    const char* label;
    double most;
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

/// Draws the errors along a drive, with gaps where the robot is not tracked.
void draw(const Run& run, const std::string& title, const std::string& file) {
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
    svg.text({kLeft, 44}, plot::style::kTitleFont, title, R"(font-weight="bold")");
    double top = 100;
    for (const Panel& panel : panels) {
        const plot::Axes axes(svg, {kLeft, top, kWidth - kLeft - 40, kPanel},
                              {0, run.samples.back().t_s}, {0, panel.most});
        axes.draw_y(panel.label);
        axes.draw_x(&panel == &panels.back() ? "time, s" : "");
        for (const auto& [colour, value] : panel.curves) {
            std::vector<Point> data;
            for (const Sample& sample : run.samples) {
                const bool is_shown = sample.reading.is_believed || value == speed;
                data.push_back(
                    {sample.t_s, is_shown ? std::min(value(sample), panel.most) : std::nan("")});
            }
            axes.curve(data, {.colour = colour, .has_marks = false});
        }
        top += kPitch;
    }
    draw::write_file(file, [&](std::ostream& out) { out << std::move(svg).finish(); });
}

struct Runs {
    std::map<std::uint64_t, Run> by_index;
    Runs& operator+=(const Runs& other) {
        by_index.insert(other.by_index.begin(), other.by_index.end());
        return *this;
    }
};

int run(const Arguments& arguments) {
    const test::TemporaryDirectory directory;
    const std::string sheets = (directory.path() / "sheets.json").string();
    test::save_drive_sheets(sheets);
    const std::size_t speeds = arguments.speeds_mm_s.size();
    const auto count = count_on_threads<Runs>(
        "drives", speeds * kKinds.size(), arguments.threads, [&](std::uint64_t index, Runs& runs) {
            runs.by_index[index] = follow(arguments, arguments.speeds_mm_s[index % speeds],
                                          kKinds[index / speeds], sheets);
        });
    if (count.done < count.asked) return EXIT_FAILURE;
    fmt::print(
        "| | speed, mm/s | fixes | wrong | position, µm: raw | filtered | heading, degrees: raw | "
        "filtered | velocity, mm/s | heading rate, degrees/s |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const auto& [index, run] : count.tally.by_index)
        print_row(kKinds[index / speeds], arguments.speeds_mm_s[index % speeds], run.errors);
    fmt::print("\n");
    for (std::size_t i = 0; i < speeds; ++i) {
        fmt::print("{:g} mm/s, {}: {}\n", arguments.speeds_mm_s[i], kKinds.front().name,
                   count.tally.by_index.at(i).events);
    }
    if (!arguments.picture.empty()) {
        const double fastest = arguments.speeds_mm_s.back();
        draw(count.tally.by_index.at(speeds - 1),
             fmt::format("A simulated drive at up to {:g} mm/s", fastest), arguments.picture);
    }
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace dotpose

int main(int argc, char** argv) {
    using namespace dotpose;
    Arguments arguments;
    cli::Command app("How exactly is a robot followed?", "dotpose_drive");
    app.add_option("--speeds", arguments.speeds_mm_s, "Highest speeds of the drives, mm/s")
        ->check(cli::Range(0.0, 350.0))
        ->capture_default_str();
    app.add_option("--width", arguments.width_px, "Of a frame, px")->capture_default_str();
    app.add_option("--height", arguments.height_px, "Of a frame, px")->capture_default_str();
    app.add_option("--draw", arguments.picture, "Picture (SVG) of the last drive on nominal paper");
    app.add_option("--threads", arguments.threads, "Default: one for each processor")
        ->check(cli::Range(1, 1024));
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
