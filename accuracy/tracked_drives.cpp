#include <array>
#include <cmath>

#include <fmt/core.h>

#include "drive_run.hpp"
#include "tracked.hpp"

namespace dotpose::tables {
namespace {

/// A drive at a constant speed, recorded at 200 frames per second. Only every `every`-th frame is
/// processed.
struct DriveRate {
    double speed_mm_s;
    int every;
};
constexpr std::array kDrives{DriveRate{0, 1},   DriveRate{30, 1},  DriveRate{100, 1},
                             DriveRate{300, 1}, DriveRate{300, 2}, DriveRate{300, 4},
                             DriveRate{100, 4}, DriveRate{30, 8}};

struct DriveTally {
    TrackedTally seen;
    TrackedTally settled;  ///< results excluding the first two frames after the robot is put down
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

/// Counts a frame like `TrackedTally::count`, but compares world poses instead of poses on the
/// sheet.
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

void follow(const DriveRate& rate, DriveTally& tally) {
    const CameraModel camera;
    constexpr int kSettled = 3;
    int since_put_down = 0;
    const auto take = [&](int, const test::DriveState& truth, const Followed& now) {
        if (truth.is_lifted) {
            since_put_down = 0;
            // While the robot is lifted, every fix is wrong, and frames without a fix are not
            // counted.
            if (now.located.fix.status == Status::ok) count(now.located, truth, tally.seen);
            return;
        }
        count(now.located, truth, tally.seen);
        if (++since_put_down >= kSettled) count(now.located, truth, tally.settled);
    };
    follow_drive(test::Drive({.speed_mm_s = rate.speed_mm_s}),
                 test::DriveCamera(camera.width_px, camera.height_px), rate.every, take);
}

}  // namespace

TrackedTable drives_table(const TableRun& run) {
    const auto counted = run.count<DriveTallies>(
        "drives", kDrives.size(),
        [](std::uint64_t i, DriveTallies& tally) { follow(kDrives[i], tally.drives[i]); });
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
    table.is_complete = counted.is_complete();
    return table;
}

}  // namespace dotpose::tables
