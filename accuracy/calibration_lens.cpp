#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "calibration.hpp"
#include "calibration_bound.hpp"
#include "dotpose/locate.hpp"
#include "dotpose/tools/mounted_pose.hpp"
#include "dotpose/tools/outcome.hpp"

namespace dotpose::tables {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;
constexpr int kLensFrames = 20;
/// Standard deviation of the print jitter in the `nominal` preset.
constexpr double kJitter_mm = 0.010;

/// A kind of camera whose calibration errors are measured.
struct CameraKind {
    const char* title;
    CameraModel camera;
    double tilt_deg = 0;  ///< maximum tilt about each axis
    bool is_mounted = true;
};

/// Returns the camera model described in the paper. Its field of view is 54 degrees, or 8.6 x 5.5
/// mm on the sheet after the distortion is corrected. The distortion in the corners is 12 %.
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

struct LensTally {
    ErrorTable errors;
    std::map<Unknown, ErrorTable> bounds_if;
    Numbers residual;     ///< residual divided by the residual with the true parameters
    Errors located;       ///< position errors with the calibrated camera, um per axis
    Errors undistorted;   ///< position errors with a distortion-free lens, um per axis
    int not_located = 0;  ///< number of frames not located with the calibrated camera
    int not_good = 0;
    int wrong_kind = 0;

    LensTally& operator+=(const LensTally& other) {
        errors += other.errors;
        for (const auto& [unknown, table] : other.bounds_if)
            bounds_if[unknown] += table;
        residual += other.residual;
        located += other.located;
        undistorted += other.undistorted;
        not_located += other.not_located;
        not_good += other.not_good;
        wrong_kind += other.wrong_kind;
        return *this;
    }
};

/// Simulated frames of one camera.
struct Series {
    const CameraKind& kind;
    std::uint64_t seed;
    CameraPose mounted;  ///< only its tilt is used, which is constant for a mounted camera

