/// Calibrates a lens in a background thread, so the program can continue to display camera frames.
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
    /// Stops a running calibration after its current frame or fit, and waits until it has stopped.
    ~CalibrationJob();
    CalibrationJob(const CalibrationJob&) = delete;
    CalibrationJob& operator=(const CalibrationJob&) = delete;

    bool is_running() const { return job_.valid(); }

    /// Starts a calibration with these frames. Must not be called while a calibration is running.
    void start(Frames frames);

    /// Waits up to `patience` for the running calibration. Returns true if it has finished. A
    /// calibration must be running.
    bool wait(std::chrono::milliseconds patience);

    /// Returns the result of the last finished calibration, or nullopt if that calibration failed
    /// or no calibration has finished.
    const std::optional<LensCalibration>& newest() const { return newest_; }
    /// Returns the reason why the last finished calibration failed, or an empty string if it
    /// succeeded.
    const std::string& problem() const { return problem_; }
    /// Returns the number of frames in the last finished calibration, or 0 if none has finished.
    std::size_t frames() const { return frames_; }

  private:
    CalibrateOptions options_;
    std::atomic<bool> ends_ = false;
    std::size_t running_frames_ = 0;
    std::size_t frames_ = 0;
    std::optional<LensCalibration> newest_;
    std::string problem_;
    std::future<LensCalibration> job_;  // declared last, because the job uses the other members
};

}  // namespace dotpose::cli
