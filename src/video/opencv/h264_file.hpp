// Writes pictures to a video file as H.264, using the FFmpeg libraries.
#pragma once

#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "dotpose/files/error.hpp"

namespace dotpose::video {

class H264File {
  public:
    /// Returns true if the installed FFmpeg can encode H.264.
    static bool is_available();

    /// Creates the file in the container format that its extension specifies. Width and height must
    /// be even. Throws Error if the file cannot be created.
    H264File(const std::string& path, double fps, cv::Size size);
    /// Completes the file unless `finish` was called. Errors are ignored.
    ~H264File();
    H264File(const H264File&) = delete;
    H264File& operator=(const H264File&) = delete;

    /// Appends a BGR picture. Throws Error, for example if the disk is full.
    void write(const cv::Mat& picture);

    /// Completes the file. No pictures may be appended afterwards. Throws Error on failure.
    void finish();

  private:
    class Encoder;
    std::unique_ptr<Encoder> encoder_;
};

}  // namespace dotpose::video
