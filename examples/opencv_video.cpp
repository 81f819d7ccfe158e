// Locates frames captured by OpenCV as cv::Mat: dotpose_opencv_video CAMERA_OR_VIDEO
#include <cctype>
#include <cstdio>
#include <exception>
#include <string>

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include <dotpose/locate.hpp>

namespace {

/// Returns a view of a grey cv::Mat. The pixels are not copied, so the cv::Mat must outlive the
/// view.
dotpose::ImageView view_of(const cv::Mat& grey) {
    return {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step)};
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) return std::fputs("usage: opencv_video CAMERA_OR_VIDEO\n", stderr), 2;
    const std::string source = argv[1];
    const bool is_number = source.size() == 1 && std::isdigit(source[0]) != 0;
    cv::VideoCapture capture;
    if (!(is_number ? capture.open(source[0] - '0') : capture.open(source))) {
        std::fprintf(stderr, "cannot open %s\n", argv[1]);
        return 1;
    }
    dotpose::Locator locator;
    cv::Mat frame;
    cv::Mat grey;
    while (capture.read(frame)) {
        cv::cvtColor(frame, grey, cv::COLOR_BGR2GRAY);
        const dotpose::Fix fix = locator.locate(view_of(grey));
        if (fix.status == dotpose::Status::ok) {
            std::printf("x %.3f mm, y %.3f mm, angle %.4f rad\n", fix.x_mm(), fix.y_mm(),
                        fix.theta_rad());
        } else {
            std::puts(dotpose::message(fix.status));
        }
    }
} catch (const std::exception& problem) {
    return std::fprintf(stderr, "%s\n", problem.what()), 1;
}
