#include "video/screen.hpp"

#include <optional>

#include <dlfcn.h>
#include <opencv2/highgui.hpp>

#include "video/overlay.hpp"
#include "video/recording.hpp"

namespace dotpose::video {
namespace {

constexpr const char* kWindow = "dotpose";

}  // namespace

class Screen::Output {
  public:
    explicit Output(const ScreenOptions& options) : options_(options) {
        if (!options.record.empty()) recording_.emplace(options.record, options.fps, options.tell);
    }

    bool is_on() const { return options_.has_window || recording_; }

    bool show(const Scene& scene) {
        try {
            const cv::Mat picture = overlay(scene);
            if (recording_) recording_->write(picture);
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

    void finish() {
        if (recording_) recording_->finish();
    }

  private:
    void display(const cv::Mat& picture) {
        if (!is_shown_) cv::namedWindow(kWindow, cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
        is_shown_ = true;
        cv::imshow(kWindow, picture);
    }

    ScreenOptions options_;
    std::optional<Recording> recording_;
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
