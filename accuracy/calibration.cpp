// How far calibrations are off, and whether they know it: many simulated calibrations each, with
// their errors in units of the standard deviations that they report.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "counting.hpp"
#include "dotpose/calibrate.hpp"
#include "dotpose/simulate.hpp"

namespace dotpose {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;

struct Arguments {
    std::uint64_t calibrations = 200;
    std::uint64_t large = 10;
    Counting counting;
};

/// Cameras that are calibrated.
struct Kind {
    const char* title;
    CameraModel camera;
    double tilt_deg = 0;  ///< largest, about both axes
    bool is_mounted = true;
};

/// The paper's: 54 degrees, 12 % in the corner; 8.6 x 5.5 mm once corrected.
CameraModel small_camera() {
    CameraModel camera;
    camera.k = -8.7e-6;
    return camera;
}
CameraModel large_camera() {
    CameraModel camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.k = -0.7e-6;
    camera.working_distance_mm = 30;
    return camera;
}

/// Errors of one parameter over many calibrations.
struct Errors {
    double squares = 0;
    double normalised_squares = 0;
    double largest = 0;
    int count = 0;

    void add(double error, double sigma) {
        squares += error * error;
        normalised_squares += error * error / (sigma * sigma);
        largest = std::max(largest, std::abs(error));
        ++count;
    }
    Errors& operator+=(const Errors& other) {
        squares += other.squares;
        normalised_squares += other.normalised_squares;
        largest = std::max(largest, other.largest);
        count += other.count;
        return *this;
    }
};

struct Tally {
    std::map<std::string, Errors> errors;
    int not_good = 0;
    int wrong_kind = 0;
    Tally& operator+=(const Tally& other) {
        for (const auto& [key, value] : other.errors)
            errors[key] += value;
        not_good += other.not_good;
        wrong_kind += other.wrong_kind;
        return *this;
    }
};

struct Series {
    const Kind& kind;
    std::uint64_t seed;
    CameraPose mounted;  ///< its tilt

    Series(const Kind& k, std::uint64_t s, std::uint64_t index)
        : kind(k), seed(scramble(s) + index) {
        Rng rng(seed);
        tilt(rng, mounted);
    }
    void tilt(Rng& rng, CameraPose& pose) const {
        pose.tilt_x_rad = rng.uniform(-1, 1) * kind.tilt_deg * kDegree_rad;
        pose.tilt_y_rad = rng.uniform(-1, 1) * kind.tilt_deg * kDegree_rad;
    }
    GreyImage frame(int index) const {
        Setup setup;
        setup.camera = kind.camera;
        setup.seed = seed;
        Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
        Rng rng(seed + 1, static_cast<std::uint64_t>(index));
        shot.pose.tilt_x_rad = mounted.tilt_x_rad;
        shot.pose.tilt_y_rad = mounted.tilt_y_rad;
        if (!kind.is_mounted) tilt(rng, shot.pose);
        return render(shot);
    }
};

void judge(const Series& series, const LensCalibration& found, Tally& tally) {
    const CameraModel& truth = series.kind.camera;
    const Camera& camera = found.camera;
    const auto add = [&](const char* key, const char* sigma, double value, double wanted,
                         double unit) {
        const double deviation = camera.sigma.at(sigma) / unit;
        tally.errors[key].add((value - wanted) / unit, deviation);
    };
    tally.not_good += found.verdict != CalibrationVerdict::good ? 1 : 0;
    tally.wrong_kind += found.is_mounted != series.kind.is_mounted ? 1 : 0;
    add("k, %", "k_per_px2", camera.k_per_px2, truth.k, 0.01 * std::abs(truth.k));
    add("centre u, px", "centre_u_px", camera.centre_px.u, (truth.width_px - 1) / 2.0, 1);
    add("centre v, px", "centre_v_px", camera.centre_px.v, (truth.height_px - 1) / 2.0, 1);
    if (series.kind.tilt_deg == 0 && camera.paper) {
        const double percent = 0.01 * truth.mm_per_px;
        add("scale x, %", "mm_per_px_x", camera.paper->mm_per_px_x, truth.mm_per_px, percent);
        add("scale y, %", "mm_per_px_y", camera.paper->mm_per_px_y, truth.mm_per_px, percent);
    }
    if (camera.tilt) {
        add("tilt x, degrees", "tilt_x_rad", camera.tilt->x_rad, series.mounted.tilt_x_rad,
            kDegree_rad);
        add("tilt y, degrees", "tilt_y_rad", camera.tilt->y_rad, series.mounted.tilt_y_rad,
            kDegree_rad);
    }
    if (camera.focal_px) {
        const double focal_px = truth.working_distance_mm / truth.mm_per_px;
        add("focal length, %", "focal_px", *camera.focal_px, focal_px, 0.01 * focal_px);
    }
}

void print_kind(const Kind& kind, std::uint64_t calibrations, const Arguments& arguments) {
    constexpr int kFrames = 20;
    const auto count = count_on_threads<Tally>(
        kind.title, calibrations, arguments.counting.threads,
        [&](std::uint64_t index, Tally& tally) {
            const Series series(kind, arguments.counting.seed, index);
            const auto frame_at = [&](int frame) { return series.frame(frame); };
            judge(series, calibrate_lens(kFrames, frame_at, {}), tally);
        });
    for (const auto& [key, errors] : count.tally.errors) {
        fmt::print("| {} | {} | {} | {:.4f} | {:.4f} | {:.2f} |\n", kind.title, errors.count, key,
                   std::sqrt(errors.squares / errors.count), errors.largest,
                   errors.normalised_squares / errors.count);
    }
    std::fflush(stdout);
    if (count.tally.not_good + count.tally.wrong_kind > 0) {
        fmt::print(stderr, "{}: {} not judged good, {} taken for the wrong kind of mount\n",
                   kind.title, count.tally.not_good, count.tally.wrong_kind);
    }
}

int run(const Arguments& arguments) {
    fmt::print(
        "| camera | calibrations | parameter | error, rms | largest | error² / variance |\n"
        "|---|--:|---|--:|--:|--:|\n");
    print_kind({"188 x 120 px, straight", small_camera()}, arguments.calibrations, arguments);
    print_kind({"188 x 120 px, mounted with a tilt", small_camera(), 25}, arguments.calibrations,
               arguments);
    print_kind({"188 x 120 px, by hand", small_camera(), 25, false}, arguments.calibrations,
               arguments);
    print_kind({"640 x 480 px, mounted with a tilt", large_camera(), 25}, arguments.large,
               arguments);
    print_kind({"640 x 480 px, by hand", large_camera(), 25, false}, arguments.large, arguments);
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace dotpose

int main(int argc, char** argv) {
    using namespace dotpose;
    Arguments arguments;
    CLI::App app("How far are calibrations off, and do they know it?", "dotpose_calibration");
    add_count(app, "--calibrations", arguments.calibrations, "How many of small cameras");
    add_count(app, "--large", arguments.large, "How many of large ones");
    arguments.counting.add_to(app);
    return run_program(app, argc, argv, [&] { return run(arguments); });
}
