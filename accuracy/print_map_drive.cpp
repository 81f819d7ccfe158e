// Measures how much a map of the print improves the positions of a driving robot
// (docs/print-map.md). Simulates the drive of `dotpose_tables drive` on a print with jitter, and on
// a print with jitter and a feed wave. The map is made from other frames, which cover the whole
// rectangle around the path, because a map of only the narrow band along the path would be
// distorted.
//
//   dotpose_tables print_map_drive [--frames N] [--update DOCUMENT]
//
// The exit status is 1 if the error with the map exceeds 0.12 µm or, on the print with a feed wave,
// if the absolute error with the map exceeds a fifth of the absolute error without the map.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "../tests/mapped_print.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/files/sheet_place.hpp"
#include "dotpose/tools/track_names.hpp"
#include "drive_run.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

constexpr double kSpeed_mm_s = 300;
constexpr double kMaxError_um = 0.12;
constexpr double kMaxAbsoluteError = 0.2;  ///< limit relative to the absolute error without the map

struct DrivePrint {
    const char* name;
    double wave_mm;
};
constexpr std::array kDrivePrints = {DrivePrint{"jitter of 10 µm", 0},
                                     DrivePrint{"jitter of 10 µm, feed wave of 40 µm", 0.040}};

/// Returns the displacement of a dot by the feed wave, in mm. The wave has a period of 50 mm along
/// y. Its amplitude is `wave_mm` along y and `wave_mm` / 10 along x.
Vec2 feed_wave(double wave_mm, Vec2 place_grid) {
    const double phase = 2 * std::numbers::pi * place_grid.y * kDefaultSpacing_mm / 50;
    return {0.1 * wave_mm * std::cos(phase), wave_mm * std::sin(phase)};
}

/// Returns a state with a random angle and a random position in the rectangle around the figure
/// eight.
test::DriveState state_in_area(std::uint64_t index) {
    Rng rng(500, index);
    test::DriveState state;
    state.x_mm = test::kSeam_mm + rng.uniform(-312, 312);
    state.y_mm = 148.5 + rng.uniform(-112, 112);
    state.yaw_rad = rng.uniform(-std::numbers::pi, std::numbers::pi);
    return state;
}

PrintMapResult map_of_area(const test::DriveCamera& camera, std::uint64_t frames) {
    PrintMapping mapping({.sheets = test::drive_sheets(), .camera = {}, .earlier = {}});
    cli::ProgressLine line("mapping the area");
    for (std::uint64_t i = 0; i < frames; ++i) {
        line.update(static_cast<std::int64_t>(i), static_cast<std::int64_t>(frames));
        if (cli::interrupted()) throw Error("interrupted");
        mapping.add(camera.frame(state_in_area(i), scramble(500 + i)).view());
    }
    return mapping.solve();
}

/// Errors of the positions measured in the individual frames of a drive, before filtering by the
/// tracker.
struct RawErrors {
    test::DriveErrors all;
    std::array<test::PlaceErrors, 2> pages;  ///< errors on the left and the right page
    double theta_variance = 0;               ///< sum of the variances of the headings
    int mapped = 0;                          ///< number of fixes that used the map

    void add(const test::DriveState& truth, const Followed& now) {
        const Located& located = now.located;
        test::DriveReading reading;
        reading.has_fix = located.fix.status == Status::ok && located.place;
        reading.is_accepted = now.track.verdict == Verdict::accepted;
        reading.events = event_names(now.track.events);
        if (reading.has_fix) {
            const auto world = world_place(*located.place);
            reading.raw = {world->x_m * 1000, world->y_m * 1000, world->yaw_rad};
            mapped += located.map_use == MapUse::used ? 1 : 0;
        }
        all.add(truth, reading);
        if (!reading.has_fix || !reading.is_accepted) return;
        const test::DrivePose off = test::DriveErrors::difference(reading.raw, truth);
        pages[located.place->entry->name == "left" ? 0 : 1].add(
            {truth.x_mm, truth.y_mm}, {off.x_mm, off.y_mm}, {}, located.fix);
        theta_variance += static_cast<double>(located.fix.covariance[2][2]);
    }
    std::size_t count() const { return pages[0].count() + pages[1].count(); }
    /// Returns the means of error^2 / variance for the absolute positions and for the headings.
    std::array<double, 2> normalised() const {
        double variance = 0;
        for (const test::PlaceErrors& page : pages)
            variance += static_cast<double>(page.count()) * page.sigma_um() * page.sigma_um();
        const auto fixes = static_cast<double>(count());
        const double heading_rad = all.raw_deg() / kDegrees;
        return {fixes * absolute_um() * absolute_um() / variance,
                fixes * heading_rad * heading_rad / theta_variance};
    }
    /// Returns the rms absolute error over both pages.
    double absolute_um() const {
        double squares = 0;
        double count = 0;
        for (const test::PlaceErrors& page : pages) {
            const auto weight = static_cast<double>(page.count());
            squares += weight * page.absolute_um() * page.absolute_um();
            count += weight;
        }
        return std::sqrt(squares / count);
    }
};

RawErrors drive_with(const test::DriveCamera& camera, const PrintMap& map) {
    RawErrors errors;
    follow_drive(
        test::Drive({.speed_mm_s = kSpeed_mm_s}), camera, 1,
        [&](int, const test::DriveState& truth, const Followed& now) { errors.add(truth, now); },
        map);
    return errors;
}

}  // namespace

bool print_map_drive_table(TableRun& run) {
    std::uint64_t frames = 20000;
    run.add_count("--frames", frames, "Number of frames of each map");
    run.add_update();
    if (!run.parse()) return true;
    std::string text =
        "| print | map | fixes | with map | all errors, µm | absolute error, µm: left page | right "
        "page | heading, degrees | error² / variance: absolute, heading |\n"
        "|---|---|--:|--:|--:|--:|--:|--:|--:|\n";
    bool is_right = true;
    for (const DrivePrint& print : kDrivePrints) {
        test::DriveCamera camera(320, 240);
        camera.set_shift([&](Vec2 place) { return feed_wave(print.wave_mm, place); });
        const RawErrors without = drive_with(camera, {});
        const RawErrors with = drive_with(camera, map_of_area(camera, frames).map);
        for (const auto& [name, errors] : {std::pair{"without", &without}, {"with", &with}}) {
            // For a print with a wave, the table omits the error relative to the nominal page. The
            // wave shifts, scales and turns the page as a whole by several µm. A map cannot correct
            // this, because the frames do not determine the mean shift, scale and turn.
            const std::string all =
                print.wave_mm > 0 ? "-" : fmt::format("{:.3f}", errors->all.raw_um());
            const auto [place, heading] = errors->normalised();
            text += fmt::format(
                "| {} | {} | {} | {} | {} | {:.3f} | {:.3f} | {:.4f} | {:.2f}, {:.2f} |\n",
                print.name, name, errors->all.fixes(), errors->mapped, all,
                errors->pages[0].absolute_um(), errors->pages[1].absolute_um(),
                errors->all.raw_deg(), place, heading);
        }
        if (print.wave_mm == 0) {
            is_right &= with.all.raw_um() <= kMaxError_um;
        } else {
            is_right &= with.absolute_um() <=
                        std::min(kMaxError_um, kMaxAbsoluteError * without.absolute_um());
        }
    }
    run.print_block("print-map-drive", text);
    run.update_document();
    return is_right;
}

}  // namespace dotpose::tables
