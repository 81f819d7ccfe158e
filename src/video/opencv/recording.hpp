// Writes pictures to a video file as H.264 or MPEG-4, or as Motion JPEG if the name ends in .avi.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "dotpose/image.hpp"
#include "video/module.hpp"
#include "video/opencv/h264_file.hpp"

namespace dotpose::video {

class Recording : public GreyVideo {
  public:
    /// The file is created when the first picture is written. `notify` receives messages for the
    /// user.
    Recording(std::string path, double fps, Notify notify);

    /// Appends a BGR or grey picture. Throws Error on failure, for example if the disk is full or
    /// the size differs from that of the previous pictures.
    void write(const cv::Mat& picture);
    void write(ImageView image) override;

    /// Closes the file, and counts the frames in it, because OpenCV reports neither a full disk nor
    /// an incomplete file. Throws Error if frames are missing.
    void finish() override;

  private:
    bool is_disk_full() const;
    void open(cv::Size size);

    std::string path_;
    double fps_;
    Notify notify_;
    std::unique_ptr<H264File> h264_;
    cv::VideoWriter writer_;  ///< open if the video is not encoded as H.264
    cv::Size size_;
    std::int64_t frames_ = 0;
};

}  // namespace dotpose::video
