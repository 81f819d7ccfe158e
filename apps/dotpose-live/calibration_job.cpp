#include "calibration_job.hpp"

#include <utility>

#include "dotpose/files/error.hpp"

namespace dotpose::cli {

CalibrationJob::CalibrationJob(const CalibrateOptions& options) : options_(options) {
    options_.progress = [this](int, int) { return !ends_; };
}

CalibrationJob::~CalibrationJob() {
    ends_ = true;
}

void CalibrationJob::start(Frames frames) {
    running_frames_ = frames.size();
    job_ = std::async(std::launch::async, [this, frames = std::move(frames)] {
        return calibrate_lens(
            static_cast<int>(frames.size()),
            [&frames](int index) { return *frames[static_cast<std::size_t>(index)]; }, options_);
    });
}

bool CalibrationJob::wait(std::chrono::milliseconds patience) {
    if (job_.wait_for(patience) != std::future_status::ready) return false;
    frames_ = running_frames_;
    newest_.reset();
    problem_.clear();
    try {
        newest_ = job_.get();
    } catch (const Error& error) {
        problem_ = error.what();
    }
    return true;
}

}  // namespace dotpose::cli
