#include "calibration_guide.hpp"

#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "dotpose/files/camera_file.hpp"
#include "image_copy.hpp"
#include "kept_camera.hpp"
#include "serve/background_thread.hpp"
#include "system/path.hpp"

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;

/// Minimum time between two frames that are copied for the calibration thread.
constexpr std::chrono::milliseconds kOfferPeriod = 50ms;
/// Maximum number of queued jobs. While the queue is full, commands from the web page are ignored.
constexpr std::size_t kMaxJobs = 8;
/// Number of consecutive frames without a fix after which the web page advises the user to keep the
/// camera over the dots.
constexpr int kManyLost = 10;

constexpr std::array<const char*, 5> kSteps = {"lens", "spin", "drive", "readout", "pivot"};
constexpr std::array<const char*, 6> kPhases = {"idle",   "collecting", "solving",
                                                "solved", "failed",     "saved"};

/// Returns the reason why a step cannot start with this camera, or an empty string if the step can
/// start.
std::string problem_before(GuideStep step, const std::optional<Camera>& camera) {
    if (step == GuideStep::readout && !(camera && camera->paper)) {
        return "the camera file has no view of the paper: first calibrate the lens of the mounted "
               "camera";
    }
    if (step == GuideStep::pivot && !(camera && camera->focal_px)) {
        return "the camera file has no focal length: first calibrate the lens, and tilt the pen by "
               "20 to 40 degrees to all sides while the frames are taken";
    }
    return {};
}

std::unique_ptr<GuidedFrames> frames_for(GuideStep step, const std::optional<Camera>& camera) {
    switch (step) {
        case GuideStep::spin:
            return std::make_unique<SpinFrames>();
        case GuideStep::drive:
            return std::make_unique<DriveFrames>();
        case GuideStep::readout:
            return std::make_unique<ReadoutFrames>();
        case GuideStep::pivot:
            return std::make_unique<PivotFrames>(camera.value().focal_px.value());
        default:
            return nullptr;
    }
}

void show(const GuidedFrames& frames, GuideState& state) {
    state.frames = static_cast<int>(frames.images().size());
    state.gauges = frames.gauges();
    state.advice = frames.advice();
    state.needs = frames.needs();
    if (const auto* spin = dynamic_cast<const SpinFrames*>(&frames))
        state.directions.assign(spin->directions().begin(), spin->directions().end());
    if (const auto* pivot = dynamic_cast<const PivotFrames*>(&frames)) {
        const auto directions = pivot->directions();
        state.directions.assign(directions.begin(), directions.end());
        state.leans = pivot->leans();
    }
}

}  // namespace

const char* name(GuideStep step) {
    return kSteps[static_cast<std::size_t>(step)];
}

std::optional<GuideStep> guide_step(const std::string& name) {
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
        if (name == kSteps[i]) return static_cast<GuideStep>(i);
    }
    return std::nullopt;
}

const char* name(GuidePhase phase) {
    return kPhases[static_cast<std::size_t>(phase)];
}

CalibrationGuide::CalibrationGuide(GuideOptions options)
    : options_(std::move(options)), thread_([this] { run(); }) {
    options_.calibrate.progress = [this](int, int) { return !cancels_; };
    const std::lock_guard lock(mutex_);
    state_.camera = options_.camera;
}