    Series(const CameraKind& k, std::uint64_t s, std::uint64_t index)
        : kind(k), seed(scramble(s) + index) {
        Rng rng(seed);
        tilt(rng, mounted);
    }
    void tilt(Rng& rng, CameraPose& pose) const {
        pose.tilt_x_rad = rng.uniform(-1, 1) * kind.tilt_deg * kDegree_rad;
        pose.tilt_y_rad = rng.uniform(-1, 1) * kind.tilt_deg * kDegree_rad;
    }
    Shot shot(int index) const {
        Setup setup;
        setup.camera = kind.camera;
        setup.seed = seed;
        Shot shot = draw_shot(setup, static_cast<std::uint64_t>(index));
        Rng rng(seed + 1, static_cast<std::uint64_t>(index));
        shot.pose.tilt_x_rad = mounted.tilt_x_rad;
        shot.pose.tilt_y_rad = mounted.tilt_y_rad;
        if (!kind.is_mounted) tilt(rng, shot.pose);
        return shot;
    }
};

/// Returns the length of the middle image row on the paper, in mm.
double field_mm(const Camera& camera) {
    const double v = (camera.height_px - 1) / 2.0;
    const CameraPoint left = on_paper(camera, undistorted(camera, {0, v}));
    const CameraPoint right = on_paper(camera, undistorted(camera, {camera.width_px - 1.0, v}));
    return std::hypot(right.x_mm - left.x_mm, right.y_mm - left.y_mm);
}
double field_mm(const CameraModel& model) {
    const Projection projection(model, {});
    const double v = (model.height_px - 1) / 2.0;
    const Vec2 left = projection.offset_from_pixel({0, v});
    const Vec2 right = projection.offset_from_pixel({model.width_px - 1.0, v});
    return std::hypot(right.x - left.x, right.y - left.y);
}

/// The error of a parameter, its name and unit in the table, and its key in `Camera::sigma`.
struct ParameterError {
    const char* title;
    const char* sigma;  ///< key in `Camera::sigma`, or empty if no standard deviation is reported
    double error;
    double unit;
};

std::vector<ParameterError> parameter_errors(const Series& series, const Camera& camera) {
    const CameraModel& truth = series.kind.camera;
    const double k_percent = 0.01 * std::abs(truth.k);
    std::vector<ParameterError> errors = {
        {"k, %", "k_per_px2", camera.k_per_px2 - truth.k, k_percent},
        {"centre u, px", "centre_u_px", camera.centre_px.u - (truth.width_px - 1) / 2.0, 1},
        {"centre v, px", "centre_v_px", camera.centre_px.v - (truth.height_px - 1) / 2.0, 1}};
    if (series.kind.tilt_deg == 0 && camera.paper) {
        const double percent = 0.01 * truth.mm_per_px;
        errors.push_back(
            {"scale x, %", "mm_per_px_x", camera.paper->mm_per_px_x - truth.mm_per_px, percent});
        errors.push_back(
            {"scale y, %", "mm_per_px_y", camera.paper->mm_per_px_y - truth.mm_per_px, percent});
        errors.push_back({"width of the field, %", "", field_mm(camera) - field_mm(truth),
                          0.01 * field_mm(truth)});
    }
    if (camera.tilt) {
        errors.push_back({"tilt x, degrees", "tilt_x_rad",
                          camera.tilt->x_rad - series.mounted.tilt_x_rad, kDegree_rad});
        errors.push_back({"tilt y, degrees", "tilt_y_rad",
                          camera.tilt->y_rad - series.mounted.tilt_y_rad, kDegree_rad});
    }
    if (camera.focal_px) {
        const double focal_px = truth.working_distance_mm / truth.mm_per_px;
        errors.push_back(
            {"focal length, %", "focal_px", *camera.focal_px - focal_px, 0.01 * focal_px});
    }
    return errors;
}

void measure_parameters(const Series& series, const LensCalibration& found,
                        const std::vector<TrueDot>& dots, LensTally& tally) {
    const Camera& camera = found.camera;
    const std::vector<ParameterError> errors = parameter_errors(series, camera);
    for (const ParameterError& parameter : errors) {
        constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
        const double sigma = *parameter.sigma == '\0' ? kNone : camera.sigma.at(parameter.sigma);
        tally.errors[parameter.title].add(parameter.error / parameter.unit, sigma / parameter.unit);
    }
    if (!camera.paper) return;
    for (const Unknown unknown : {Unknown::view, Unknown::square, Unknown::straight}) {
        const auto least = min_sigmas(camera, dots, kJitter_mm, unknown);
        for (const ParameterError& parameter : errors) {
            const auto bound = least.find(parameter.sigma);
            if (bound == least.end()) continue;
            tally.bounds_if[unknown][parameter.title].add(bound->second / parameter.unit, 1);
        }
    }
}

void measure_residual(const LensCalibration& found, const std::vector<Shot>& shots,
                      const std::vector<TrueDot>& dots, LensTally& tally) {
    Locator locator{DeviceOptions{}};
    // Scale at the centre of each frame. It converts the residuals of the dots from mm to px, for
    // comparison with `residual_px`.
    std::vector<double> mm_per_px(shots.size(), NAN);
    for (std::size_t i = 0; i < shots.size(); ++i) {
        DeviceOptions options;
        use_camera(found.camera, shots[i].camera.width_px, shots[i].camera.height_px, options);
        locator.set_options(options);
        const Fix fix = locator.locate(render(shots[i]).view());
        if (fix.status == Status::ok) mm_per_px[i] = kDefaultSpacing_mm / fix.spacing_px();
    }
    double squares = 0;
    int count = 0;
    for (const TrueDot& dot : dots) {
        const double mm = mm_per_px[static_cast<std::size_t>(dot.frame)];
        if (std::isnan(mm)) continue;
        squares += (dot.off_mm.x * dot.off_mm.x + dot.off_mm.y * dot.off_mm.y) / (mm * mm);
        count += 2;
    }
    tally.residual.add(found.residual_px / std::sqrt(squares / count));
}

/// Locates further frames with the calibrated camera. For comparison, also locates the frames that
/// the camera would take without lens distortion.
void measure_positions(const Series& series, const Camera& camera, LensTally& tally) {
    Locator locator{DeviceOptions{}};
    Locator undistorted{DeviceOptions{}};
    for (int i = kLensFrames; i < 2 * kLensFrames; ++i) {
        Shot shot = series.shot(i);
        const Truth truth = truth_of(shot);
        const auto add = [&](const Fix& fix, Errors& errors) {
            if (fix.status != Status::ok) return false;
            const Deviation off = deviation_of(fix, truth);
            errors.add(1000 * kDefaultSpacing_mm * off.x_grid, 1);
            errors.add(1000 * kDefaultSpacing_mm * off.y_grid, 1);
            return true;
        };
        DeviceOptions options;
        use_camera(camera, shot.camera.width_px, shot.camera.height_px, options);
        locator.set_options(options);
        const Fix fix = locator.locate(render(shot).view());
        const bool is_located = add(with_camera(fix, camera, locator.trace()), tally.located);
        tally.not_located += is_located ? 0 : 1;
        shot.camera.k = 0;
        add(undistorted.locate(render(shot).view()), tally.undistorted);
    }
}

void calibrate_once(const Series& series, LensTally& tally) {
    std::vector<Shot> shots;
    for (int i = 0; i < kLensFrames; ++i)
        shots.push_back(series.shot(i));
    const auto frame_at = [&](int i) { return render(shots[static_cast<std::size_t>(i)]); };
    const LensCalibration found = calibrate_lens(kLensFrames, frame_at, {});
    const std::vector<TrueDot> dots = true_dots(found, shots);
    measure_parameters(series, found, dots, tally);
    measure_residual(found, shots, dots, tally);
    measure_positions(series, found.camera, tally);
    tally.not_good += found.verdict != CalibrationVerdict::good ? 1 : 0;
    tally.wrong_kind += found.is_mounted != series.kind.is_mounted ? 1 : 0;
}

LensTally measure(const CameraKind& kind, std::uint64_t calibrations, const TableRun& run) {
    const auto count =
        run.count<LensTally>(kind.title, calibrations, [&](std::uint64_t index, LensTally& tally) {
            calibrate_once(Series(kind, run.seed, index), tally);
        });
    const LensTally& tally = count.tally;
    if (tally.not_good + tally.wrong_kind + tally.not_located > 0) {
        fmt::print(stderr,
                   "{}: {} not judged good, {} taken for the wrong kind of mount, {} frames not "
                   "located afterwards\n",
                   kind.title, tally.not_good, tally.wrong_kind, tally.not_located);
    }
    return tally;
}

std::string bound_text(const LensTally& tally, Unknown unknown, const std::string& key) {
    const auto table = tally.bounds_if.find(unknown);
    if (table == tally.bounds_if.end()) return "-";
    const auto found = table->second.find(key);
    return found == table->second.end() ? "-" : fmt::format("{:.4f}", found->second.rms());
}

void print_parameters(const CameraKind& kind, const LensTally& tally) {
    for (const auto& [key, errors] : tally.errors) {
        fmt::print("| {} | {} | {} | {:.4f} | {:.4f} | {} | {} |\n", kind.title, errors.count, key,
                   errors.rms(), errors.largest, errors.normalised_text(),
                   bound_text(tally, Unknown::view, key));
    }
    std::fflush(stdout);
}

void print_use(const CameraKind& kind, const LensTally& tally) {
    fmt::print("| {} | {} | {:.3f} | {:.3f} | {} | {:.2f} | {:.2f} | {:.2f} |\n", kind.title,
               tally.residual.count, tally.residual.mean(), tally.residual.largest,
               tally.located.count / 2, tally.located.rms(), tally.undistorted.rms(),
               tally.located.rms() / tally.undistorted.rms());
}

}  // namespace

