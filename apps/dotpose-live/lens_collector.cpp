#include "lens_collector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "calibrate/camera_lens.hpp"
#include "picture_advice.hpp"

namespace dotpose::cli {
namespace {

/// Maximum number of collected frames. More frames would increase the computing time without
/// improving the result.
constexpr std::size_t kMaxFrames = 50;
/// Image speed in px/s below which a camera is considered steady. At this speed, the image moves by
/// at most one pixel during an exposure or readout of up to 1/30 s.
constexpr double kSteady_px_s = 30;
/// If no frame is steady for this long, frames from a moving camera are also accepted, because the
/// robot may never stop.
constexpr std::int64_t kPatience_us = 3'000'000;
/// A frame that shows no new place (see `NewPlaces`) is accepted only if its dots cover at least
/// this number of image blocks that the collected frames do not cover.
constexpr int kNewParts = 3;

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

FrameTilt tilt_of(const Trace& trace, ImageView image) {
    const FixedVec& perspective = trace.pattern_from_image.perspective_q30;
    const double corner_px = std::hypot(image.width_px, image.height_px) / 2;
    const double scale = std::ldexp(corner_px, -30);
    return {scale * perspective.x, scale * perspective.y};
}

}  // namespace

double ImageMotion::speed_px_s(const Fix& fix, std::int64_t time_us, double reach_px) {
    const std::optional<Seen> before =
        std::exchange(newest_, Seen{fix.x_grid(), fix.y_grid(), fix.theta_rad(), time_us});
    const double elapsed_s = before ? static_cast<double>(time_us - before->time_us) * 1e-6 : 0;
    if (elapsed_s <= 0) return std::numeric_limits<double>::infinity();
    const double turn = std::remainder(fix.theta_rad() - before->theta_rad, 2 * std::numbers::pi);
    const double step_grid =
        std::hypot(fix.x_grid() - before->x_grid, fix.y_grid() - before->y_grid);
    return (step_grid * fix.spacing_px() + std::abs(turn) * reach_px) / elapsed_s;
}

LensCollector::LensCollector(const CalibrateOptions& options)
    : reader_(given_code(options)), job_(options) {}

void LensCollector::start_with(const GreyImage& image) {
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

bool LensCollector::is_steady(const capture::Frame& frame) {
    if (!frame.file.empty()) return true;  // image files are assumed to come from a steady camera
    const double reach_px = std::hypot(width_px_, height_px_) / 2;
    const bool is_slow =
        motion_.speed_px_s(reader_.trace().fix, frame.time_us, reach_px) < kSteady_px_s;
    if (is_slow || tally_.seen == 1) steady_us_ = frame.time_us;
    return is_slow || frame.time_us - steady_us_ > kPatience_us;
}

bool LensCollector::is_new(const CalibrationView& view, ImageView image) {
    return places_.take(reader_.trace().fix, image) || coverage_->parts_added_by(view) >= kNewParts;
}

/// Returns the reason why a frame is rejected, or an empty string if it is accepted.
std::string LensCollector::refusal(const capture::Frame& frame,
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

LensCollector::Outcome LensCollector::take(capture::Frame& frame) {
    start_with(frame.image);
    const auto located = reader_.read(frame.image.view());
    // `outcome.image` remains valid after the pixels are moved out of `frame`, because moving a
    // vector does not move its elements.
    Outcome outcome{refusal(frame, located), frame.image.view(), located.has_value()};
    if (outcome.is_taken()) {
        coverage_->add(view_of(*located, reader_.trace().fix));
        tilts_.push_back(tilt_of(reader_.trace(), outcome.image));
        taken_.push_back(std::make_shared<const GreyImage>(std::move(frame.image)));
    }
    return outcome;
}

CalibrationStatus LensCollector::status(const Outcome& outcome) const {
    CalibrationStatus status(*coverage_);
    status.needs = needs();
    status.tilts = tilts_;
    status.is_taken = outcome.is_taken();
    status.now = status.is_taken ? "move on to another place" : outcome.refusal;
    if (outcome.is_located) status.theta_rad = reader_.trace().fix.theta_rad();
    if (const auto camera = lens()) status.corner_sigma_px = corner_sigma_px(*camera);
    if (!job_.newest()) return status;
    if (status.needs.empty()) {
        status.remark = job_.newest()->advice;
    } else if (!job_.newest()->camera.focal_px) {
        status.remark = "hand-held camera: also tilt it, to determine its focal length";
    }
    return status;
}

std::optional<Camera> LensCollector::lens() const {
    return job_.newest() ? std::optional(job_.newest()->camera) : std::nullopt;
}

/// Returns true if a new calibration is likely to be better than the last one. Normally, the number
/// of frames must have doubled since the last calibration, because each calibration takes longer
/// than the previous one. If only the accuracy of the lens is insufficient, a smaller increase may
/// suffice. The standard deviation is inversely proportional to the square root of the number of
/// frames, so the required factor is (current / wanted standard deviation)^2.
bool LensCollector::is_worth_calibrating() const {
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

void LensCollector::start_if_useful() {
    if (!job_.is_running() && is_worth_calibrating()) job_.start(taken_);
}

bool LensCollector::wait(std::chrono::milliseconds patience) {
    if (!job_.is_running() || !job_.wait(patience)) return false;
    constexpr double kMaxCornerSigma_px = 1;
    const auto camera = lens();
    if (camera && corner_sigma_px(*camera) < kMaxCornerSigma_px)
        reader_.use_lens(calibrate::lens_of(*camera));
    return true;
}

bool LensCollector::is_enough() const {
    return coverage_ && job_.newest() && job_.newest()->verdict == CalibrationVerdict::good &&
           needs().empty();
}

bool LensCollector::is_full() const {
    return taken_.size() >= kMaxFrames;
}

bool LensCollector::finish(const std::function<bool()>& goes_on) {
    constexpr std::chrono::milliseconds kPatience{50};
    if (taken_.size() < std::size_t{kWantedFrames}) return true;
    while (job_.is_running() || job_.frames() < taken_.size()) {
        if (!job_.is_running()) job_.start(taken_);
        while (!wait(kPatience)) {
            if (!goes_on()) return false;
        }
    }
    return true;
}

/// Returns a message that describes the unmet requirements.
std::string LensCollector::shortage() const {
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

const LensCalibration& LensCollector::result() const {
    if (taken_.size() < std::size_t{kWantedFrames}) throw Error(shortage());
    if (!job_.newest()) throw Error(job_.problem());
    const LensCalibration& newest = *job_.newest();
    if (newest.verdict != CalibrationVerdict::good) {
        throw Error(fmt::format("{}; the calibration says {}: {}", shortage(), name(newest.verdict),
                                newest.advice));
    }
    return newest;
}

}  // namespace dotpose::cli
