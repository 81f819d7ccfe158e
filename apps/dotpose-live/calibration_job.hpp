/// Calibrates a lens in a second thread, so that the frames of the camera go on being shown.
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
    /// Stops a calibration that is running, after the frame or the fit it is at.
    ~CalibrationJob();
    CalibrationJob(const CalibrationJob&) = delete;
    CalibrationJob& operator=(const CalibrationJob&) = delete;

    bool is_running() const { return job_.valid(); }

    /// Starts to calibrate with these frames. No other calibration may be running.
    void start(Frames frames);

    /// Waits at most so long for the calibration that is running. Returns whether it has ended.
    bool wait(std::chrono::milliseconds patience);

    /// Returns the result of the newest calibration, unless it failed.
    const std::optional<LensCalibration>& newest() const { return newest_; }
    /// Returns why the newest calibration failed.
    const std::string& problem() const { return problem_; }
    /// Returns the number of frames of the newest calibration that has ended, or 0.
    std::size_t frames() const { return frames_; }

  private:
    CalibrateOptions options_;
    std::atomic<bool> ends_ = false;
    std::size_t running_frames_ = 0;
    std::size_t frames_ = 0;
    std::optional<LensCalibration> newest_;
    std::string problem_;
    std::future<LensCalibration> job_;  // the last member: it ends before what it uses
};

}  // namespace dotpose::cli