CalibrationGuide::~CalibrationGuide() {
    cancels_ = true;
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

void CalibrationGuide::run() {
    serve::run_in_background();
    std::unique_lock lock(mutex_);
    while (true) {
        is_busy_ = false;
        changed_.wait(lock, [this] { return stops_ || !jobs_.empty(); });
        if (stops_) return;
        const std::function<void()> job = std::move(jobs_.front());
        jobs_.pop_front();
        is_busy_ = true;
        lock.unlock();
        job();
        lock.lock();
    }
}

void CalibrationGuide::post(bool cancels, std::function<void()> job) {
    {
        const std::lock_guard lock(mutex_);
        if (jobs_.size() >= kMaxJobs) return;
        jobs_.push_back(std::move(job));
        if (cancels) cancels_ = true;
    }
    changed_.notify_one();
}

void CalibrationGuide::update(const std::function<void(GuideState&)>& change) {
    const std::lock_guard lock(mutex_);
    change(state_);
    ++version_;
}

void CalibrationGuide::start(GuideStep step) {
    post(true, [this, step] { begin(step); });
}

void CalibrationGuide::cancel() {
    post(true, [this] { reset(); });
}

void CalibrationGuide::finish() {
    post(false, [this] {
        if (state().phase == GuidePhase::collecting) solve();
    });
}

void CalibrationGuide::save() {
    post(false, [this] { write(); });
}

void CalibrationGuide::begin(GuideStep step) {
    cancels_ = false;
    reset();
    const std::optional<Camera> camera = state().camera;
    if (const std::string problem = problem_before(step, camera); !problem.empty()) {
        update([step](GuideState& state) { state.step = step; });
        fail(problem);
        return;
    }
    if (step == GuideStep::lens) collector_ = std::make_unique<LensCollector>(options_.calibrate);
    update([&](GuideState& state) {
        guided_ = frames_for(step, camera);
        lost_ = 0;
        state.step = step;
        state.phase = GuidePhase::collecting;
        state.advice = "move the camera over the sheet, and rest for a moment at each place";
        if (guided_) show(*guided_, state);
    });
}

/// Ends the step and discards its frames and result.
void CalibrationGuide::reset() {
    collector_.reset();
    update([this](GuideState& state) {
        guided_.reset();
        GuideState empty;
        empty.camera = std::move(state.camera);
        state = std::move(empty);
    });
}

void CalibrationGuide::fail(const std::string& problem) {
    update([&problem](GuideState& state) {
        state.phase = GuidePhase::failed;
        state.problem = problem;
    });
}

void CalibrationGuide::set_sheets(std::vector<SheetEntry> sheets) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.emplace_back(
            [this, sheets = std::move(sheets)] { options_.calibrate.sheets = sheets; });
    }
    changed_.notify_one();
}

void CalibrationGuide::take(const capture::Frame& frame, const Reading& reading, ImageView image,
                            double bits_per_px) {
    const std::lock_guard lock(mutex_);
    if (state_.phase != GuidePhase::collecting) return;
    if (!guided_) {
        offer(frame, image, bits_per_px);
        return;
    }
    if (guided_->is_complete()) return;
    const Record& record = reading.record;
    if (record.fix.status == Status::ok) {
        const double spacing_mm = std::isfinite(record.spacing_mm)
                                      ? record.spacing_mm
                                      : options_.calibrate.pattern.spacing_mm;
        lost_ = 0;
        guided_->take({record.fix, spacing_mm, frame.time_us, frame.index, image});
    } else {
        ++lost_;
        guided_->lose();
    }
    show_guided();
}

/// Updates the progress of a step other than `lens`. When enough frames have been collected, queues
/// the computation of the result. The caller must hold `mutex_`.
void CalibrationGuide::show_guided() {
    show(*guided_, state_);
    if (lost_ >= kManyLost)
        state_.advice = "these frames cannot be located: keep the camera over the dots";
    ++version_;
    if (!guided_->is_complete()) return;
    jobs_.emplace_back([this] {
        if (state().phase == GuidePhase::collecting) solve();
    });
    changed_.notify_one();
}

/// Queues a copy of a frame for the calibration thread if the thread is idle and at least
/// `kOfferPeriod` has passed since the last frame was queued. The caller must hold `mutex_`.
void CalibrationGuide::offer(const capture::Frame& frame, ImageView image, double bits_per_px) {
    const Clock::time_point now = Clock::now();
    if (is_busy_ || !jobs_.empty() || now < next_offer_) return;
    next_offer_ = now + kOfferPeriod;
    jobs_.emplace_back(
        [this, bits_per_px,
         copy = capture::Frame{copy_of(image), frame.time_us, frame.index, frame.file,
                               frame.is_live}] { look(copy, bits_per_px); });
    changed_.notify_one();
}

void CalibrationGuide::look(capture::Frame frame, double bits_per_px) {
    if (!collector_) return;
    try {
        collector_->set_bits_per_px(bits_per_px);
        const LensCollector::Outcome outcome = collector_->take(frame);
        collector_->start_if_useful();
        collector_->wait(0ms);
        CalibrationStatus status = collector_->status(outcome);
        update([&](GuideState& state) {
            state.frames = status.coverage.frames();
            state.gauges = gauges_of(status);
            state.advice = status.now;
            state.lens = std::move(status);
        });
    } catch (const Error& error) {
        fail(error.what());
        return;
    }
    if (collector_->is_enough() || collector_->is_full()) solve();
}

