#include "video/opencv/overlay.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "draw/bounds.hpp"
#include "draw/frame_view.hpp"
#include "video/opencv/calibration_overlay.hpp"
#include "video/opencv/ink.hpp"

namespace dotpose::video {
namespace {

constexpr int kLongerSide = 800;  ///< longer side of the frame in the picture, in px
constexpr int kPanelWidth = 400;
constexpr int kLineHeight = 24;

int even(double length) {
    return 2 * static_cast<int>(std::ceil(length / 2));
}

/// Draws the grid. If the grid is large, draws only every `step`-th line, so that there are at most
/// a few hundred lines.
void draw_grid(const draw::FrameView& view, cv::Mat& picture) {
    const GridRegion& grid = view.trace().grid.region;
    const int step = std::max({1, grid.columns / 64, grid.rows / 64});
    const auto line = [&](int i0, int j0, int i1, int j1) {
        cv::line(picture, pixel(view.at_grid(i0, j0)), pixel(view.at_grid(i1, j1)), kGrid, 1,
                 cv::LINE_AA);
    };
    // Lens distortion bends the grid lines, so each line is drawn as a series of short segments.
    for (int i = grid.i0; i < grid.i0 + grid.columns; i += step) {
        for (int j = grid.j0; j < grid.j0 + grid.rows; j += step) {
            if (i + step < grid.i0 + grid.columns) line(i, j, i + step, j);
            if (j + step < grid.j0 + grid.rows) line(i, j, i, j + step);
        }
    }
}

void draw_dots(const draw::FrameView& view, cv::Mat& picture) {
    const int radius = std::max(2, static_cast<int>(view.spacing() * 0.2));
    for (const DetectedDot& dot : view.trace().dots)
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

/// A panel that shows the sheets and the path from above. Its contents are scaled to fit.
class Plan {
  public:
    Plan(const Scene& scene, cv::Mat panel) : panel_(std::move(panel)), y_up_(scene.y_up) {
        for (const PathMark& mark : scene.path)
            bounds_.add({mark.x, mark.y});
        for (const draw::MapSheet& sheet : scene.sheets) {
            for (const draw::Point& corner : sheet.corners_mm)
                bounds_.add(corner);
        }
        scale_ =
            std::min((panel_.cols - 2 * kMargin) / std::max(bounds_.high.x - bounds_.low.x, 1e-3),
                     (panel_.rows - 2 * kMargin) / std::max(bounds_.high.y - bounds_.low.y, 1e-3));
    }

    void line(draw::Point from, draw::Point to, const cv::Scalar& colour, int width) {
        cv::line(panel_, at(from), at(to), colour, width, cv::LINE_AA);
    }
    void spot(draw::Point place, const cv::Scalar& colour) {
        cv::circle(panel_, at(place), 5, colour, -1, cv::LINE_AA);
    }

  private:
    static constexpr double kMargin = 16;

    cv::Point at(draw::Point point) const {
        const double y = (point.y - bounds_.low.y) * scale_ + kMargin;
        return pixel({(point.x - bounds_.low.x) * scale_ + kMargin, y_up_ ? panel_.rows - y : y});
    }

    cv::Mat panel_;
    bool y_up_;
    draw::Bounds bounds_;
    double scale_ = 1;
};

void draw_plan(const Scene& scene, const cv::Mat& panel) {
    Plan plan(scene, panel);
    for (const draw::MapSheet& sheet : scene.sheets) {
        for (std::size_t i = 0; i < sheet.corners_mm.size(); ++i) {
            const std::size_t next = (i + 1) % sheet.corners_mm.size();
            plan.line(sheet.corners_mm[i], sheet.corners_mm[next], kInk, 1);
        }
    }
    const auto point = [](const PathMark& mark) { return draw::Point{mark.x, mark.y}; };
    for (std::size_t i = 1; i < scene.path.size(); ++i) {
        if (scene.path[i].is_jump) continue;
        plan.line(point(scene.path[i - 1]), point(scene.path[i]), kGrid, 2);
    }
    if (!scene.path.empty()) plan.spot(point(scene.path.back()), scene.is_good ? kGood : kBad);
}

}  // namespace

cv::Mat overlay(const Scene& scene) {
    const draw::FrameView view(scene.image, scene.trace, kLongerSide);
    const int width = even(view.width());
    const int height = std::max(even(view.height()), 480);
    cv::Mat picture(height, width + kPanelWidth, CV_8UC3, kPaper);
    // The cast is safe, because the pixels are not modified. cv::Mat has no read-only view.
    const cv::Mat grey(scene.image.height_px, scene.image.width_px, CV_8UC1,
                       const_cast<std::uint8_t*>(scene.image.pixels),
                       static_cast<std::size_t>(scene.image.stride_bytes));
    cv::Mat colour;
    cv::cvtColor(grey, colour, cv::COLOR_GRAY2BGR);
    const cv::Size size(static_cast<int>(view.width()), static_cast<int>(view.height()));
    cv::Mat frame = picture(cv::Rect({0, 0}, size));
    cv::resize(colour, frame, size, 0, 0, cv::INTER_LINEAR);
    if (scene.calibration) draw_coverage(*scene.calibration, frame);
    if (view.reached().cells) draw_grid(view, frame);
    draw_dots(view, frame);
    if (view.reached().pose) draw_pose(view, frame);
    const int captions = kLineHeight * (static_cast<int>(scene.lines.size()) + 1);
    draw_captions(scene, picture(cv::Rect(width, 0, kPanelWidth, height)));
    const cv::Mat rest = picture(cv::Rect(width, captions, kPanelWidth, height - captions));
    if (scene.calibration) {
        draw_gauges(*scene.calibration, rest);
    } else {
        draw_plan(scene, rest);
    }
    return picture;
}

}  // namespace dotpose::video
