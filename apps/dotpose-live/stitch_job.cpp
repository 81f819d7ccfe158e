#include "stitch_job.hpp"

#include <cmath>
#include <utility>

#include "dotpose/files/error.hpp"
#include "image_copy.hpp"
#include "serve/background_thread.hpp"

namespace dotpose::cli {
namespace {

/// Maximum memory for frames, in bytes.
constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

/// Returns true if the frame may show dots of two sheets, either because it extends beyond the edge
/// of its sheet or because the sheet is unknown.
bool is_near_edge(const Record& record, ImageView image) {
    if (!record.place) return true;
    const Sheet& sheet = record.place->entry->sheet;
    const double reach_cells =
        std::hypot(image.width_px, image.height_px) / 2 / record.fix.spacing_px();
    const auto is_inside = [reach_cells](std::uint32_t cell, std::uint32_t origin, int count) {
        const double from_origin = static_cast<double>(cell) - static_cast<double>(origin);
        return from_origin > reach_cells && from_origin + reach_cells < count;
    };
    return !is_inside(record.fix.cell.x, sheet.origin.x, sheet.columns) ||
           !is_inside(record.fix.cell.y, sheet.origin.y, sheet.rows);
}

}  // namespace

StitchJob::StitchJob(std::vector<SheetEntry> sheets, std::optional<Camera> camera,
                     std::function<void(const Progress&)> changed)
    : sheets_(std::move(sheets)), camera_(std::move(camera)), changed_(std::move(changed)) {
    options_.progress = [this](int, int) { return !ends_; };
    thread_ = std::thread([this] { run(); });
}

StitchJob::~StitchJob() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

void StitchJob::offer(const Reading& reading, ImageView image) {
    {
        const std::lock_guard lock(mutex_);
        if (!is_idle_) return;
    }
    if (reading.record.fix.status == Status::ok) {
        if (!is_near_edge(reading.record, image) || !places_.take(reading.record.fix, image))
            return;
    } else {
        // Also examines frames without a fix, but at most one every 500 ms. Such a frame may show a
        // seam, where the presence of two patterns can prevent a fix.
        constexpr std::chrono::milliseconds kPause(500);
        const Clock::time_point now = Clock::now();
        if (now < unlocated_at_ + kPause) return;
        unlocated_at_ = now;
    }
    {
        const std::lock_guard lock(mutex_);
        waiting_ = copy_of(image);
        is_idle_ = false;
    }
    wake_.notify_one();
}

std::optional<Stitching> StitchJob::result() const {
    const std::lock_guard lock(mutex_);
    return result_;
}

void StitchJob::run() {
    serve::run_in_background();
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return ends_ || waiting_; });
        if (ends_) return;
        GreyImage frame = *std::exchange(waiting_, std::nullopt);
        lock.unlock();
        ++tried_;
        const bool is_used = shows_seam(frame);
        if (is_used) {
            bytes_ += frame.pixels.size();
            frames_.push_back(std::move(frame));
        }
        Progress progress = measure();
        changed_(progress);
        lock.lock();
        result_ = std::move(progress.result);
        is_idle_ = !progress.is_complete;
    }
}

/// Returns true if two sheets are visible in the frame.
bool StitchJob::shows_seam(const GreyImage& frame) const {
    std::vector<SheetEntry> sheets = sheets_;
    // Removes the world poses of the sheets. Otherwise, `stitch_sheets` would throw Error if sheets
    // in the file have world poses but the sheets in this frame do not. The world poses are
    // irrelevant for this test.
    for (SheetEntry& entry : sheets)
        entry.world.reset();
    try {
        return stitch_sheets(
                   1, [&frame](int) { return frame; }, sheets, camera_, options_)
                   .used > 0;
    } catch (const Error&) {
        return false;
    }
}

StitchJob::Progress StitchJob::measure() const {
    Progress progress;
    progress.tried = tried_;
    progress.used = frames_.size();
    progress.is_complete = frames_.size() >= kMaxFrames || bytes_ >= kMaxBytes;
    if (frames_.empty()) return progress;
    try {
        progress.result = stitch_sheets(
            static_cast<int>(frames_.size()),
            [this](int i) { return frames_[static_cast<std::size_t>(i)]; }, sheets_, camera_,
            options_);
    } catch (const Error& error) {
        progress.problem = error.what();
    }
    return progress;
}

}  // namespace dotpose::cli
