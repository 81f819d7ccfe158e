// Demonstrates the whole library: prints a sheet, drives a simulated camera over it, locates every
// frame, and compares the measured poses with the true poses. Run by `make demo`.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <dotpose/locate.hpp>
#include <dotpose/tools/draw.hpp>
#include <dotpose/tools/print.hpp>
#include <dotpose/tools/simulate.hpp>

namespace {

namespace fs = std::filesystem;
using namespace dotpose;

constexpr int kFrames = 500;
constexpr int kPicturedFrames[] = {0, 140, 320};
constexpr std::uint64_t kSeed = 1;

Sheet print_sheet(const fs::path& folder) {
    SheetOptions options;
    options.origin = {.x = 1000, .y = 2000};
    const Sheet sheet = make_sheet(options);
    for (const char* name : {"sheet.png", "sheet.svg"}) {
        write_sheet(sheet, folder / name);
        fmt::print("{}: {} x {} dots\n", (folder / name).string(), sheet.columns, sheet.rows);
    }
    return sheet;
}

/// A point on the page, in mm from the top left corner, and the direction of the camera at this
/// point.
struct Waypoint {
    double x_mm = 0;
    double y_mm = 0;
    double heading_rad = 0;
};

/// Returns the waypoint for a frame. The path is a figure of eight that fills the page. The camera
/// is aligned with the direction of travel.
Waypoint waypoint(const Sheet& sheet, int frame) {
    const double t = 2 * std::numbers::pi * frame / kFrames;
    const double reach_x_mm = 0.4 * sheet.width_mm;
    const double reach_y_mm = 0.42 * sheet.height_mm;
    return {sheet.width_mm / 2 + reach_x_mm * std::sin(2 * t),
            sheet.height_mm / 2 + reach_y_mm * std::sin(t),
            std::atan2(reach_y_mm * std::cos(t), 2 * reach_x_mm * std::cos(2 * t))};
}

CameraPose pose_at(const Sheet& sheet, const Waypoint& waypoint) {
    const double spacing_mm = sheet.pattern.spacing_mm;
    const double i = (waypoint.x_mm - sheet.origin_x_mm) / spacing_mm;
    const double j = (waypoint.y_mm - sheet.origin_y_mm) / spacing_mm;
    CameraPose pose;
    pose.cell = {sheet.origin.x + static_cast<std::uint32_t>(i),
                 sheet.origin.y + static_cast<std::uint32_t>(j)};
    pose.fraction_x = i - std::floor(i);
    pose.fraction_y = j - std::floor(j);
    pose.theta_rad = waypoint.heading_rad;
    return pose;
}

/// Results of a drive.
struct Drive {
    std::vector<PathPoint> path;
    std::vector<double> errors_um;
    std::vector<double> errors_deg;
    std::vector<double> times_us;
    int lost = 0;         ///< number of frames without a fix
    int wrong_fixes = 0;  ///< number of fixes in the wrong section or off by more than half a cell
};

void record(const Sheet& sheet, const Waypoint& truth, const Fix& fix, Drive& drive) {
    PathPoint point;
    point.true_x_mm = truth.x_mm;
    point.true_y_mm = truth.y_mm;
    point.is_fix = fix.status == Status::ok;
    if (point.is_fix) {
        const double spacing_mm = sheet.pattern.spacing_mm;
        point.measured_x_mm = sheet.origin_x_mm + (fix.x_grid() - sheet.origin.x) * spacing_mm;
        point.measured_y_mm = sheet.origin_y_mm + (fix.y_grid() - sheet.origin.y) * spacing_mm;
        const double error_mm =
            std::hypot(point.measured_x_mm - truth.x_mm, point.measured_y_mm - truth.y_mm);
        const bool is_wrong = error_mm > spacing_mm / 2 || fix.section != sheet.pattern.section;
        drive.wrong_fixes += is_wrong ? 1 : 0;
        drive.errors_um.push_back(1000 * error_mm);
        const double turn = fix.theta_rad() - truth.heading_rad;
        drive.errors_deg.push_back(std::abs(std::remainder(turn, 2 * std::numbers::pi)) * 180 /
                                   std::numbers::pi);
    }
    drive.path.push_back(point);
}

Fix timed_locate(const GreyImage& image, Locator& locator, double& time_us) {
    const auto start = std::chrono::steady_clock::now();
    const Fix fix = locator.locate(image.view());
    const std::chrono::duration<double, std::micro> elapsed =
        std::chrono::steady_clock::now() - start;
    time_us = elapsed.count();
    return fix;
}

Drive drive_over(const Sheet& sheet, const fs::path& folder, Locator& locator) {
    const Page page = page_of(sheet);
    const CameraModel camera;
    Drive drive;
    for (int frame = 0; frame < kFrames; ++frame) {
        const Waypoint truth = waypoint(sheet, frame);
        Rng rng(kSeed, static_cast<std::uint64_t>(frame));
        const Imperfections imperfections = draw_imperfections(Preset::nominal, rng);
        const GreyImage image =
            render(page, camera, pose_at(sheet, truth), imperfections, rng.bits());
        double time_us = 0;
        const Fix fix = timed_locate(image, locator, time_us);
        drive.times_us.push_back(time_us);
        record(sheet, truth, fix, drive);
        const bool is_first_lost = fix.status != Status::ok && ++drive.lost == 1;
        if (is_first_lost ||
            std::ranges::find(kPicturedFrames, frame) != std::end(kPicturedFrames)) {
            const fs::path picture = folder / fmt::format("frame-{:03}.svg", frame);
            draw_frame(picture, image.view(), locator.trace(),
                       {.spacing_mm = sheet.pattern.spacing_mm,
                        .title = fmt::format("frame {} of {}", frame, kFrames)});
            fmt::print(
                "{}: {}\n", picture.string(),
                is_first_lost ? message(fix.status) : "what the camera saw and what was read");
        }
    }
    return drive;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

double largest(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::ranges::max_element(values);
}

void print_table(const Drive& drive) {
    fmt::print("\n{:<22}{:>10}{:>14}\n", "", "median", "largest");
    fmt::print("{:<22}{:>10.4f}{:>14.4f}\n", "position error [mm]", median(drive.errors_um) / 1000,
               largest(drive.errors_um) / 1000);
    fmt::print("{:<22}{:>10.4f}{:>14.4f}\n", "angle error [deg]", median(drive.errors_deg),
               largest(drive.errors_deg));
    fmt::print("{:<22}{:>10.1f}{:>14.1f}\n", "time in the core [us]", median(drive.times_us),
               largest(drive.times_us));
    fmt::print("\n{} frames, {} fixes, {} of them wrong; {:.0f} frames per second on one core\n\n",
               drive.path.size(), drive.errors_um.size(), drive.wrong_fixes,
               1e6 / median(drive.times_us));
}

/// Runs the demo. Returns true if at most 1 % of the frames have no fix, and no fix is wrong.
bool run(const fs::path& folder) {
    fs::create_directories(folder);
    DeviceOptions options;
    options.show_stages = true;
    Locator locator(options);
    const Sheet sheet = print_sheet(folder);
    const Drive drive = drive_over(sheet, folder, locator);
    const fs::path picture = folder / "path.svg";
    draw_path(picture, sheet, drive.path, "A simulated drive over an A4 sheet");
    fmt::print("{}: the drive and its errors\n", picture.string());
    print_table(drive);
    fmt::print(
        "Look at the pictures in {}/. What next:\n"
        "  make         builds the whole tool, build/release/bin/dotpose; start with "
        "docs/start.md\n"
        "  make web     builds the page: a simulated camera in the browser, and your own\n",
        folder.string());
    return drive.wrong_fixes == 0 && drive.lost <= kFrames / 100;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2) {
        std::fputs("usage: dotpose_demo [FOLDER]\n", stderr);
        return 2;
    }
    try {
        return run(argc == 2 ? argv[1] : "demo-out") ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "dotpose_demo: %s\n", error.what());
        return 1;
    }
}
