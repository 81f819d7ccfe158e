#include "drive_run.hpp"

#include <cmath>

#include "../apps/dotpose/progress.hpp"

namespace dotpose::tables {

void follow_drive(const test::Drive& drive, const test::DriveCamera& camera, int step,
                  const TakeFrame& take, const PrintMap& map) {
    FollowerOptions options;
    options.sheets = test::drive_sheets();
    options.print_map = map;
    options.locate.show_stages = true;  // `dotpose watch` also sets this option
    options.track.max_speed_mm_s = 400;
    Follower follower(options);
    for (int index = 0; index < drive.frames() && !cli::interrupted(); index += step) {
        const GreyImage image = camera.frame(drive, index);
        const auto time_us = std::llround(index * 1e6 / test::kDriveFps);
        take(index, drive.at(index), follower.follow(image.view(), time_us));
    }
}

}  // namespace dotpose::tables
