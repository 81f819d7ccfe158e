/// Calibrates the camera of a running `dotpose watch` in five steps:
/// - the lens,
/// - the camera mount, from a turn on the spot,
/// - the forward direction, from a straight drive,
/// - the readout time, from a fast drive, and
/// - the tip of a pen, from pivoting the pen about its tip.
///
/// The main thread passes frames and commands to the guide. These calls return immediately and copy
/// only the frames that are needed. A low-priority thread selects the frames for the lens, computes
/// the calibration, and writes the file.
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
/// Returns the identifier of a step, such as "spin".
const char* name(GuideStep step);
/// Returns the step whose identifier is `name`, or nullopt if there is no such step.
std::optional<GuideStep> guide_step(const std::string& name);

/// Phase of the current step.
enum class GuidePhase {
    idle,        ///< no step has been started
    collecting,  ///< frames are being collected
    solving,     ///< the calibration is being computed
    solved,      ///< the result is ready to be saved
    failed,      ///< the step failed, for the reason in `GuideState::problem`
    saved        ///< the result has been saved in the camera file
};
const char* name(GuidePhase phase);

struct GuideOptions {
    std::string file;  ///< camera file, the only file that the guide writes
    CalibrateOptions calibrate;
    SpacingSource spacing = SpacingSource::assumed;
    /// Camera of the run. Each step changes only the values that it calibrates.
    std::optional<Camera> camera;
    bool needs_focal_length = false;  ///< true if the run computes poses in space (--pose space)
    bool flip = false;  ///< true if the source flips the frames (saved in the camera file)
};

struct GuideResult {
    Camera camera;
    std::string report;                           ///< report as printed by `dotpose calibrate`
    bool is_good = true;                          ///< false if the verdict is a warning
    std::optional<ResidualField> residuals = {};  ///< set only by the `lens` step
    std::vector<SpinStation> stations = {};       ///< set only by the `spin` step
    std::vector<std::string> improvements = {};   ///< ways to improve the result with more frames
};

struct GuideState {
    GuideStep step = GuideStep::lens;
    GuidePhase phase = GuidePhase::idle;
    int frames = 0;  ///< number of collected frames
    std::vector<video::Gauge> gauges;
    std::string advice;                     ///< what the user should do now
    std::optional<CalibrationStatus> lens;  ///< progress of the `lens` step
    /// True for each direction for which enough frames have been collected. A direction is a
    /// heading of the turning robot, or a direction in which the pen must be tilted.
    std::vector<bool> directions;
    std::vector<PenLean> leans;      ///< tilts of the pen
    std::vector<std::string> needs;  ///< unmet requirements, unused in the `lens` step
    std::string problem;             ///< reason why the step failed or the file was not written
    std::optional<GuideResult> result;
    std::optional<Camera> camera;  ///< newest saved camera, initially GuideOptions::camera
};

class CalibrationGuide {
  public:
    explicit CalibrationGuide(GuideOptions options);
    /// Cancels the current step.
    ~CalibrationGuide();
    CalibrationGuide(const CalibrationGuide&) = delete;
    CalibrationGuide& operator=(const CalibrationGuide&) = delete;

    /// Starts `step`. Cancels the current step if there is one.
    void start(GuideStep step);
    /// Computes the result of the step from the frames collected so far. The step fails if these
    /// frames are not sufficient.
    void finish();
    void cancel();
    /// Saves the result of the current step in the camera file. Does nothing if there is no result.
    void save();

    /// Sets the sheets for calibrations that are started after this call.
    void set_sheets(std::vector<SheetEntry> sheets);

    /// Collects a frame if the current step needs it. `image` is the image that was located.
    /// `bits_per_px` is the bit rate of the source (capture/frame_source.hpp).
    void take(const capture::Frame& frame, const Reading& reading, ImageView image,
              double bits_per_px);

    /// Returns the camera that was saved since the previous call, or nullopt if no camera was
    /// saved.
    std::optional<Camera> take_camera();

    const std::string& file() const { return options_.file; }
    GuideState state() const;
    /// Returns a number that increases with every change to the state.
    std::uint64_t version() const;

  private:
    using Clock = std::chrono::steady_clock;

    // The following functions run in the calibration thread.
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
    std::unique_ptr<LensCollector> collector_;  ///< used only by the calibration thread
    std::atomic<bool> cancels_ = false;         ///< true to abort the running calculation

    mutable std::mutex mutex_;  ///< protects the following members
    std::condition_variable changed_;
    std::deque<std::function<void()>> jobs_;
    bool is_busy_ = false;  ///< true if a job is running
    bool stops_ = false;
    GuideState state_;
    std::uint64_t version_ = 0;
    std::unique_ptr<GuidedFrames> guided_;  ///< null during the `lens` step
    int lost_ = 0;                          ///< number of consecutive frames without a fix
    std::optional<Camera> saved_camera_;
    Clock::time_point next_offer_{};

    std::thread thread_;  // declared last, because the thread uses the other members
};

}  // namespace dotpose::cli
