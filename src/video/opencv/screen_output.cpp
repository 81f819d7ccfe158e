#include <optional>

#include <opencv2/highgui.hpp>

#include "video/opencv/offers.hpp"
#include "video/opencv/overlay.hpp"
#include "video/opencv/recording.hpp"

namespace dotpose::video {
namespace {

constexpr const char* kWindow = "dotpose";

class Output : public ScreenOutput {
  public:
    explicit Output(const ScreenOptions& options) : options_(options) {
        if (!options.record.empty())
            recording_.emplace(options.record, options.fps, options.notify);
    }

    bool show(const Scene& scene) override {
        try {
            const cv::Mat picture = overlay(scene);
            if (recording_) recording_->write(picture);
            if (options_.has_window) display(picture);
            return is_wanted();
        } catch (const cv::Exception& problem) {
            throw Error("cannot show the frame: " + problem.err);
        }
    }

    bool is_wanted() override {
        if (!is_shown_) return true;
        constexpr int kEscape = 27;
        const int key = cv::waitKey(1);
        return key != 'q' && key != kEscape &&
               cv::getWindowProperty(kWindow, cv::WND_PROP_VISIBLE) >= 1;
    }

    void finish() override {
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

}  // namespace

std::unique_ptr<ScreenOutput> open_screen(const ScreenOptions& options) {
    return std::make_unique<Output>(options);
}

}  // namespace dotpose::video
