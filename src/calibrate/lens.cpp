// Calibrates a lens in three rounds. The first round locates the frames and fits a lens. The second
// round locates the frames again with this lens. The third round adds all dots that the second fit
// predicts. Unlike the paper, which uses calibration images, dotpose calibrates with frames of any
// printed sheet.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <fmt/core.h>

#include "calibrate/all_dots.hpp"
#include "calibrate/camera_lens.hpp"
#include "calibrate/least_squares.hpp"
#include "calibrate/lens_fit.hpp"
#include "calibrate/located_frame.hpp"
#include "calibrate/paper_view.hpp"
#include "calibrate/sheet_spacing.hpp"
#include "dotpose/tools/calibrate.hpp"
#include "dotpose/tools/calibration_coverage.hpp"
#include "dotpose/tools/print.hpp"

namespace dotpose {
namespace {

using namespace dotpose::calibrate;

/// Two frames are treated as views of the same dots if their positions on the sheet differ by at
/// most this distance, in spacings.
constexpr double kSamePlace = 1.5;

/// Reads the frames given to `calibrate_lens`. Throws Error if their sizes differ, and detects
/// duplicates.
class Series {
  public:
    Series(int frames, const FrameAt& frame_at, const CalibrateOptions& options)
        : frame_at_(frame_at), options_(options), total_(2 * frames) {}

    /// Loads frame `index` for the first round. Returns an empty optional if the frame is identical
    /// to an earlier frame.
    std::optional<GreyImage> new_frame(int index) {
        GreyImage image = frame_at_(index);
        if (width_px == 0) {
            width_px = image.width_px;
            height_px = image.height_px;
        }
        if (image.width_px != width_px || image.height_px != height_px) {
            throw Error(fmt::format(
                "frames of different sizes, {} x {} and {} x {} px: calibrate with frames of one "
                "camera, all of the size it will be used with",
                width_px, height_px, image.width_px, image.height_px));
        }
        std::uint64_t hash = 14695981039346656037u;  // FNV-1a
        for (const std::uint8_t grey : image.pixels)
            hash = (hash ^ grey) * 1099511628211u;
        const bool is_new = std::ranges::find(hashes_, hash) == hashes_.end();
        if (!is_new) return std::nullopt;
        hashes_.push_back(hash);
        return image;
    }
    GreyImage frame_again(int index) const { return frame_at_(index); }
    void step() {
        if (options_.progress && !options_.progress(++done_, total_)) {
            throw Error("stopped; nothing was written");
        }
    }

    int width_px = 0;
    int height_px = 0;

