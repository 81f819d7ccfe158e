/// Calibrates the camera of a running `dotpose watch` in five steps: the lens, the mount of the
/// camera from a turn on the spot, the forward direction from a straight drive, the readout time
/// from a fast drive, and the tip of a pen from pivoting.
///
/// The main thread passes frames and commands to the guide. These calls return immediately and copy
/// only the frames that the guide needs. A thread with a lower priority selects the frames for the
/// lens, computes the calibration, and writes the file.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "calibrate_report.hpp"
#include "calibration_status.hpp"
#include "dotpose/tools/draw.hpp"
#include "guided_frames.hpp"
#include "lens_collector.hpp"
#include "reading.hpp"

namespace dotpose::cli {

enum class GuideStep { lens, spin, drive, readout, pivot };
/// Returns the identifier, such as "spin".
const char* name(GuideStep step);
/// Returns the step with the identifier `name`, or an empty optional if there is no such step.
std::optional<GuideStep> guide_step(const std::string& name);

/// State of the current step.
enum class GuidePhase {
    idle,        ///< no step was started
    collecting,  ///< frames are taken
    solving,     ///< the calibration is computed
    solved,      ///< the result can be saved
    failed,      ///< there is no result; `GuideState::problem` is the reason
    saved        ///< the result is in the camera file
};
const char* name(GuidePhase phase);

struct GuideOptions {
    std::string file;  ///< camera file; no other file is written
    CalibrateOptions calibrate;
    SpacingSource spacing = SpacingSource::assumed;
    /// Camera of the run. Each step changes only the values that it calibrates.
    std::optional<Camera> camera;
    bool needs_focal_length = false;  ///< true if the run fits poses in space
    bool flip = false;  ///< true if the source flips the frames; written to the camera file
};

struct GuideResult {
    Camera camera;
    std::string report;                           ///< lines of `dotpose calibrate`
    bool is_good = true;                          ///< false if the verdict is a warning
    std::optional<ResidualField> residuals = {};  ///< only for the step `lens`
    std::vector<SpinStation> stations = {};       ///< only for the step `spin`
    std::vector<std::string> improvements = {};   ///< what could be improved with more frames
};

struct GuideState {
    GuideStep step = GuideStep::lens;
    GuidePhase phase = GuidePhase::idle;
    int frames = 0;  ///< number of frames that were taken
    std::vector<video::Gauge> gauges;
    std::string advice;                     ///< what to do now
    std::optional<CalibrationStatus> lens;  ///< coverage; only for the step `lens`
    /// One element for each direction of a turning robot, or of the tilt of a pen. True if there
    /// are enough frames with this direction.
    std::vector<bool> directions;
    std::vector<PenLean> leans;      ///< tilts of a pen
    std::vector<std::string> needs;  ///< unmet requirements of a step with a moving robot
    std::string problem;             ///< failure of the step, or of writing the file
    std::optional<GuideResult> result;
    std::optional<Camera> camera;  ///< given camera, or the last saved one
};

class CalibrationGuide {
  public:
    explicit CalibrationGuide(GuideOptions options);
    /// Cancels the running step.
    ~CalibrationGuide();
    CalibrationGuide(const CalibrationGuide&) = delete;
    CalibrationGuide& operator=(const CalibrationGuide&) = delete;

    /// Cancels the running step, if there is one, and starts `step`.
    void start(GuideStep step);
    /// Computes the result of the step from the frames taken so far. The step fails if these frames
    /// do not determine the result.
    void finish();
    void cancel();
    /// Writes the result of the current step into the file. Does nothing if there is no result.
    void save();

    /// Uses these sheets in all calculations that start from now on.
    void set_sheets(std::vector<SheetEntry> sheets);

    /// Takes a frame if the current step needs it. `image` is the image that was located.
    /// `bits_per_px` is the bit rate of the source (capture/frame_source.hpp).
    void take(const capture::Frame& frame, const Reading& reading, ImageView image,
              double bits_per_px);

    /// Returns the camera that was saved since the previous call, or an empty optional if none was
    /// saved.
    std::optional<Camera> take_camera();

    const std::string& file() const { return options_.file; }
    GuideState state() const;
    /// Returns a number that increases with each change of the state.
    std::uint64_t version() const;

  private:
    using Clock = std::chrono::steady_clock;

    // These functions run in the thread.
    void run();
    void begin(GuideStep step);
    void reset();
    void fail(const std::string& problem);
    void look(capture::Frame frame, double bits_per_px);
    void solve();
    GuideResult result_of(GuideStep step);
    GuideResult lens_result();
    void write();
    void update(const std::function<void(GuideState&)>& change);

    void post(bool cancels, std::function<void()> job);
    void show_guided();
    void offer(const capture::Frame& frame, ImageView image, double bits_per_px);

    GuideOptions options_;
    std::unique_ptr<LensCollector> collector_;  ///< used by the thread only
    std::atomic<bool> cancels_ = false;         ///< true to end the running calculation

    mutable std::mutex mutex_;  ///< guards the following members
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    bool is_busy_ = false;  ///< true while a job runs
    bool stops_ = false;
    GuideState state_;
    std::uint64_t version_ = 0;
    std::unique_ptr<GuidedFrames> guided_;  ///< none during the step `lens`
    int lost_ = 0;                          ///< number of frames since the last one with a fix
    std::optional<Camera> saved_camera_;
    Clock::time_point next_offer_{};

    std::thread thread_;  // last member, because the thread uses the other members
};

}  // namespace dotpose::cli
