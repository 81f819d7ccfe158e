#include "video/screen.hpp"

#include <cstdlib>

#include <opencv2/highgui.hpp>
#include <opencv2/videoio.hpp>

#include "video/overlay.hpp"

namespace dotpose::video {
namespace {

constexpr const char* kWindow = "dotpose";

int codec_of(const std::string& path) {
    return path.ends_with(".avi") ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
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
            return !options_.has_window || display(picture);
        } catch (const cv::Exception& problem) {
            throw Error("cannot show the frame: " + problem.err);
        }
    }

  private:
    void record(const cv::Mat& picture) {
        if (!writer_.isOpened()) {
            size_ = picture.size();
            if (!writer_.open(options_.record, codec_of(options_.record), options_.fps, size_)) {
                throw Error("cannot record to " + options_.record + "; try a name with .mp4");
            }
        }
        if (picture.size() != size_) {
            throw Error("cannot record frames of different sizes to " + options_.record);
        }
        writer_.write(picture);
    }

    bool display(const cv::Mat& picture) {
        constexpr int kEscape = 27;
        cv::imshow(kWindow, picture);
        const int key = cv::waitKey(1);
        return key != 'q' && key != kEscape &&
               cv::getWindowProperty(kWindow, cv::WND_PROP_VISIBLE) >= 1;
    }

    ScreenOptions options_;
    cv::VideoWriter writer_;
    cv::Size size_;
};

Screen::Screen(const ScreenOptions& options) : output_(std::make_unique<Output>(options)) {}
Screen::~Screen() = default;

bool Screen::is_on() const {
    return output_->is_on();
}

bool Screen::show(const Scene& scene) {
    return output_->show(scene);
}

bool has_display() {
    const auto is_set = [](const char* variable) {
        const char* value = std::getenv(variable);
        return value != nullptr && *value != '\0';
    };
    return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

}  // namespace dotpose::video