  private:
    const FrameAt& frame_at_;
    const CalibrateOptions& options_;
    int total_;
    int done_ = 0;
    std::vector<std::uint64_t> hashes_;
};

/// Fits a separate scale, shear and perspective to the residuals of one frame. Returns the
/// resulting decrease in the sum of squares, in units of the residual variance. If the height and
/// tilt are the same in all frames, the expected decrease is 5, the number of additional
/// parameters.
double gain_of_own_view(const LocatedFrame& frame,
                        const std::vector<std::array<double, 2>>& residuals,
                        const std::vector<char>& is_outlier, const FitSetting& setting,
                        double sigma_px) {
    NormalEquations equations(8);
    const double reach_px = setting.reach_px();
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        if (is_outlier[k]) continue;
        const double a = (frame.dots[k].pixel.u - (setting.width_px - 1) / 2.0) / reach_px;
        const double b = (frame.dots[k].pixel.v - (setting.height_px - 1) / 2.0) / reach_px;
        // To first order, the parameters are position (2), rotation, scale, shear (2) and
        // perspective (2).
        equations.add(std::array{1.0, 0.0, -b, a, a, b, a * a, a * b}, residuals[k][0]);
        equations.add(std::array{0.0, 1.0, a, b, -b, a, a * b, b * b}, residuals[k][1]);
    }
    return equations.explained_squares() / (sigma_px * sigma_px);
}

/// Returns true if the heights and tilts of the frames differ significantly.
bool is_held_by_hand(const std::vector<LocatedFrame>& located, const FitSetting& setting,
                     const LensFit& mounted) {
    double gain = 0;
    for (std::size_t i = 0; i < located.size(); ++i) {
        gain += gain_of_own_view(located[i], mounted.residuals_px[i], mounted.is_outlier[i],
                                 setting, mounted.residual_px);
    }
    const double by_chance = 5 * static_cast<double>(located.size());
    // Minimum excess over the gain expected by chance, in standard deviations.
    constexpr double kBeyondDoubt = 6;
    return gain > by_chance + kBeyondDoubt * std::sqrt(2 * by_chance);
}

struct Fits {
    LensFit before;
    LensFit after;
};

Fits fit_all(const std::vector<LocatedFrame>& located, const FitSetting& setting) {
    Fits fits;
    fits.before = fit_lens(located, setting, Stand::ideal);
    fits.after = fit_lens(located, setting, Stand::mounted, &fits.before);
    if (is_held_by_hand(located, setting, fits.after)) {
        fits.after = fit_lens(located, setting, Stand::by_hand, &fits.after);
    }
    return fits;
}

Camera camera_of(const LensFit& fit, const FitSetting& setting) {
    const double reach_px = setting.reach_px();
    const auto& lens = fit.camera.lens;
    Camera camera;
    camera.width_px = setting.width_px;
    camera.height_px = setting.height_px;
    camera.k_per_px2 = lens[0] / (reach_px * reach_px);
    camera.centre_px = {(setting.width_px - 1) / 2.0 + lens[1],
                        (setting.height_px - 1) / 2.0 + lens[2]};
    camera.sigma["k_per_px2"] = fit.sigma.lens[0] / (reach_px * reach_px);
    camera.sigma["centre_u_px"] = fit.sigma.lens[1];
    camera.sigma["centre_v_px"] = fit.sigma.lens[2];
    if (fit.stand == Stand::mounted) {
        describe_mounted(fit, reach_px, camera);
        describe_centre(fit, reach_px, camera);
    } else {
        describe_handheld(fit, reach_px, camera);
    }
    try {
        validate(camera);
    } catch (const BadArgument& error) {
        throw Error(fmt::format(
            "the frames give no plausible lens ({}): take more frames, all over the sheet",
            error.what()));
    }
    return camera;
}

/// Returns true if the positions of all frames on the sheet are within kSamePlace of the position
/// of the first frame.
bool is_same_place(const std::vector<LocatedFrame>& located, const LensFit& fit,
                   double spacing_mm) {
    for (std::size_t i = 1; i < located.size(); ++i) {
        const Cell a = located[0].place.cell;
        const Cell b = located[i].place.cell;
        const double dx = double(b.x) - a.x + (fit.poses[i][0] - fit.poses[0][0]) / spacing_mm;
        const double dy = double(b.y) - a.y + (fit.poses[i][1] - fit.poses[0][1]) / spacing_mm;
        if (std::hypot(dx, dy) > kSamePlace) return false;
    }
    return true;
}

void measure_coverage(LensCalibration& result) {
    ImageCoverage parts(result.camera.width_px, result.camera.height_px);
    for (const CalibrationDot& dot : result.seen)
        parts.add(dot.pixel);
    result.coverage = parts.fraction();
}

void judge(bool is_same, LensCalibration& result) {
    const auto say = [&result](CalibrationVerdict verdict, std::string advice) {
        result.verdict = verdict;
        result.advice = std::move(advice);
    };
    if (is_same) {
        say(CalibrationVerdict::same_place,
            "all frames show the same dots, so printing errors look like lens errors: move the "
            "camera by some centimetres between frames");
    } else if (result.dot_width > kWidestDot) {
        say(CalibrationVerdict::out_of_focus,
            fmt::format("the dots are blurred to {:.0f} % of their spacing (sharp ones are 17 %): "
                        "focus the lens, then calibrate again, because focusing changes the scale",
                        100 * result.dot_width));
    } else if (result.located < kWantedFrames) {
        say(CalibrationVerdict::too_few_frames,
            fmt::format("only {} different frames show the pattern: take {} to 50 frames at "
                        "different places and angles",
                        result.located, kWantedFrames));
    } else if (result.coverage < kMinCoverage) {
        say(CalibrationVerdict::corners_unseen,
            fmt::format(
                "only {:.0f} % of the image shows dots in any frame, so the lens is not measured "
                "elsewhere: make sure that the pattern fills the image and is evenly lit",
                100 * result.coverage));
    } else {
        say(CalibrationVerdict::good, "use the file with 'dotpose locate --camera'");
    }
}

/// Sets the residuals, counts, scale, dots and coverage of the calibration.
void describe(const std::vector<LocatedFrame>& located, const Fits& fits, LensCalibration& result) {
    result.is_mounted = fits.after.stand != Stand::by_hand;
    result.residual_before_px = fits.before.residual_px;
    result.residual_px = fits.after.residual_px;
    result.dots = fits.after.dots;
    const auto frames = static_cast<double>(located.size());
    for (std::size_t i = 0; i < located.size(); ++i) {
        const LocatedFrame& frame = located[i];
        result.px_per_spacing += frame.spacing_px / frames;
        result.dot_width += frame.dot_width / frames;
        for (std::size_t k = 0; k < frame.dots.size(); ++k) {
            if (fits.after.is_outlier[i][k]) {
                ++result.outliers;
                continue;
            }
            const auto& before = fits.before.residuals_px[i][k];
            const auto& after = fits.after.residuals_px[i][k];
            result.seen.push_back(
                {frame.index, frame.dots[k].pixel, {before[0], before[1]}, {after[0], after[1]}});
        }
    }
    measure_coverage(result);
}

std::vector<LocatedFrame> read_first(int frames, Series& series, FrameReader& reader,
                                     LensCalibration& result) {
    std::vector<LocatedFrame> located;
    for (int i = 0; i < frames; ++i) {
        const auto image = series.new_frame(i);
        if (!image) {
            ++result.duplicates;
        } else if (auto frame = reader.read(image->view())) {
            frame->index = i;
            located.push_back(std::move(*frame));
        }
        series.step();
    }
    if (frames > 1 && result.duplicates == frames - 1) {
        throw Error(
            fmt::format("all {} frames are the same image: move the camera between them", frames));
    }
    if (located.empty()) {
        throw Error(
            fmt::format("no pattern was found in any of the {} frames: look at one of them with "
                        "'dotpose locate --draw', and make sure that the dots are in focus, dark "
                        "on light, 6 to 60 px apart, and of this --code",
                        frames));
    }
    if (located.size() == 1) {
        throw Error(
            fmt::format("only 1 of {} frames shows a pattern that can be located: take {} to 50 "
                        "frames at different places and angles",
                        frames, kWantedFrames));
    }
    return located;
}

std::vector<LocatedFrame> read_again(const std::vector<LocatedFrame>& first, Series& series,
                                     FrameReader& reader) {
    std::vector<LocatedFrame> located;
    for (const LocatedFrame& before : first) {
        auto frame = reader.read(series.frame_again(before.index).view());
        located.push_back(frame ? std::move(*frame) : before);
        located.back().index = before.index;
        series.step();
    }
    return located;
}

}  // namespace

