#include "live_calibration.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "calibrate/camera_lens.hpp"
#include "calibrate/located_frame.hpp"
#include "calibration_display.hpp"
#include "calibration_job.hpp"
#include "capture/source_kind.hpp"
#include "frame_saver.hpp"
#include "new_places.hpp"
#include "picture_advice.hpp"
#include "progress.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;

/// Maximum number of frames that are taken. More frames take longer and do not improve the result.
constexpr std::size_t kMaxLiveFrames = 50;
/// Maximum image speed of a steady camera, in px/s. At this speed, the image moves by less than a
/// pixel during an exposure or the readout of a rolling shutter.
constexpr double kSteady_px_s = 30;
/// Time without a steady frame after which frames of a moving camera are accepted, for example if
/// the robot does not stop.
constexpr std::int64_t kPatience_us = 3'000'000;
/// Minimum number of uncovered image blocks that a frame must cover to be taken at a known place.
constexpr int kNewParts = 3;

/// Measures the speed of the image between two located frames.
class Motion {
  public:
    /// Returns the speed since the previous frame, in px/s, or infinity if the speed is unknown.
    double speed_px_s(const Fix& fix, std::int64_t time_us, double reach_px) {
        const std::optional<Seen> before =
            std::exchange(newest_, Seen{fix.x_grid(), fix.y_grid(), fix.theta_rad(), time_us});
        const double elapsed_s = before ? static_cast<double>(time_us - before->time_us) * 1e-6 : 0;
        if (elapsed_s <= 0) return std::numeric_limits<double>::infinity();
        const double turn =
            std::remainder(fix.theta_rad() - before->theta_rad, 2 * std::numbers::pi);
        const double step_grid =
            std::hypot(fix.x_grid() - before->x_grid, fix.y_grid() - before->y_grid);
        return (step_grid * fix.spacing_px() + std::abs(turn) * reach_px) / elapsed_s;
    }
    void forget() { newest_.reset(); }

  private:
    struct Seen {
        double x_grid;
        double y_grid;
        double theta_rad;
        std::int64_t time_us;
    };
    std::optional<Seen> newest_;
};

/// Frame counts that explain why too few frames were taken.
struct Tally {
    std::int64_t seen = 0;
    std::int64_t located = 0;
    std::int64_t out_of_focus = 0;
    std::int64_t moving = 0;
};

class LiveCalibration {
  public:
    LiveCalibration(const CalibrateOptions& calibration, const LiveCalibrationOptions& options,
                    bool is_camera)
        : is_camera_(is_camera),
          reader_(given_code(calibration)),
          job_(calibration),
          display_(!options.has_no_window && video::has_display()) {
        if (!options.save.empty()) saver_.emplace(SaveOptions{options.save, 1, {}});
    }

    void say(const std::string& message) { display_.say(message); }

    /// Takes frames until there are enough, the source ends or the user stops.
    void take_all(capture::FrameSource& source) {
        try {
            capture::Frame frame;
            while (!is_enough() && taken_.size() < kMaxLiveFrames && source.next(frame)) {
                bits_per_px_ = source.bits_per_px();
                if (!look(frame) || !go_on_calibrating()) break;
            }
        } catch (const BadArgument&) {
            throw;
        } catch (const Error& error) {
            // The frames taken before the failure may be enough.
            say(error.what());
        }
    }

    LensCalibration result();

  private:
    bool look(capture::Frame& frame);
    void start_with(const GreyImage& image);
    std::string refusal(const capture::Frame& frame,
                        const std::optional<calibrate::LocatedFrame>& located);
    bool is_steady(const capture::Frame& frame);
    bool is_new(const CalibrationView& view, ImageView image);
    bool go_on_calibrating();
    bool is_worth_calibrating() const;
    bool is_enough() const;
    std::optional<Camera> lens() const;
    std::vector<CalibrationNeed> needs() const { return coverage_->missing(lens()); }
    void finish_job();
    std::string shortage() const;

    bool is_camera_;
    calibrate::FrameReader reader_;
    CalibrationJob job_;
    CalibrationDisplay display_;
    CalibrationJob::Frames taken_;
    std::optional<CalibrationCoverage> coverage_;  ///< none before the first frame
    int width_px_ = 0;
    int height_px_ = 0;
    std::optional<FrameSaver> saver_;
    NewPlaces places_;
    Motion motion_;
    std::int64_t steady_us_ = 0;  ///< time of the newest steady frame, or of the first frame
    Tally tally_;
    GreyImage failed_;  ///< newest frame before the first located frame
    Status failure_ = Status::ok;
    double bits_per_px_ = 0;  ///< bit rate of the source (capture/frame_source.hpp)
};

