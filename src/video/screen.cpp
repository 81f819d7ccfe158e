#include "video/screen.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include <dlfcn.h>
#include <fmt/core.h>
#include <opencv2/highgui.hpp>
#include <opencv2/videoio.hpp>

#include "video/h264_file.hpp"
#include "video/overlay.hpp"

namespace dotpose::video {
namespace {

constexpr const char* kWindow = "dotpose";

bool is_avi(const std::string& path) {
    return path.ends_with(".avi");
}

/// Returns the codec of what OpenCV writes.
int codec_of(const std::string& path) {
    return is_avi(path) ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
                        : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
}

}  // namespace

class Screen::Output {
  public:
    explicit Output(const ScreenOptions& options) : options_(options) {}

    bool is_on() const { return options_.has_window || !options_.record.empty(); }

    bool show(const Scene& scene) {
        try {
            const cv::Mat picture = overlay(scene);
            if (!options_.record.empty()) record(picture);
            if (options_.has_window) display(picture);
            return is_wanted();
        } catch (const cv::Exception& problem) {
            throw Error("cannot show the frame: " + problem.err);
        }
    }

    bool is_wanted() const {
        if (!is_shown_) return true;
        constexpr int kEscape = 27;
        const int key = cv::waitKey(1);
        return key != 'q' && key != kEscape &&
               cv::getWindowProperty(kWindow, cv::WND_PROP_VISIBLE) >= 1;
    }

    /// Closes the recording and counts its frames: OpenCV reports neither a full disk nor an
    /// incomplete file. Throws Error if frames are missing.
    void finish() {
        if (frames_ == 0) return;
        if (h264_) h264_->finish();
        h264_.reset();
        writer_.release();
        const cv::VideoCapture recorded(options_.record);
        const auto frames = static_cast<std::int64_t>(recorded.get(cv::CAP_PROP_FRAME_COUNT));
        if (recorded.isOpened() && frames >= frames_) return;
        throw Error(fmt::format("{} is not complete: {} of {} frames{}", options_.record,
                                recorded.isOpened() ? std::max<std::int64_t>(frames, 0) : 0,
                                frames_, is_disk_full() ? "; the disk is full" : ""));
    }

  private:
    bool is_disk_full() const {
        constexpr std::uintmax_t kLeast_bytes = 1 << 20;
        std::error_code error;
        const auto folder = std::filesystem::absolute(options_.record, error).parent_path();
        const auto space = std::filesystem::space(folder, error);
        return !error && space.available < kLeast_bytes;
    }

    void record(const cv::Mat& picture) {
        if (frames_ == 0) open_recording(picture.size());
        if (picture.size() != size_) {
            throw Error("cannot record frames of different sizes to " + options_.record);
        }
        constexpr std::int64_t kBetweenLooks = 64;
        if (frames_ % kBetweenLooks == 0 && is_disk_full()) {
            throw Error("cannot record to " + options_.record + ": the disk is full");
        }
        if (h264_) {
            h264_->write(picture);
        } else {
            writer_.write(picture);
        }
        ++frames_;
    }

    void open_recording(cv::Size size) {
        size_ = size;
        if (!is_avi(options_.record) && H264File::is_available()) {
            h264_ = std::make_unique<H264File>(options_.record, options_.fps, size);
            return;
        }
        if (!is_avi(options_.record)) {
            options_.tell("FFmpeg has no encoder for H.264 here: " + options_.record +
                          " will be MPEG-4 video, several times as large");
        }
        if (!writer_.open(options_.record, codec_of(options_.record), options_.fps, size)) {
            throw Error("cannot record to " + options_.record + "; try a name with .mp4");
        }
    }

    void display(const cv::Mat& picture) {
        if (!is_shown_) cv::namedWindow(kWindow, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
        is_shown_ = true;
        cv::imshow(kWindow, picture);
    }

    ScreenOptions options_;
    std::unique_ptr<H264File> h264_;
    cv::VideoWriter writer_;  ///< open if the recording is not H.264
    cv::Size size_;
    std::int64_t frames_ = 0;  ///< number of frames that were written to the recording
    bool is_shown_ = false;
};

Screen::Screen(const ScreenOptions& options) : output_(std::make_unique<Output>(options)) {}
Screen::~Screen() = default;

bool Screen::is_on() const {
    return output_->is_on();
}

bool Screen::show(const Scene& scene) {
    return output_->show(scene);
}

void Screen::finish() {
    output_->finish();
}

bool Screen::is_wanted() {
    return output_->is_wanted();
}

bool has_display() {
    // Qt, which draws the window, ends the program if it cannot reach an X server, so that is tried
    // first. The library is loaded here because Qt brings it along; dotpose does not link it.
    void* library = dlopen("libX11.so.6", RTLD_LAZY);
    if (library == nullptr) return false;
    const auto connect = reinterpret_cast<void* (*)(const char*)>(dlsym(library, "XOpenDisplay"));
    const auto leave = reinterpret_cast<int (*)(void*)>(dlsym(library, "XCloseDisplay"));
    void* display = connect != nullptr && leave != nullptr ? connect(nullptr) : nullptr;
    if (display != nullptr) leave(display);
    return display != nullptr;
}

}  // namespace dotpose::video
