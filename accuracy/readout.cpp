// Measures how many frames of a moving camera with a rolling shutter are located and tracked, on
// desktops and on devices. Prints a table in Markdown.
//
//   dotpose_tables readout [--frames N] [--seed S] [--threads N]
//
// The exit status is 1 if a fix is wrong.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/core.h>

#include "dotpose/tools/simulate.hpp"
#include "tables.hpp"

namespace dotpose::tables {
namespace {

/// Information about the frames that the caller declares.
struct Declared {
    const char* what;
    int bits_per_error = 0;
    bool has_sheet = false;
};
constexpr std::array kDeclared{Declared{"nothing"}, Declared{"1,000 bits per error", 1000},
                               Declared{"an A4 sheet", 0, true}};

/// Motion of the scene during the readout, as fractions of the image height.
constexpr std::array kMotions{0.0, 0.1, 0.2, 0.3, 0.6};

/// Fixes of one kind, and their errors.
struct Fixes {
    std::uint64_t right = 0;
    std::uint64_t wrong = 0;
    double squares = 0;  ///< sum of the squared position errors, in spacings

    void add(const Fix& fix, const Truth& truth) {
        if (fix.status != Status::ok) return;
        Outcome outcome;
        outcome.fix = fix;
        outcome.truth = truth;
        if (outcome.is_wrong()) {
            ++wrong;
            return;
        }
        ++right;
        const Deviation deviation = deviation_of(fix, truth);
        squares += deviation.x_grid * deviation.x_grid + deviation.y_grid * deviation.y_grid;
    }
    void operator+=(const Fixes& other) {
        right += other.right;
        wrong += other.wrong;
        squares += other.squares;
    }
    /// Returns the rms position error, in micrometres.
    double rms_um() const {
        return 1000 * kDefaultSpacing_mm * std::sqrt(squares / static_cast<double>(right));
    }
};

struct ReadoutTally {
    Fixes first;  ///< by the first attempt
    Fixes all;    ///< by all attempts
    std::uint64_t predicted = 0;
    Fixes tracked;    ///< by the tracked attempt of a Locator
    Fixes on_device;  ///< by the tracked attempt of a DeviceLocator

