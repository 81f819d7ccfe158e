// Reads local cameras (V4L2) and network cameras with OpenCV.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include <fmt/core.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "capture/source_kind.hpp"
#include "video/camera_list.hpp"
#include "video/opencv/latest.hpp"
#include "video/opencv/offers.hpp"

namespace dotpose::video {
namespace {

using capture::Frame;
using capture::SourceOptions;
using std::chrono::steady_clock;
using namespace std::chrono_literals;

void to_grey(const cv::Mat& picture, GreyImage& image) {
    cv::Mat grey;
    if (picture.channels() == 1) {
        grey = picture;
    } else {
        cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    }
    image.width_px = grey.cols;
    image.height_px = grey.rows;
    image.pixels.clear();
    for (int v = 0; v < grey.rows; ++v)
        image.pixels.insert(image.pixels.end(), grey.ptr(v), grey.ptr(v) + grey.cols);
}

/// Runs `action`. Converts an exception thrown by a driver or a decoder to an Error that names the
/// source.
template <typename Action>
auto guarded(const std::string& name, const Action& action) {
    try {
        return action();
    } catch (const cv::Exception& problem) {
        throw Error("cannot read " + name + ": " + problem.err);
    }
}

/// Reads a camera in a separate thread, so that `next` always returns the newest frame.
class Camera : public capture::FrameSource {
  public:
    Camera(const std::string& name, const SourceOptions& options)
        : name_(name), options_(options), is_remote_(capture::is_url(name)) {
        if (!open()) {
            throw Error(fmt::format("cannot open the camera {}: {}", name, why_not_open()));
        }
        rate_ = capture_.get(cv::CAP_PROP_FPS);
        thread_ = std::thread([this] { run(); });
    }
    ~Camera() override {
        ends_ = true;
        thread_.join();
    }

    bool next(Frame& frame) override {
        while (!options_.stop()) {
            if (auto newest = latest_.take(100ms)) {
                frame = std::move(*newest);
                return true;
            }
        }
        return false;
    }
    std::int64_t dropped() const override { return latest_.dropped(); }
    double rate() const override { return rate_; }

  private:
    /// Returns the device path of a local camera. `name_` is a path or a device number.
    std::string device() const {
        const bool is_number = name_.find_first_not_of("0123456789") == std::string::npos;
        return is_number ? "/dev/video" + name_ : name_;
    }

    std::string why_not_open() const {
        if (is_remote_) return "there is no answer, or the answer is not a video";
        const std::vector<FoundCamera> cameras = find_cameras();
        const bool exists =
            std::ranges::find(cameras, device(), &FoundCamera::device) != cameras.end();
        return fmt::format(
            "{}; {}",
            exists ? "another program uses it, or it delivers no pictures" : "there is none",
            in_one_line(cameras));
    }

    bool open() {
        return guarded(name_, [this] {
            if (is_remote_) {
                return capture_.open(name_, cv::CAP_FFMPEG,
                                     {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, kPatience_ms,
                                      cv::CAP_PROP_READ_TIMEOUT_MSEC, kPatience_ms});
            }
            const bool is_open = capture_.open(device(), cv::CAP_V4L2);
            if (is_open) set_up();
            return is_open;
        });
    }

    void set_up() {
        constexpr double kManualExposure = 1;  // V4L2_EXPOSURE_MANUAL
        if (options_.width_px > 0) {
            capture_.set(cv::CAP_PROP_FRAME_WIDTH, options_.width_px);
            capture_.set(cv::CAP_PROP_FRAME_HEIGHT, options_.height_px);
        }
        if (options_.fps) capture_.set(cv::CAP_PROP_FPS, *options_.fps);
        if (options_.exposure) {
            capture_.set(cv::CAP_PROP_AUTO_EXPOSURE, kManualExposure);
            capture_.set(cv::CAP_PROP_EXPOSURE, *options_.exposure);
        }
        if (options_.gain) capture_.set(cv::CAP_PROP_GAIN, *options_.gain);
    }

    /// Returns the timestamp of the frame on the monotonic clock: the timestamp from the driver if
    /// available, otherwise the time at which the frame was read. Timestamps of network streams are
    /// not used, because their clock is unknown.
    std::int64_t time_us() const {
        const double driver_ms = is_remote_ ? 0 : capture_.get(cv::CAP_PROP_POS_MSEC);
        if (driver_ms > 0) return std::llround(driver_ms * 1e3);
        using namespace std::chrono;
        return duration_cast<microseconds>(read_at_.time_since_epoch()).count();
    }

    void run() {
        cv::Mat picture;
        while (!ends_) {
            bool is_read = false;
            try {
                is_read = capture_.read(picture);
            } catch (const cv::Exception&) {
                is_read = false;
            }
            if (!is_read) {
                reopen();
                continue;
            }
            if (is_disconnected_) options_.notify("the camera " + name_ + " is back");
            is_disconnected_ = false;
            read_at_ = steady_clock::now();
            newest_us_ = time_us();
            Frame frame;
            to_grey(picture, frame.image);
            put(std::move(frame), newest_us_);
        }
    }

    void put(Frame frame, std::int64_t time_us) {
        frame.time_us = time_us;
        frame.is_live = true;
        frame.index = frames_++;
        latest_.put(std::move(frame));
    }

    /// Delivers an empty frame. Its timestamp is the current time on the camera's clock.
    void put_empty() {
        using namespace std::chrono;
        put({}, newest_us_ + duration_cast<microseconds>(steady_clock::now() - read_at_).count());
    }

    /// Waits half a second and tries to open the camera again.
    void reopen() {
        if (!is_disconnected_) {
            options_.notify("the camera " + name_ + " does not answer; waiting for it");
        }
        is_disconnected_ = true;
        capture_.release();
        std::this_thread::sleep_for(500ms);
        if (frames_ > 0) put_empty();
        try {
            open();
        } catch (const Error&) {  // the next read fails, so `reopen` is called again
        }
    }

    static constexpr int kPatience_ms = 2000;  ///< timeout for network cameras

    std::string name_;
    SourceOptions options_;
    bool is_remote_;
    cv::VideoCapture capture_;
    double rate_ = 0;
    Latest<Frame> latest_;
    std::atomic<bool> ends_ = false;
    bool is_disconnected_ = false;
    std::int64_t frames_ = 0;
    std::int64_t newest_us_ = 0;  ///< time of the newest frame
    steady_clock::time_point read_at_ = steady_clock::now();
    std::thread thread_;
};

}  // namespace

std::unique_ptr<capture::FrameSource> open_camera(const std::string& name,
                                                  const SourceOptions& options) {
    // Failures are reported as Error, so OpenCV need not print messages.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // AV_LOG_QUIET
    return std::make_unique<Camera>(name, options);
}

}  // namespace dotpose::video