void LiveCalibration::start_with(const GreyImage& image) {
    if (!coverage_) {
        width_px_ = image.width_px;
        height_px_ = image.height_px;
        coverage_.emplace(width_px_, height_px_);
    }
    if (image.width_px != width_px_ || image.height_px != height_px_) {
        throw BadArgument(
            fmt::format("frames of different sizes, {} x {} and {} x {} px: calibrate "
                        "with frames of one camera, all of the size it will be used "
                        "with",
                        width_px_, height_px_, image.width_px, image.height_px));
    }
}

bool LiveCalibration::is_steady(const capture::Frame& frame) {
    if (!frame.file.empty()) return true;  // image files are assumed to be from a steady camera
    const double reach_px = std::hypot(width_px_, height_px_) / 2;
    const bool is_slow =
        motion_.speed_px_s(reader_.trace().fix, frame.time_us, reach_px) < kSteady_px_s;
    if (is_slow || tally_.seen == 1) steady_us_ = frame.time_us;
    return is_slow || frame.time_us - steady_us_ > kPatience_us;
}

CalibrationView view_of(const calibrate::LocatedFrame& located, const Fix& fix) {
    CalibrationView view;
    for (const calibrate::LocatedDot& dot : located.dots)
        view.dots.push_back(dot.pixel);
    view.x_grid = fix.x_grid();
    view.y_grid = fix.y_grid();
    view.section = fix.section;
    view.theta_rad = fix.theta_rad();
    view.spacing_px = fix.spacing_px();
    return view;
}

bool LiveCalibration::is_new(const CalibrationView& view, ImageView image) {
    return places_.take(reader_.trace().fix, image) || coverage_->parts_added_by(view) >= kNewParts;
}

/// Returns the reason for not taking a frame, or an empty string if the frame is taken.
std::string LiveCalibration::refusal(const capture::Frame& frame,
                                     const std::optional<calibrate::LocatedFrame>& located) {
    ++tally_.seen;
    if (!located) {
        motion_.forget();
        if (tally_.located == 0) {
            failed_ = frame.image;
            failure_ = reader_.trace().fix.status;
        }
        return reader_.trace().fix.status == Status::mirrored ? "mirrored: start with --flip"
                                                              : "no pattern was located";
    }
    ++tally_.located;
    const bool holds_still = is_steady(frame);
    if (located->dot_width > kWidestDot) {
        ++tally_.out_of_focus;
        return fmt::format("out of focus (dots {:.0f} % of their spacing wide, sharp ones 17 %)",
                           100 * located->dot_width);
    }
    if (!holds_still) {
        ++tally_.moving;
        return "hold still";
    }
    if (!is_new(view_of(*located, reader_.trace().fix), frame.image.view())) {
        return "nothing new here";
    }
    return "";
}

/// Displays a frame, and adds it to the calibration unless `refusal` gives a reason not to. Returns
/// false if the user stopped the calibration.
bool LiveCalibration::look(capture::Frame& frame) {
    // An unplugged camera delivers empty frames.
    if (frame.image.pixels.empty()) return display_.is_wanted();
    start_with(frame.image);
    const auto located = reader_.read(frame.image.view());
    const std::string refusal_reason = refusal(frame, located);
    // This view remains valid when the pixels are moved out of `frame`.
    const ImageView image = frame.image.view();
    if (refusal_reason.empty()) {
        coverage_->add(view_of(*located, reader_.trace().fix));
        if (saver_) saver_->take(image, reader_.trace().fix);
        taken_.push_back(std::make_shared<const GreyImage>(std::move(frame.image)));
    }
    CalibrationStatus status(*coverage_);
    status.needs = needs();
    status.is_taken = refusal_reason.empty();
    status.now = status.is_taken ? "move on to another place" : refusal_reason;
    if (located) status.theta_rad = reader_.trace().fix.theta_rad();
    if (const auto camera = lens()) status.corner_sigma_px = corner_sigma_px(*camera);
    if (job_.newest()) {
        const LensCalibration& newest = *job_.newest();
        if (status.needs.empty()) {
            status.remark = newest.advice;
        } else if (!newest.camera.focal_px) {
            status.remark = "hand-held camera: also tilt it, to determine its focal length";
        }
    }
    return display_.show(status, image, reader_.trace());
}

std::optional<Camera> LiveCalibration::lens() const {
    return job_.newest() ? std::optional(job_.newest()->camera) : std::nullopt;
}

