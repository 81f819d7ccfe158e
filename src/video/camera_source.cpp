// Cameras, through OpenCV.
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "video/latest.hpp"
#include "video/sources.hpp"

namespace dotpose::video {
namespace {

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

/// Whatever a driver or decoder throws becomes an Error with the source's name.
template <typename Action>
auto guarded(const std::string& name, const Action& action) {
    try {
        return action();
    } catch (const cv::Exception& problem) {
        throw Error("cannot read " + name + ": " + problem.err);
    }
}

/// A camera is read by a thread of its own, so that the newest frame is always the one given.
class Camera : public FrameSource {
  public:
    explicit Camera(const SourceOptions& options) : options_(options) {
        if (!open()) {
            throw Error(
                fmt::format("cannot open the camera {}: there is none, or another program uses it",
                            options.name));
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
    bool open() {
        return guarded(options_.name, [this] {
            const bool is_number =
                options_.name.find_first_not_of("0123456789") == std::string::npos;
            const bool is_open = is_number ? capture_.open(std::stoi(options_.name), cv::CAP_V4L2)
                                           : capture_.open(options_.name, cv::CAP_V4L2);
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

    /// When the driver took the frame, on the monotonic clock, where it tells.
    std::int64_t time_us() const {
        const double driver_ms = capture_.get(cv::CAP_PROP_POS_MSEC);
        if (driver_ms > 0) return std::llround(driver_ms * 1e3);
        using namespace std::chrono;
        return duration_cast<microseconds>(steady_clock::now().time_since_epoch()).count();
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
                wait_for_return();
                continue;
            }
            Frame frame;
            frame.time_us = time_us();
            frame.index = frames_++;
            to_grey(picture, frame.image);
            latest_.put(std::move(frame));
        }
    }

    void wait_for_return() {
        options_.tell("the camera " + options_.name + " does not answer; waiting for it");
        capture_.release();
        for (bool is_open = false; !is_open && !ends_;) {
            std::this_thread::sleep_for(500ms);
            try {
                is_open = open();
            } catch (const Error&) {
                is_open = false;
            }
            if (is_open) options_.tell("the camera " + options_.name + " is back");
        }
    }

    SourceOptions options_;
    cv::VideoCapture capture_;
    double rate_ = 0;
    Latest<Frame> latest_;
    std::atomic<bool> ends_ = false;
    std::int64_t frames_ = 0;
    std::thread thread_;
};

}  // namespace

std::unique_ptr<FrameSource> open_camera(const SourceOptions& options) {
    // What fails is told in our own words.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    return std::make_unique<Camera>(options);
}

}  // namespace dotpose::video
