// Follows a robot over printed sheets.
//
//   dotpose_follow_sheets SHEETS.json FRAMES_PER_SECOND IMAGE...
//
// The sheet file is written by `dotpose print -o table.pdf --sheets sheets.json --name table`. If
// the sheets have world poses, the example prints the pose of the robot in the world.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <dotpose/files/sheet_file.hpp>
#include <dotpose/files/sheet_place.hpp>
#include <dotpose/tools/follower.hpp>
#include <dotpose/tools/image_file.hpp>

namespace {

void print(const dotpose::Followed& now) {
    const auto& place = now.located.place;
    if (!place) {
        std::printf("%s\n", now.track.is_lost ? "lost" : "between fixes");
        return;
    }
    std::printf("%s: x %.3f mm, y %.3f mm, angle %.4f rad, %.1f mm/s", place->entry->name.c_str(),
                place->x_mm, place->y_mm, place->theta_rad,
                std::hypot(double{now.track.pose.vx_mm_s}, double{now.track.pose.vy_mm_s}));
    if (const auto world = dotpose::world_place(*place))
        std::printf(", world %.5f m, %.5f m, yaw %.4f rad", world->x_m, world->y_m, world->yaw_rad);
    std::puts("");
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc < 4) {
        std::fprintf(stderr, "usage: %s SHEETS.json FRAMES_PER_SECOND IMAGE...\n", argv[0]);
        return 2;
    }
    dotpose::FollowerOptions options;
    options.sheets = dotpose::read_sheets(argv[1]);
    dotpose::Follower follower(options);
    for (int i = 3; i < argc; ++i) {
        const std::int64_t time_us = std::llround((i - 3) * 1e6 / std::atof(argv[2]));
        const dotpose::GreyImage image = dotpose::read_image(argv[i]);
        print(follower.follow(image.view(), time_us));
    }
} catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
}