    void operator+=(const ReadoutTally& other) {
        first += other.first;
        all += other.all;
        predicted += other.predicted;
        tracked += other.tracked;
        on_device += other.on_device;
    }
    std::uint64_t wrong() const {
        return first.wrong + all.wrong + tracked.wrong + on_device.wrong;
    }
};

/// Returns a random direction that depends only on the seed of the shot and on `number`.
Vec2 direction_of(const Shot& shot, std::uint64_t number) {
    const double angle_rad = Rng(shot.seed, number).uniform(-std::numbers::pi, std::numbers::pi);
    return {std::cos(angle_rad), std::sin(angle_rad)};
}

/// Returns the part of the code plane that an A4 sheet with the shot in its middle shows.
KnownRegion sheet_around(const Shot& shot) {
    constexpr std::uint32_t kColumns = 393;
    constexpr std::uint32_t kRows = 564;
    return {shot.page.pattern.code,
            shot.page.pattern.section,
            {shot.pose.cell.x - kColumns / 2, shot.pose.cell.y - kRows / 2},
            kColumns,
            kRows};
}

/// Locates a frame with the tracked attempt of a DeviceLocator only.
Fix track_on_device(DeviceLocator& locator, const GreyImage& image, const Prediction& prediction) {
    static_cast<void>(locator.begin(image.width_px, image.height_px, prediction));
    for (int v = 0; v < image.height_px; ++v)
        locator.push_row(image.view().row(v));
    return locator.finish();
}

/// Locates a frame of a moving camera, and tracks the next frame of the same motion.
void locate_and_track(Shot shot, const Declared& declared, ReadoutTally& tally) {
    const Truth truth = truth_of(shot);
    const KnownRegion sheet = sheet_around(shot);
    DeviceOptions options;
    options.integrity.bits_per_error = declared.bits_per_error;
    Locator locator(thread_memory(), options);
    if (declared.has_sheet) static_cast<void>(locator.set_known({&sheet, 1}));
    const GreyImage image = render(shot);
    tally.all.add(locator.locate(image.view()), truth);
    DeviceOptions once = options;
    once.effort = Effort::once;
    locator.set_options(once);
    tally.first.add(locator.locate(image.view()), truth);

    // The last fix was on a known sheet, so there is a prediction in every row of the table.
    locator.set_options(options);
    static_cast<void>(locator.set_known({&sheet, 1}));
    const Fix last = locator.locate(image.view());
    if (last.status != Status::ok) return;
    ++tally.predicted;
    constexpr double kShift_q16 = 0.2 * 65536;
    constexpr double kTurn_bam = 4294967296.0 / 360;
    const Vec2 shift = direction_of(shot, 2);
    const FixedVec shift_q16{static_cast<std::int32_t>(kShift_q16 * shift.x),
                             static_cast<std::int32_t>(kShift_q16 * shift.y)};
    const FixedVec centre_q8{(image.width_px - 1) * 128, (image.height_px - 1) * 128};
    const Prediction prediction = moved(Prediction::like(last), options.code, shift_q16,
                                        static_cast<std::int32_t>(kTurn_bam), centre_q8);
    shot.seed += 1'000'000;
    const GreyImage next = render(shot);
    if (!declared.has_sheet) static_cast<void>(locator.set_known({}));
    const Fix fix = locator.locate(next.view(), prediction);
    // A wrong fix of any attempt is counted.
    Fixes next_fix;
    next_fix.add(fix, truth);
    if (fix.attempt != Attempt::tracked) next_fix.right = 0;
    tally.tracked += next_fix;
    DeviceMemory memory;
    DeviceLocator device(memory, options);
    if (declared.has_sheet) static_cast<void>(device.set_known({&sheet, 1}));
    tally.on_device.add(track_on_device(device, next, prediction), truth);
}

Shot draw_moving(double motion, std::uint64_t seed, std::uint64_t index) {
    const Setup setup = tables::setup_of(seed, CameraModel{}.width_px, CameraModel{}.height_px);
    Shot shot = draw_shot(setup, index);
    const double length_px = motion * shot.camera.height_px;
    const Vec2 along = direction_of(shot, 1);
    shot.camera.readout_px = {length_px * along.x, length_px * along.y};
    return shot;
}

}  // namespace

bool readout_table(TableRun& run) {
    std::uint64_t frames = 1000;
    run.add_count("--frames", frames, "Number of frames in each row");
    run.add_seed();
    run.add_threads();
    if (!run.parse()) return true;
    fmt::print(
        "| motion, % of the height | declared | first attempt, % | located, % | rms error, µm | "
        "tracked, % | tracked on a device, % | rms error, µm | wrong |\n"
        "|--:|---|--:|--:|--:|--:|--:|--:|--:|\n");
    bool is_right = true;
    for (const double motion : kMotions) {
        for (const Declared& declared : kDeclared) {
            const auto count =
                run.count<ReadoutTally>("frames", frames, [&](std::uint64_t i, ReadoutTally& t) {
                    locate_and_track(draw_moving(motion, run.seed, i), declared, t);
                });
            const ReadoutTally& tally = count.tally;
            const auto percent = [](const Fixes& fixes, std::uint64_t of) {
                return 100.0 * static_cast<double>(fixes.right) / static_cast<double>(of);
            };
            fmt::print(
                "| {:.0f} | {} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {:.1f} | {:.2f} | {} |\n",
                100 * motion, declared.what, percent(tally.first, frames),
                percent(tally.all, frames), tally.all.rms_um(),
                percent(tally.tracked, tally.predicted), percent(tally.on_device, tally.predicted),
                tally.on_device.rms_um(), tally.wrong());
            std::fflush(stdout);
            is_right &= tally.wrong() == 0 && count.is_complete();
        }
    }
    return is_right;
}

}  // namespace dotpose::tables