void CalibrationGuide::solve() {
    GuideStep step = GuideStep::lens;
    update([&step](GuideState& state) {
        step = state.step;
        state.phase = GuidePhase::solving;
        state.advice.clear();
    });
    try {
        GuideResult result = result_of(step);
        update([&result](GuideState& state) {
            state.phase = GuidePhase::solved;
            state.result = std::move(result);
        });
    } catch (const Error& error) {
        // The command that cancelled this step runs next and resets the state.
        if (cancels_) return;
        fail(error.what());
    }
    collector_.reset();
    const std::lock_guard lock(mutex_);
    guided_.reset();
}

GuideResult CalibrationGuide::lens_result() {
    if (!collector_->finish([this] { return !cancels_; })) throw Error("cancelled");
    LensCalibration lens = collector_->result();
    if (options_.needs_focal_length && !lens.camera.focal_px) {
        throw Error(
            "these frames do not determine the focal length, which --pose space needs: also tilt "
            "the camera");
    }
    if (const auto camera = state().camera) keep_mount(*camera, lens.camera);
    GuideResult result{lens.camera,
                       lens_report(lens, options_.spacing) + corner_report(lens.camera)};
    result.residuals = residual_field(lens);
    for (const CalibrationNeed& need : collector_->needs())
        result.improvements.push_back(need.advice);
    return result;
}

/// Computes the result of a step. Throws Error if the collected frames are not sufficient.
GuideResult CalibrationGuide::result_of(GuideStep step) {
    if (step == GuideStep::lens) return lens_result();
    // `guided_` can be read without locking the mutex, because the main thread adds no frames while
    // the phase is `solving`.
    const std::optional<Camera> camera = state().camera;
    const GuidedFrames::Images& images = guided_->images();
    const int count = static_cast<int>(images.size());
    const auto frame_at = [&images](int i) { return *images[static_cast<std::size_t>(i)]; };
    switch (step) {
        case GuideStep::spin: {
            SpinCalibration spin = calibrate_spin(count, frame_at, camera, options_.calibrate);
            GuideResult result{spin.camera, spin_report(spin), spin.verdict == MountVerdict::good};
            result.stations = std::move(spin.stations);
            return result;
        }
        case GuideStep::drive: {
            const DriveCalibration drive =
                calibrate_drive(count, frame_at, camera, options_.calibrate);
            return {drive.camera, drive_report(drive)};
        }
        case GuideStep::pivot: {
            const PivotCalibration pivot =
                calibrate_pivot(count, frame_at, camera.value(), options_.calibrate);
            return {pivot.camera, pivot_report(pivot)};
        }
        default: {
            if (count < 2) throw Error("too few frames: drive fast over the sheet");
            const double interval_ms = static_cast<ReadoutFrames&>(*guided_).interval_ms();
            const ReadoutCalibration readout = calibrate_readout(
                count, frame_at, camera.value_or(Camera{}), interval_ms, options_.calibrate);
            return {readout.camera, readout_report(readout)};
        }
    }
}

void CalibrationGuide::write() {
    const GuideState now = state();
    if (now.phase != GuidePhase::solved) return;
    Camera camera = now.result->camera;
    camera.flip = options_.flip;
    try {
        write_camera(system::path_of(options_.file), camera);
    } catch (const Error& error) {
        update([&error](GuideState& state) { state.problem = error.what(); });
        return;
    }
    // The saved camera file contains the flip setting, because later runs need it. The camera of
    // this run must not contain the setting, because the source already flips the frames.
    camera.flip = false;
    update([&](GuideState& state) {
        state.phase = GuidePhase::saved;
        state.problem.clear();
        state.camera = camera;
        saved_camera_ = camera;
    });
}

std::optional<Camera> CalibrationGuide::take_camera() {
    const std::lock_guard lock(mutex_);
    return std::exchange(saved_camera_, std::nullopt);
}

GuideState CalibrationGuide::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

std::uint64_t CalibrationGuide::version() const {
    const std::lock_guard lock(mutex_);
    return version_;
}

}  // namespace dotpose::cli
