#include "video/opencv/calibration_overlay.hpp"

#include <algorithm>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "video/opencv/ink.hpp"

namespace dotpose::video {
namespace {

const cv::Scalar kEmpty(224, 219, 213);  ///< colour of empty gauges and of unseen directions
constexpr int kMargin = 12;
constexpr int kRowHeight = 44;

void write(cv::Mat& panel, const std::string& text, cv::Point at, const cv::Scalar& colour) {
    cv::putText(panel, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv::LINE_AA);
}

/// Draws a compass aligned with the sheet. Green sectors show the directions in which the image x
/// axis has pointed so far, and an arrow shows its current direction.
void draw_directions(const CalibrationScene& scene, cv::Point centre, int radius, cv::Mat& panel) {
    constexpr int kDirections = CalibrationCoverage::kDirections;
    for (int i = 0; i < kDirections; ++i) {
        constexpr double kPart_deg = 360.0 / kDirections;
        constexpr double kGap_deg = 2;
        const bool is_seen = scene.coverage.has_direction(i);
        cv::ellipse(panel, centre, {radius, radius}, 0, i * kPart_deg + kGap_deg,
                    (i + 1) * kPart_deg - kGap_deg, is_seen ? kGood : kEmpty, -1, cv::LINE_AA);
    }
    cv::circle(panel, centre, radius / 2, kPaper, -1, cv::LINE_AA);
    if (!scene.theta_rad) return;
    const draw::Point ahead{std::cos(*scene.theta_rad), std::sin(*scene.theta_rad)};
    const draw::Point from{static_cast<double>(centre.x), static_cast<double>(centre.y)};
    cv::arrowedLine(panel, centre, pixel(from + 0.95 * radius * ahead), kInk, 2, cv::LINE_AA);
}

}  // namespace

void draw_coverage(const CalibrationScene& scene, cv::Mat frame) {
    constexpr double kVeil = 0.35;
    const cv::Mat plain = frame.clone();
    const auto edge = [](int part, int parts, int length) { return part * length / parts; };
    for (int row = 0; row < ImageCoverage::kRows; ++row) {
        for (int column = 0; column < ImageCoverage::kColumns; ++column) {
            if (scene.coverage.image().is_covered(column, row)) continue;
            const cv::Point from(edge(column, ImageCoverage::kColumns, frame.cols),
                                 edge(row, ImageCoverage::kRows, frame.rows));
            const cv::Point to(edge(column + 1, ImageCoverage::kColumns, frame.cols),
                               edge(row + 1, ImageCoverage::kRows, frame.rows));
            cv::rectangle(frame, from, to - cv::Point(2, 2), kBad, -1);
        }
    }
    cv::addWeighted(frame, kVeil, plain, 1 - kVeil, 0, frame);
    constexpr int kBorder = 10;
    if (scene.is_taken) {
        cv::rectangle(frame, cv::Rect({0, 0}, frame.size()), kGood, kBorder);
    }
}

void draw_gauges(const CalibrationScene& scene, cv::Mat panel) {
    const int width = panel.cols - 2 * kMargin;
    int top = 0;
    for (const Gauge& gauge : scene.gauges) {
        const cv::Scalar& ink = gauge.is_reached ? kGood : kBad;
        write(panel, gauge.label, {kMargin, top + 16}, kInk);
        write(panel, gauge.text, {kMargin + 120, top + 16}, ink);
        const cv::Rect bar(kMargin, top + 23, width, 10);
        cv::rectangle(panel, bar, kEmpty, -1);
        const int filled = static_cast<int>(std::lround(gauge.fraction * width));
        if (filled > 0) cv::rectangle(panel, cv::Rect(bar.tl(), cv::Size(filled, 10)), ink, -1);
        top += kRowHeight;
    }
    const int radius = std::min((panel.rows - top) / 2 - kMargin, 80);
    constexpr int kMinRadius = 20;
    if (radius >= kMinRadius) {
        draw_directions(scene, {panel.cols / 2, top + kMargin + radius}, radius, panel);
    }
}

}  // namespace dotpose::video
