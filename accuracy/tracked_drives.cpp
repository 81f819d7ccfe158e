#include "tracked_drives.hpp"

#include <array>
#include <string>

#include <fmt/core.h>

#include "../tests/drive_errors.hpp"
#include "../tests/temporary_directory.hpp"
#include "dotpose/tools/follower.hpp"

namespace dotpose {
namespace {

/// A drive at some speed, of whose 200 frames per second every n-th is taken.
struct DriveKind {
    double speed_mm_s;
    int every;
};
constexpr std::array kDrives{DriveKind{0, 1},   DriveKind{30, 1},  DriveKind{100, 1},
                             DriveKind{300, 1}, DriveKind{300, 2}, DriveKind{300, 4},
                             DriveKind{100, 4}, DriveKind{30, 8}};

/// Results of a drive.
struct DriveTally {
    TrackedTally seen;
    TrackedTally settled;  ///< frames from the third one on after the robot was put down
};

struct DriveTallies {
    std::array<DriveTally, kDrives.size()> drives;

    DriveTallies& operator+=(const DriveTallies& other) {
        for (std::size_t i = 0; i < drives.size(); ++i) {
            drives[i].seen += other.drives[i].seen;
            drives[i].settled += other.drives[i].settled;
        }
        return *this;
    }
};

/// Counts a frame like TrackedTally::count, but compares poses in the world.
void count(const Located& located, const test::DriveState& truth, TrackedTally& tally) {
    const Fix& fix = located.fix;
    if (fix.status != Status::ok) {
        ++tally.none;
        return;
    }
    const auto world = located.place ? world_place(*located.place) : std::nullopt;
    const bool is_tracked = fix.attempt == Attempt::tracked;
    bool is_wrong = !world || truth.is_lifted;
    double error_mm = 0;
    if (world) {
        const test::DrivePose off = test::DriveErrors::difference(
            {world->x_m * 1000, world->y_m * 1000, world->yaw_rad}, truth);
        error_mm = std::hypot(off.x_mm, off.y_mm);
        is_wrong = is_wrong || error_mm > 0.1 || std::abs(off.yaw_rad) > 0.02;
    }
    if (is_wrong) {
        ++(is_tracked ? tally.tracked_wrong : tally.afresh_wrong);
        return;
    }
    ++(is_tracked ? tally.tracked : tally.afresh);
    if (is_tracked) tally.errors_um.push_back(1000 * error_mm);
}

void follow(const DriveKind& kind, const std::string& sheets, DriveTally& tally) {
    const CameraModel camera;
    const test::DriveCamera drive_camera(camera.width_px, camera.height_px);
    const test::Drive drive({.speed_mm_s = kind.speed_mm_s});
    FollowerOptions options;
    options.sheets = read_sheets(sheets);
    options.locate.show_stages = true;  // as `dotpose watch` does
    options.track.max_speed_mm_s = 400;
    Follower follower(options);
    constexpr int kSettled = 3;
    int since_put_down = 0;
    for (int index = 0; index < drive.frames() && !cli::interrupted(); index += kind.every) {
        const GreyImage image = drive_camera.frame(drive, index);
        const auto time_us = std::llround(index * 1e6 / test::kDriveFps);
        const test::DriveState truth = drive.at(index);
        const Located located = follower.follow(image.view(), time_us).located;
        if (truth.is_lifted) {
            since_put_down = 0;
            // A fix of a lifted robot is wrong; frames without a fix are not counted.
            if (located.fix.status == Status::ok) count(located, truth, tally.seen);
            continue;
        }
        count(located, truth, tally.seen);
        if (++since_put_down >= kSettled) count(located, truth, tally.settled);
    }
}

}  // namespace

TrackedTable drives_table(const Counting& counting) {
    const test::TemporaryDirectory directory;
    const std::string sheets = (directory.path() / "sheets.json").string();
    test::save_drive_sheets(sheets);
    const auto counted = count_on_threads<DriveTallies>(
        "drives", kDrives.size(), counting.threads,
        [&](std::uint64_t i, DriveTallies& mine) { follow(kDrives[i], sheets, mine.drives[i]); });
    TrackedTable table;
    table.text =
        "| speed, mm/s | frames/s | frames | tracked, % | of those from the third on, % | no fix "
        "| wrong | error of the tracked, µm: median | 95 % |\n"
        "|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
    for (std::size_t i = 0; i < kDrives.size(); ++i) {
        const auto& [seen, settled] = counted.tally.drives[i];
        table.text += fmt::format(
            "| {:g} | {:g} | {} | {:.1f} | {:.1f} | {} | {} | {} |\n", kDrives[i].speed_mm_s,
            test::kDriveFps / kDrives[i].every, seen.all(), seen.percent(seen.tracked),
            settled.percent(settled.tracked), seen.none, seen.wrong(), seen.errors());
        table.wrong += seen.wrong();
    }
    table.is_complete = counted.done == counted.asked;
    return table;
}

}  // namespace dotpose
