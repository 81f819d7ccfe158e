#include "video/overlay.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "draw/frame_view.hpp"

namespace dotpose::video {
namespace {

constexpr int kLongerSide = 800;  ///< of the frame on the picture
constexpr int kPanelWidth = 400;
constexpr int kLineHeight = 24;

// Blue, green, red.
const cv::Scalar kGood(73, 132, 30);
const cv::Scalar kBad(43, 57, 192);
const cv::Scalar kDot(0, 143, 255);
const cv::Scalar kGrid(255, 121, 41);
const cv::Scalar kInk(42, 32, 23);
const cv::Scalar kPaper(251, 249, 247);

cv::Point pixel(draw::Point at) {
    return {static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))};
}

int even(double length) {
    return 2 * static_cast<int>(std::ceil(length / 2));
}

/// All cells of the grid that was found, or every other one so that few hundred lines remain.
void draw_grid(const draw::FrameView& view, cv::Mat& picture) {
    const Grid& grid = view.workspace().grid;
    const int step = std::max({1, grid.columns / 64, grid.rows / 64});
    const auto line = [&](int i0, int j0, int i1, int j1) {
        cv::line(picture, pixel(view.at_grid(i0, j0)), pixel(view.at_grid(i1, j1)), kGrid, 1,
                 cv::LINE_AA);
    };
    // From cell to cell, because a lens bends lines.
    for (int i = grid.i0; i < grid.i0 + grid.columns; i += step) {
        for (int j = grid.j0; j < grid.j0 + grid.rows; j += step) {
            if (i + step < grid.i0 + grid.columns) line(i, j, i + step, j);
            if (j + step < grid.j0 + grid.rows) line(i, j, i, j + step);
        }
    }
}

void draw_dots(const draw::FrameView& view, cv::Mat& picture) {
    const int radius = std::max(2, static_cast<int>(view.spacing() * 0.2));
    for (const Dot& dot : view.workspace().found_dots())
        cv::circle(picture, pixel(view.at_dot(dot)), radius, kDot, 1, cv::LINE_AA);
}

void draw_pose(const draw::FrameView& view, cv::Mat& picture) {
    const draw::Point reference = view.at(view.reference_px());
    const draw::Point ahead = view.ahead_of_reference();
    const double length = 0.12 * kLongerSide;
    cv::arrowedLine(picture, pixel(reference), pixel(reference + length * ahead), kGood, 3,
                    cv::LINE_AA);
    cv::circle(picture, pixel(reference), 5, kGood, -1, cv::LINE_AA);
}

void draw_captions(const Scene& scene, cv::Mat panel) {
    int y = kLineHeight;
    for (const std::string& line : scene.lines) {
        cv::putText(panel, line, {12, y}, cv::FONT_HERSHEY_SIMPLEX, 0.5,
                    scene.is_good ? kInk : kBad, 1, cv::LINE_AA);
        y += kLineHeight;
    }
}

/// The path, scaled to fill the panel.
void draw_path(const Scene& scene, cv::Mat panel) {
    if (scene.path.empty()) return;
    double left = scene.path[0].x;
    double right = left;
    double low = scene.path[0].y;
    double high = low;
    for (const PathMark& mark : scene.path) {
        left = std::min(left, mark.x);
        right = std::max(right, mark.x);
        low = std::min(low, mark.y);
        high = std::max(high, mark.y);
    }
    constexpr double kMargin = 16;
    const double scale = std::min((panel.cols - 2 * kMargin) / std::max(right - left, 1e-3),
                                  (panel.rows - 2 * kMargin) / std::max(high - low, 1e-3));
    const auto at = [&](const PathMark& mark) {
        const double y = (mark.y - low) * scale + kMargin;
        return pixel({(mark.x - left) * scale + kMargin, scene.y_up ? panel.rows - y : y});
    };
    for (std::size_t i = 1; i < scene.path.size(); ++i) {
        if (scene.path[i].is_jump) continue;
        cv::line(panel, at(scene.path[i - 1]), at(scene.path[i]), kGrid, 2, cv::LINE_AA);
    }
    cv::circle(panel, at(scene.path.back()), 5, scene.is_good ? kGood : kBad, -1, cv::LINE_AA);
}

}  // namespace

cv::Mat overlay(const Scene& scene) {
    const draw::FrameView view(scene.image, *scene.workspace, *scene.options, kLongerSide);
    const int width = even(view.width());
    const int height = std::max(even(view.height()), 480);
    cv::Mat picture(height, width + kPanelWidth, CV_8UC3, kPaper);
    // Nothing is written through it.
    const cv::Mat grey(scene.image.height_px, scene.image.width_px, CV_8UC1,
                       const_cast<std::uint8_t*>(scene.image.pixels),
                       static_cast<std::size_t>(scene.image.stride_bytes));
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    const cv::Size size(static_cast<int>(view.width()), static_cast<int>(view.height()));
    cv::Mat frame = picture(cv::Rect({0, 0}, size));
    cv::resize(colour, frame, size, 0, 0, cv::INTER_LINEAR);
    if (view.reached().cells) draw_grid(view, frame);
    draw_dots(view, frame);
    if (view.reached().pose) draw_pose(view, frame);
    const int captions = kLineHeight * (static_cast<int>(scene.lines.size()) + 1);
    draw_captions(scene, picture(cv::Rect(width, 0, kPanelWidth, height)));
    draw_path(scene, picture(cv::Rect(width, captions, kPanelWidth, height - captions)));
    return picture;
}

}  // namespace dotpose::video
