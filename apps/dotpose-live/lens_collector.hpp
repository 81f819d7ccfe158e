/// Takes frames for the calibration of a lens while the camera moves, and calibrates the lens in
/// the background.
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

/// Measures the speed of the image between two located frames.
class ImageMotion {
  public:
    /// Returns the speed of the image since the previous located frame, in px/s, or infinity if it
    /// is not known.
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
        std::string refusal;  ///< reason for not taking the frame; empty if the frame was taken
        ImageView image;      ///< pixels of the frame; valid until the next frame is read
        bool is_located = false;
        bool is_taken() const { return refusal.empty(); }
    };

    explicit LensCollector(const CalibrateOptions& options);

    /// Takes a frame, or returns the reason for not taking it. If the frame is taken, its pixels
    /// are moved out of `frame`. The image must not be empty. Throws BadArgument if the size of the
    /// image differs from the previous ones.
    Outcome take(capture::Frame& frame);

    /// Returns the progress after a frame.
    CalibrationStatus status(const Outcome& outcome) const;

    /// Returns the stages of the newest frame.
    Trace trace() const { return reader_.trace(); }

    /// Starts a calibration with the frames so far if it would improve on the newest calibration.
    void start_if_useful();
    bool is_calibrating() const { return job_.is_running(); }
    /// Waits at most `patience` for the running calibration. Returns true if it has ended.
    bool wait(std::chrono::milliseconds patience);

    /// Returns true if no requirement is unmet and the verdict of the newest calibration is good.
    bool is_enough() const;
    /// Returns true if the maximum number of frames was taken.
    bool is_full() const;

    /// If enough frames were taken, calibrates with all of them and waits for the result. Calls
    /// `goes_on` repeatedly while it waits. Returns false if `goes_on` returned false, otherwise
    /// true.
    bool finish(const std::function<bool()>& goes_on);

    /// Returns the newest calibration. Must be called after `finish`. Throws Error if the frames
    /// are not sufficient for the verdict `good`. The message names the unmet requirements.
    const LensCalibration& result() const;

    /// Returns the unmet requirements. At least one frame must have been read.
    std::vector<CalibrationNeed> needs() const { return coverage_->missing(lens()); }

    /// Sets the compression of the source (capture/frame_source.hpp), for advice.
    void set_bits_per_px(double bits_per_px) { bits_per_px_ = bits_per_px; }

  private:
    /// Frame counts that explain why too few frames were taken.
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
    std::optional<CalibrationCoverage> coverage_;  ///< none before the first frame
    std::vector<FrameTilt> tilts_;
    int width_px_ = 0;
    int height_px_ = 0;
    NewPlaces places_;
    ImageMotion motion_;
    std::int64_t steady_us_ = 0;  ///< time of the newest steady frame, or of the first frame
    Tally tally_;
    GreyImage failed_;  ///< newest frame that was not located, before the first located frame
    Status failure_ = Status::ok;
    double bits_per_px_ = 0;
};

}  // namespace dotpose::cli
