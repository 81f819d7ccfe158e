// Follows a robot, using the frames of its camera: dotpose_follow_robot FRAMES_PER_SECOND IMAGE...
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <dotpose/locate.hpp>
#include <dotpose/tools/image_file.hpp>
#include <dotpose/track.hpp>

int main(int argc, char** argv) try {
    using namespace dotpose;
    if (argc < 3) return std::fputs("usage: follow_robot FRAMES_PER_SECOND IMAGE...\n", stderr), 2;
    Locator locator;
    Tracker tracker;
    Fix seen;  // newest fix, from which `sighting` is computed
    Sighting sighting;
    for (int i = 2; i < argc; ++i) {
        const GreyImage image = read_image(argv[i]);
        const std::int64_t time_us = std::llround((i - 2) * 1e6 / std::atof(argv[1]));
        const Fix fix = tracker.has_prior()
                            ? locator.locate(image.view(), tracker.predict(time_us, seen, sighting,
                                                                           locator.options()))
                            : locator.locate(image.view());
        const bool ok = fix.status == Status::ok;
        if (ok) sighting = sighting_of(seen = fix, time_us);
        const Track& track = tracker.update(time_us, ok ? &sighting : nullptr);
        const TrackedPose& pose = track.pose;
        if (track.is_lost) std::puts("lost");
        if (track.is_lost) continue;
        std::printf("x %.3f mm, y %.3f mm, %.1f and %.1f mm/s, %s\n", pose.x_mm(), pose.y_mm(),
                    double{pose.vx_mm_s}, double{pose.vy_mm_s},
                    ok ? name(fix.attempt) : message(fix.status));
    }
} catch (const std::exception& problem) {
    return std::fprintf(stderr, "%s\n", problem.what()), 1;
}
