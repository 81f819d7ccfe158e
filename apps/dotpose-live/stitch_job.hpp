/// Measures the relative positions of sheets, using frames from a running camera. The measurement
/// runs in a separate thread.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "dotpose/tools/calibrate.hpp"
#include "new_places.hpp"
#include "reading.hpp"

namespace dotpose::cli {

class StitchJob {
  public:
    /// Maximum number of frames with two sheets in view. Further frames are not used.
    static constexpr std::size_t kMaxFrames = 60;

    struct Progress {
        int tried = 0;             ///< number of frames that were examined
        std::size_t used = 0;      ///< number of frames with two sheets in view
        bool is_complete = false;  ///< true if no further frames will be used
        std::string problem;       ///< reason why there is no result yet, or empty
        std::optional<Stitching> result;
    };

    /// `changed` is called on the job's thread after each frame.
    StitchJob(std::vector<SheetEntry> sheets, std::optional<Camera> camera,
              std::function<void(const Progress&)> changed);
    /// Stops the measurement after the current frame.
    ~StitchJob();
    StitchJob(const StitchJob&) = delete;
    StitchJob& operator=(const StitchJob&) = delete;

    /// Copies a frame if the job is idle and the frame may show two sheets. This is the case if the
    /// frame
    /// - shows a new place near the edge of a sheet, or
    /// - was not located. Such frames are copied at most once every 500 ms.
    ///
    /// `image` is the image that was passed to the locator.
    void offer(const Reading& reading, ImageView image);

    const std::vector<SheetEntry>& sheets() const { return sheets_; }
    /// Returns the newest result, or nullopt if there is no result yet.
    std::optional<Stitching> result() const;

  private:
    using Clock = std::chrono::steady_clock;

    void run();
    bool shows_seam(const GreyImage& frame) const;
    Progress measure() const;

    std::vector<SheetEntry> sheets_;
    std::optional<Camera> camera_;
    std::function<void(const Progress&)> changed_;
    CalibrateOptions options_;

    // Used only by `offer`.
    NewPlaces places_;
    Clock::time_point unlocated_at_{};

    // Used only by the job's thread.
    std::vector<GreyImage> frames_;
    std::size_t bytes_ = 0;
    int tried_ = 0;

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::optional<GreyImage> waiting_;
    bool is_idle_ = true;
    std::atomic<bool> ends_ = false;
    std::optional<Stitching> result_;
    std::thread thread_;  // declared last, because the thread uses the other members
};

}  // namespace dotpose::cli