/// Returns true if another calibration would improve on the newest calibration. Each calibration
/// takes longer than the previous one, so the next calibration waits for twice the number of
/// frames. The next calibration waits for fewer frames if only the accuracy of the lens is
/// insufficient, because standard deviations are inversely proportional to the square root of the
/// number of frames.
bool LiveCalibration::is_worth_calibrating() const {
    if (taken_.size() < std::size_t{kWantedFrames} || taken_.size() == job_.frames()) return false;
    const std::vector<CalibrationNeed> missing = needs();
    const bool only_lens = std::ranges::all_of(missing, [](const CalibrationNeed& need) {
        return need.kind == CalibrationNeed::Kind::lens;
    });
    double growth = 2;
    if (const auto camera = lens(); camera && only_lens) {
        growth = std::min(growth, std::pow(corner_sigma_px(*camera) / kWantedCornerSigma_px, 2));
    }
    return static_cast<double>(taken_.size()) >= growth * static_cast<double>(job_.frames());
}

/// Starts and finishes calibrations with the frames taken so far. During a calibration, a camera
/// continues to deliver frames. All other sources wait, to make the result independent of the speed
/// of the computer. Returns false if the user stops.
bool LiveCalibration::go_on_calibrating() {
    if (!coverage_) return true;
    if (!job_.is_running() && is_worth_calibrating()) job_.start(taken_);
    while (job_.is_running()) {
        if (!job_.wait(is_camera_ ? 0ms : 50ms)) {
            if (is_camera_) return true;
            if (interrupted() || !display_.is_wanted()) return false;
            continue;
        }
        constexpr double kMaxCornerSigma_px = 1;
        const auto camera = lens();
        if (camera && corner_sigma_px(*camera) < kMaxCornerSigma_px)
            reader_.use_lens(calibrate::lens_of(*camera));
    }
    return true;
}

bool LiveCalibration::is_enough() const {
    return coverage_ && job_.newest() && job_.newest()->verdict == CalibrationVerdict::good &&
           needs().empty();
}

/// Waits for a calibration with all frames. Throws Error if interrupted.
void LiveCalibration::finish_job() {
    // The first Ctrl-C only ended the acquisition of frames.
    take_ctrl_c();
    ProgressLine line("calibrating the lens");
    while (job_.is_running() || job_.frames() < taken_.size()) {
        if (!job_.is_running()) job_.start(taken_);
        while (!job_.wait(50ms)) {
            if (interrupted()) throw Error("stopped; nothing was written");
            display_.is_wanted();
        }
    }
}

/// Describes the requirements that the frames do not meet.
std::string LiveCalibration::shortage() const {
    std::string text = fmt::format(
        "not enough was seen, and no file was written: of {} frames, {} were located and {} taken "
        "({} out of focus, {} moving)",
        tally_.seen, tally_.located, taken_.size(), tally_.out_of_focus, tally_.moving);
    if (!coverage_) return text;
    if (tally_.located == 0) {
        const auto scratch = std::make_unique<LargeMemory>();
        const std::string advice = advice_on(
            failed_.view(), {failure_, reader_.trace().options, true, bits_per_px_}, *scratch);
        if (!advice.empty()) return text + "; " + advice;
    }
    text += "; missing: ";
    const char* separator = "";
    for (const CalibrationNeed& need : needs()) {
        text += separator + need.advice;
        separator = ", ";
    }
    return text;
}

/// Returns the calibration with all frames. Throws Error if there are not enough frames.
LensCalibration LiveCalibration::result() {
    if (taken_.size() < std::size_t{kWantedFrames}) throw Error(shortage());
    finish_job();
    if (!job_.newest()) throw Error(job_.problem());
    const LensCalibration& newest = *job_.newest();
    if (newest.verdict != CalibrationVerdict::good) {
        throw Error(fmt::format("{}; the calibration says {}: {}", shortage(), name(newest.verdict),
                                newest.advice));
    }
    for (const CalibrationNeed& need : needs())
        say("the calibration can be used, but could be improved: " + need.advice);
    return newest;
}

}  // namespace

LensCalibration calibrate_live(const SourceArguments& arguments, Sources& sources,
                               const CalibrateOptions& calibration,
                               const LiveCalibrationOptions& options) {
    const bool is_camera = std::ranges::any_of(arguments.names, [](const std::string& name) {
        return capture::kind_of(name) == capture::SourceKind::camera;
    });
    LiveCalibration live(calibration, options, is_camera);
    capture::SourceOptions source_options = arguments.options;
    source_options.stop = interrupted;
    source_options.tell = [&live](const std::string& message) { live.say(message); };
    source_options.on_unreadable = [&live](const std::string&, const Error& error) {
        live.say(error.what());
    };
    const auto source = sources.open(source_options);
    source->open();
    live.take_all(*source);
    return live.result();
}

}  // namespace dotpose::cli