void measure_lenses(std::uint64_t small_cameras, std::uint64_t large_cameras, const TableRun& run) {
    std::vector<CameraKind> kinds = {{"188 x 120 px, straight", small_camera()},
                                     {"188 x 120 px, mounted with a tilt", small_camera(), 25},
                                     {"188 x 120 px, by hand", small_camera(), 25, false},
                                     {"640 x 480 px, straight", large_camera()},
                                     {"640 x 480 px, mounted with a tilt", large_camera(), 25},
                                     {"640 x 480 px, by hand", large_camera(), 25, false}};
    const auto count_of = [&](const CameraKind& kind) {
        return kind.camera.width_px == small_camera().width_px ? small_cameras : large_cameras;
    };
    std::erase_if(kinds, [&](const CameraKind& kind) { return count_of(kind) == 0; });
    if (kinds.empty()) return;
    fmt::print(
        "| camera | calibrations | parameter | error, rms | largest | error² / variance | bound "
        "|\n|---|--:|---|--:|--:|--:|--:|\n");
    std::vector<LensTally> tallies;
    for (const CameraKind& kind : kinds) {
        tallies.push_back(measure(kind, count_of(kind), run));
        print_parameters(kind, tallies.back());
    }
    fmt::print(
        "\n| camera | calibrations | residual / that of perfect knowledge, mean | largest | frames "
        "located afterwards | error, µm rms per axis | without distortion | ratio |\n"
        "|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (std::size_t i = 0; i < kinds.size(); ++i)
        print_use(kinds[i], tallies[i]);
    fmt::print(
        "\nBounds of {}:\n\n| parameter | as calibrated | if pixels are square | and the "
        "camera looks straight down |\n|---|--:|--:|--:|\n",
        kinds[0].title);
    for (const auto& [key, bounds] : tallies[0].bounds_if[Unknown::view]) {
        fmt::print("| {} | {} | {} | {} |\n", key, bound_text(tallies[0], Unknown::view, key),
                   bound_text(tallies[0], Unknown::square, key),
                   bound_text(tallies[0], Unknown::straight, key));
    }
    std::fflush(stdout);
}

}  // namespace dotpose::tables
