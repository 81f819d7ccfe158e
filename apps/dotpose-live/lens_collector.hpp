/// Collects frames for a lens calibration while the camera moves, and calibrates the lens in the
/// background.
///
///     LensCollector collector(options);
///     while (!collector.is_enough() && !collector.is_full() && source.next(frame)) {
///         show(collector.status(collector.take(frame)));
///         collector.start_if_useful();
///         collector.wait(0ms);
///     }
///     if (collector.finish([] { return true; })) use(collector.result());
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/located_frame.hpp"
#include "calibration_job.hpp"
#include "calibration_status.hpp"
#include "capture/frame_source.hpp"
#include "new_places.hpp"

namespace dotpose::cli {

/// Measures the speed at which the image moves between located frames.
class ImageMotion {
  public:
    /// Returns an upper bound on the speed at which the image has moved since the previous located
    /// frame, in px/s, for points within `reach_px` of the image centre. Returns infinity if the
    /// speed is unknown.
    double speed_px_s(const Fix& fix, std::int64_t time_us, double reach_px);
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

class LensCollector {
  public:
    struct Outcome {
        std::string refusal;  ///< reason why the frame was rejected, or empty if it was accepted
        ImageView image;      ///< pixels of the frame, valid until the next frame is read
        bool is_located = false;
        bool is_taken() const { return refusal.empty(); }
    };

    explicit LensCollector(const CalibrateOptions& options);

    /// Accepts or rejects a frame. The pixels of an accepted frame are moved out of `frame`. The
    /// image must not be empty. Throws BadArgument if the image size differs from the size of
    /// earlier images.
    Outcome take(capture::Frame& frame);

    /// Returns the progress after a frame. `outcome` is the result of `take` for this frame.
    CalibrationStatus status(const Outcome& outcome) const;

    /// Returns the trace of the newest frame.
    Trace trace() const { return reader_.trace(); }

    /// Starts a calibration with the frames collected so far if the result is likely to be better
    /// than the last one.
    void start_if_useful();
    bool is_calibrating() const { return job_.is_running(); }
    /// Waits up to `patience` for the running calibration. Returns true if it has finished.
    bool wait(std::chrono::milliseconds patience);

    /// Returns true if all requirements are met and the verdict of the last calibration is good.
    bool is_enough() const;
    /// Returns true if the maximum number of frames has been collected.
    bool is_full() const;

    /// Calibrates with all frames, if there are enough, and waits for the result. While waiting,
    /// calls `goes_on` repeatedly. If `goes_on` returns false, stops waiting and returns false.
    bool finish(const std::function<bool()>& goes_on);

    /// Returns the last calibration. Must be called after `finish`. Throws Error if the calibration
    /// failed, or if the frames are not sufficient for the `good` verdict. In the latter case, the
    /// message names the unmet requirements.
    const LensCalibration& result() const;

    /// Returns the unmet requirements. `take` must have been called at least once.
    std::vector<CalibrationNeed> needs() const { return coverage_->missing(lens()); }

    /// Sets the bit rate of the source (capture/frame_source.hpp), which is used for advice.
    void set_bits_per_px(double bits_per_px) { bits_per_px_ = bits_per_px; }

  private:
    /// Frame counts, used to explain why too few frames were accepted.
    struct Tally {
        std::int64_t seen = 0;
        std::int64_t located = 0;
        std::int64_t out_of_focus = 0;
        std::int64_t moving = 0;
    };

    void start_with(const GreyImage& image);
    std::string refusal(const capture::Frame& frame,
                        const std::optional<calibrate::LocatedFrame>& located);
    bool is_steady(const capture::Frame& frame);
    bool is_new(const CalibrationView& view, ImageView image);
    bool is_worth_calibrating() const;
    std::optional<Camera> lens() const;
    std::string shortage() const;

    calibrate::FrameReader reader_;
    CalibrationJob job_;
    CalibrationJob::Frames taken_;
    std::optional<CalibrationCoverage> coverage_;  ///< nullopt until the first frame
    std::vector<FrameTilt> tilts_;
    int width_px_ = 0;
    int height_px_ = 0;
    NewPlaces places_;
    ImageMotion motion_;
    /// Time of the newest frame in which the camera was steady. Before the first such frame, this
    /// is the time of the first frame, or 0 if the first frame was not located.
    std::int64_t steady_us_ = 0;
    Tally tally_;
    GreyImage failed_;  ///< newest frame that was refused before the first fix
    Status failure_ = Status::ok;
    double bits_per_px_ = 0;
};

}  // namespace dotpose::cli
