#include "serve/frame_message.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "dotpose/tools/image_file.hpp"
#include "draw/frame_view.hpp"
#include "follow/reduced_image.hpp"

namespace dotpose::serve {
namespace {

using nlohmann::json;

/// Maximum number of grid lines in each direction, and number of straight segments per grid line.
constexpr int kMaxLines = 64;
constexpr int kPieces = 6;

/// Returns the grid line from cell (i0, j0) to cell (i1, j1).
std::vector<draw::Point> grid_line(const draw::FrameView& view, int i0, int j0, int i1, int j1) {
    std::vector<draw::Point> line;
    for (int k = 0; k <= kPieces; ++k) {
        const double fraction = static_cast<double>(k) / kPieces;
        line.push_back(view.at_grid(i0 + fraction * (i1 - i0), j0 + fraction * (j1 - j0)));
    }
    return line;
}

void add_grid(const draw::FrameView& view, FrameOverlay& overlay) {
    const GridRegion& grid = view.trace().grid.region;
    const int right = grid.i0 + grid.columns - 1;
    const int bottom = grid.j0 + grid.rows - 1;
    const int step = 1 + std::max(grid.columns, grid.rows) / (kMaxLines + 1);
    for (int i = grid.i0; i <= right; i += step)
        overlay.grid.push_back(grid_line(view, i, grid.j0, i, bottom));
    for (int j = grid.j0; j <= bottom; j += step)
        overlay.grid.push_back(grid_line(view, grid.i0, j, right, j));
}

/// Rounds to a tenth of a pixel, which halves the size of the message. The rounding error is
/// invisible.
double tenth(double value_px) {
    return std::round(10 * value_px) / 10;
}

void append(json& list, draw::Point point) {
    list.push_back(tenth(point.x));
    list.push_back(tenth(point.y));
}

json numbers(const std::vector<draw::Point>& points) {
    json list = json::array();
    for (const draw::Point& point : points)
        append(list, point);
    return list;
}

json json_of(const FrameOverlay& overlay) {
    json grid = json::array();
    for (const auto& line : overlay.grid)
        grid.push_back(numbers(line));
    json result = {{"dots", numbers(overlay.dots)},
                   {"grid", std::move(grid)},
                   {"spacing_px", tenth(overlay.spacing_px)},
                   {"axes", nullptr}};
    if (const auto& axes = overlay.axes) {
        // The axes are not rounded, because directions need more digits than positions.
        result["axes"] = {axes->at.x, axes->at.y, axes->x.x, axes->x.y, axes->y.x, axes->y.y};
    }
    return result;
}

}  // namespace

FrameOverlay overlay_of(ImageView image, const Trace& trace) {
    const draw::FrameView view(image, trace, std::max(image.width_px, image.height_px));
    FrameOverlay overlay;
    overlay.spacing_px = view.spacing();
    for (const DetectedDot& dot : trace.dots)
        overlay.dots.push_back(view.at_dot(dot));
    if (view.reached().cells) add_grid(view, overlay);
    if (view.reached().pose) {
        // The pattern is not mirrored, so the y axis is the x axis rotated by a quarter turn.
        const draw::Point ahead = view.ahead_of_reference();
        overlay.axes = {view.at(view.reference_px()), ahead, {-ahead.y, ahead.x}};
    }
    return overlay;
}

std::string frame_message(ImageView image, const FrameOverlay& overlay, std::int64_t index,
                          int max_side_px) {
    const json head = {{"frame", index},
                       {"width_px", image.width_px},
                       {"height_px", image.height_px},
                       {"overlay", json_of(overlay)}};
    const std::string text = head.dump();
    const int side_px = std::max(image.width_px, image.height_px);
    const int by = (side_px + max_side_px - 1) / max_side_px;
    const std::vector<std::uint8_t> picture =
        by == 1 ? encode_image(ImageEncoding::jpeg, image)
                : encode_image(ImageEncoding::jpeg, follow_detail::reduced(image, by).view());
    std::string message;
    message.reserve(4 + text.size() + picture.size());
    for (int shift = 0; shift < 32; shift += 8)
        message += static_cast<char>(text.size() >> shift & 0xff);
    message += text;
    message.append(picture.begin(), picture.end());
    return message;
}

}  // namespace dotpose::serve
