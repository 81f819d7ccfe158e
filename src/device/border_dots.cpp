#include "device/border_dots.hpp"

#include <algorithm>

#include "device/dark_pixels.hpp"
#include "device/fine_dots.hpp"

namespace dotpose::core {
namespace {

/// Range of columns or rows around a pixel, clipped to the image. `last` is inclusive.
struct Range {
    int first;
    int last;

    Range(int middle, int half, int side_px)
        : first(std::max(middle - half, 0)), last(std::min(middle + half, side_px - 1)) {}
};

/// A pixel near the image border, and its neighbours that are inside the image.
class AtBorder {
  public:
    AtBorder(const Tracking& tracking, int u, int v)
        : tracking_(tracking),
          u_(u),
          v_(v),
          columns_(u, 1, tracking.width_px),
          rows_(v, 1, tracking.height_px),
          here_(kept_row(tracking, v)[u]) {}

    int darkness_below(int level) const { return level - here_; }
    /// Returns true if the pixel is darker than all adjacent pixels. Ties are broken in favour of
    /// the last pixel in row-major order.
    bool is_darkest() const {
        for (int v = rows_.last; v >= rows_.first; --v) {
            const std::uint8_t* const row = kept_row(tracking_, v);
            for (int u = columns_.last; u >= columns_.first; --u) {
                if (u == u_ && v == v_) continue;
                const bool is_later = v > v_ || (v == v_ && u > u_);
                if (row[u] < here_ + (is_later ? 1 : 0)) return false;
            }
        }
        return true;
    }
    /// Returns the paper level around the pixel, estimated as in `find_fine_dots`.
    int paper() const {
        const Range columns(u_, 2, tracking_.width_px);
        const Range rows(v_, 2, tracking_.height_px);
        const std::uint8_t* const top = kept_row(tracking_, rows.first);
        const std::uint8_t* const bottom = kept_row(tracking_, rows.last);
        return (std::max(top[columns.first], bottom[columns.last]) +
                std::max(top[columns.last], bottom[columns.first])) >>
               1;
    }
    /// Returns the darkness sums over the pixel and its neighbours, relative to `level`. If some of
    /// the neighbours are outside the image, corrects the sums for the missing pixels.
    DarkSums sums(int level) const;

  private:
    const Tracking& tracking_;
    int u_;
    int v_;
    Range columns_;
    Range rows_;
    int here_;
};

DarkSums AtBorder::sums(int level) const {
    DarkSums sums;
    for (int v = rows_.first; v <= rows_.last; ++v) {
        const std::uint8_t* const row = kept_row(tracking_, v);
        for (int u = columns_.first; u <= columns_.last; ++u) {
            const int darkness = level - row[u];
            if (darkness < 0) continue;
            sums.mass += darkness;
            sums.x += (u - u_) * darkness;
            sums.y += (v - v_) * darkness;
        }
    }
    // If the darkest pixel is on the border, a third of the 3 x 3 pixels are outside the image.
    // Without a correction, the centroid would be wrong by about a quarter of a pixel.
    const auto correction = [mass = sums.mass](int at, int side_px) {
        if (at == 0) return -mass / 4;
        return at == side_px - 1 ? mass / 4 : 0;
    };
    sums.x += correction(u_, tracking_.width_px);
    sums.y += correction(v_, tracking_.height_px);
    return sums;
}

/// If pixel (u, v) is the darkest pixel of a dot, adds this dot.
DOTPOSE_NOINLINE void add_if_dot(int u, int v, Tracking& tracking) {
    const AtBorder pixel(tracking, u, v);
    if (!pixel.is_darkest()) return;
    const int paper = pixel.paper();
    const int level = paper_edge(paper);
    if (pixel.darkness_below(level) <= 0 || pixel.darkness_below(paper) < tracking.min_contrast)
        return;
    DarkSums sums = pixel.sums(level);
    // Scales the sums by 3/2, because the 3 x 3 pixels contain only about two thirds of the mass of
    // a dot.
    sums = {sums.mass * 3 / 2, sums.x * 3 / 2, sums.y * 3 / 2};
    add_fine_dot({u, v}, sums, tracking);
}

}  // namespace

void find_border_dots(Tracking& tracking) {
    constexpr int kBorder_px = kFirstFineRow;
    const int width = tracking.width_px;
    const int height = tracking.height_px;
    const int end_v = height - kBorder_px;
    for (const PixelArea& area :
         {PixelArea{0, 0, width, kBorder_px}, PixelArea{0, end_v, width, height},
          PixelArea{0, kBorder_px, kBorder_px, end_v},
          PixelArea{width - kBorder_px, kBorder_px, width, end_v}}) {
        visit_dark_pixels(tracking, area,
                          [&](const std::uint8_t*, int u, int v) { add_if_dot(u, v, tracking); });
    }
}

}  // namespace dotpose::core