const char* name(CalibrationVerdict verdict) {
    switch (verdict) {
        case CalibrationVerdict::too_few_frames:
            return "too_few_frames";
        case CalibrationVerdict::same_place:
            return "same_place";
        case CalibrationVerdict::out_of_focus:
            return "out_of_focus";
        case CalibrationVerdict::corners_unseen:
            return "corners_unseen";
        default:
            return "good";
    }
}

std::optional<CodeVariant> given_code(const CalibrateOptions& options) {
    return options.any_code ? std::nullopt : std::optional(options.pattern.code);
}

LensCalibration calibrate_lens(int frames, const FrameAt& frame_at,
                               const CalibrateOptions& options) {
    if (frames < 1) throw BadArgument("no frames were given");
    if (frames == 1) {
        throw Error(
            fmt::format("a single frame does not distinguish lens errors from printing errors: "
                        "take {} to 50 frames at different places and angles",
                        kWantedFrames));
    }
    LensCalibration result;
    result.frames = frames;
    Series series(frames, frame_at, options);
    FrameReader reader(given_code(options));
    const auto first = read_first(frames, series, reader, result);
    std::vector<Place> places;
    for (const LocatedFrame& frame : first)
        places.push_back(frame.place);
    result.spacing_mm = printed_spacing_mm(options, reader.code(), places);
    const FitSetting setting{series.width_px, series.height_px, result.spacing_mm};
    // Sets the lens before the second round, because the reader finds dots in the corners of the
    // image only if the lens is known.
    reader.use_lens(lens_of(camera_of(fit_all(first, setting).after, setting)));
    auto located = read_again(first, series, reader);
    take_all_dots(fit_all(located, setting).after, setting, reader.code(), located);
    const Fits fits = fit_all(located, setting);
    result.code = reader.code();
    result.located = static_cast<int>(located.size());
    result.camera = camera_of(fits.after, setting);
    describe(located, fits, result);
    judge(is_same_place(located, fits.after, setting.spacing_mm), result);
    return result;
}

}  // namespace dotpose
