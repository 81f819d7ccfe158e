#include "video/opencv/recording.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/core.h>
#include <opencv2/imgproc.hpp>

#include "video/opencv/offers.hpp"

namespace dotpose::video {
namespace {

bool is_avi(const std::string& path) {
    return path.ends_with(".avi");
}

int codec_of(const std::string& path) {
    return is_avi(path) ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
                        : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
}

}  // namespace

Recording::Recording(std::string path, double fps, Notify notify)
    : path_(std::move(path)), fps_(fps), notify_(std::move(notify)) {}

bool Recording::is_disk_full() const {
    constexpr std::uintmax_t kMin_bytes = 1 << 20;
    std::error_code error;
    const auto folder = std::filesystem::absolute(path_, error).parent_path();
    const auto space = std::filesystem::space(folder, error);
    return !error && space.available < kMin_bytes;
}

void Recording::open(cv::Size size) {
    size_ = size;
    if (!is_avi(path_) && H264File::is_available()) {
        h264_ = std::make_unique<H264File>(path_, fps_, size);
        return;
    }
    if (!is_avi(path_)) {
        notify_("FFmpeg has no H.264 encoder here: " + path_ +
                " will be MPEG-4 video, several times as large");
    }
    if (!writer_.open(path_, codec_of(path_), fps_, size)) {
        throw Error("cannot record to " + path_ + "; try a name with .mp4");
    }
}

void Recording::write(const cv::Mat& picture) {
    if (frames_ == 0) open(picture.size());
    if (picture.size() != size_) {
        throw Error("cannot record frames of different sizes to " + path_);
    }
    constexpr std::int64_t kBetweenLooks = 64;
    if (frames_ % kBetweenLooks == 0 && is_disk_full()) {
        throw Error("cannot record to " + path_ + ": the disk is full");
    }
    if (h264_) {
        h264_->write(picture);
    } else {
        writer_.write(picture);
    }
    ++frames_;
}

void Recording::write(ImageView image) {
    if (image.width_px % 2 != 0 || image.height_px % 2 != 0) {
        throw Error(fmt::format("a video of {} x {} px is not possible: take even sizes",
                                image.width_px, image.height_px));
    }
    cv::Mat picture(image.height_px, image.width_px, CV_8UC3);
    for (int v = 0; v < image.height_px; ++v) {
        for (int u = 0; u < image.width_px; ++u)
            picture.at<cv::Vec3b>(v, u) = cv::Vec3b::all(image.row(v)[u]);
    }
    write(picture);
}

void Recording::finish() {
    if (frames_ == 0) return;
    if (h264_) h264_->finish();
    h264_.reset();
    writer_.release();
    const cv::VideoCapture recorded(path_);
    const auto frames = static_cast<std::int64_t>(recorded.get(cv::CAP_PROP_FRAME_COUNT));
    if (recorded.isOpened() && frames >= frames_) return;
    throw Error(fmt::format("{} is not complete: {} of {} frames{}", path_,
                            recorded.isOpened() ? std::max<std::int64_t>(frames, 0) : 0, frames_,
                            is_disk_full() ? "; the disk is full" : ""));
}

std::unique_ptr<GreyVideo> create_video(const std::string& path, double fps, const Notify& notify) {
    return std::make_unique<Recording>(path, fps, notify);
}

}  // namespace dotpose::video
