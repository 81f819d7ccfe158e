/// Calibrates a lens in a second thread, so new frames of the camera can be shown during the
/// calibration.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/tools/calibrate.hpp"

namespace dotpose::cli {

class CalibrationJob {
  public:
    using Frames = std::vector<std::shared_ptr<const GreyImage>>;

    explicit CalibrationJob(const CalibrateOptions& options);
    /// Waits for a running calibration to stop. The calibration stops after its current frame or
    /// fit.
    ~CalibrationJob();
    CalibrationJob(const CalibrationJob&) = delete;
    CalibrationJob& operator=(const CalibrationJob&) = delete;

    bool is_running() const { return job_.valid(); }

    /// Starts a calibration with these frames. No other calibration may be running.
    void start(Frames frames);

    /// Waits at most `patience` for the end of the running calibration. Returns true if the
    /// calibration has ended. A calibration must be running.
    bool wait(std::chrono::milliseconds patience);

    /// Returns the result of the newest finished calibration, or none if it failed or if no
    /// calibration has finished.
    const std::optional<LensCalibration>& newest() const { return newest_; }
    /// Returns the reason why the newest finished calibration failed, or an empty string if it
    /// succeeded.
    const std::string& problem() const { return problem_; }
    /// Returns the number of frames of the newest finished calibration, or 0.
    std::size_t frames() const { return frames_; }

  private:
    CalibrateOptions options_;
    std::atomic<bool> ends_ = false;
    std::size_t running_frames_ = 0;
    std::size_t frames_ = 0;
    std::optional<LensCalibration> newest_;
    std::string problem_;
    std::future<LensCalibration> job_;  // last member, because the job uses the other members
};

}  // namespace dotpose::cli
