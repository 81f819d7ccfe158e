// Maps between pixels in a scan and cells of the code.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

#include "calibrate/fix_plane.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/geometry.hpp"

namespace dotpose::calibrate {

/// Map from the scan, in px, to the code plane, in cells. The map is valid in and around one tile:
///
///   cell = centre_cell + cells_per_px q / (1 + perspective_per_px . q + lens_per_px2 q^2)
///
/// where q = pixel - centre_px. The map is that of a fix (PlaneFromImage), converted to the pixel
/// coordinates of the scan.
struct TileMap {
    Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
    Eigen::Vector2d centre_cell = Eigen::Vector2d::Zero();
    Eigen::Matrix2d cells_per_px = Eigen::Matrix2d::Identity();
    Eigen::Matrix2d px_per_cell = Eigen::Matrix2d::Identity();  ///< inverse of `cells_per_px`
    Eigen::Vector2d perspective_per_px = Eigen::Vector2d::Zero();
    double lens_per_px2 = 0;

    /// Returns the map computed from a fix in a crop of the scan. The crop begins at `first_px` and
    /// is magnified by `zoom`.
    static TileMap of(const Fix& fix, const Eigen::Vector2d& first_px, int zoom);

    Eigen::Vector2d cell(const Eigen::Vector2d& pixel) const {
        const Eigen::Vector2d q = pixel - centre_px;
        return centre_cell +
               cells_per_px * q / (1 + perspective_per_px.dot(q) + lens_per_px2 * q.squaredNorm());
    }
    Eigen::Vector2d pixel(const Eigen::Vector2d& cell) const {
        const Eigen::Vector2d flat = px_per_cell * (cell - centre_cell);
        const Eigen::Vector2d q = flat / (1 - perspective_per_px.dot(flat));
        return centre_px + q * (1 + lens_per_px2 * q.squaredNorm());
    }
    double spacing_px() const { return std::sqrt(std::abs(px_per_cell.determinant())); }
};

/// Converts a pixel position in a crop to a position in the scan. The crop begins at `first_px` and
/// is magnified by `zoom`.
inline Eigen::Vector2d in_scan(const FixedVec& pixel_q8, const Eigen::Vector2d& first_px,
                               int zoom) {
    const Eigen::Vector2d from_edge(pixel_q8.x / 256.0 + 0.5, pixel_q8.y / 256.0 + 0.5);
    return first_px + from_edge / zoom - Eigen::Vector2d::Constant(0.5);
}

inline TileMap TileMap::of(const Fix& fix, const Eigen::Vector2d& first_px, int zoom) {
    const FixPlane plane(fix.pattern_from_image);
    TileMap map;
    map.centre_px = in_scan(fix.pattern_from_image.centre_q8, first_px, zoom);
    map.centre_cell = Eigen::Vector2d(fix.place.cell.x, fix.place.cell.y) + plane.at;
    map.cells_per_px = zoom * plane.linear;
    map.px_per_cell = map.cells_per_px.inverse();
    map.perspective_per_px = zoom * plane.perspective;
    map.lens_per_px2 = zoom * zoom * plane.lens;
    return map;
}

/// Rectangle of pixels. The ends are exclusive.
struct PixelRect {
    int u_begin = 0;
    int v_begin = 0;
    int u_end = 0;
    int v_end = 0;

    Eigen::Vector2d centre_px() const {
        return {0.5 * (u_begin + u_end - 1), 0.5 * (v_begin + v_end - 1)};
    }
    /// Returns true if a point is inside the rectangle or at most `border_px` outside it.
    bool contains(const Eigen::Vector2d& pixel, double border_px) const {
        return pixel.x() >= u_begin - 0.5 - border_px && pixel.x() < u_end - 0.5 + border_px &&
               pixel.y() >= v_begin - 0.5 - border_px && pixel.y() < v_end - 0.5 + border_px;
    }
};

/// Division of a scan into square tiles.
struct Tiling {
    int width_px = 0;
    int height_px = 0;
    int side_px = 0;
    int columns = 0;
    int rows = 0;

    Tiling(int width, int height, int side)
        : width_px(width),
          height_px(height),
          side_px(side),
          columns((width + side - 1) / side),
          rows((height + side - 1) / side) {}
    int count() const { return columns * rows; }
    PixelRect rect(int tile) const {
        const int u = tile % columns * side_px;
        const int v = tile / columns * side_px;
        return {u, v, std::min(u + side_px, width_px), std::min(v + side_px, height_px)};
    }
    /// Returns a rectangle around a tile, with a margin of a sixth of the side. At the edges of the
    /// scan, the rectangle is shifted inwards rather than cropped. Adjacent rectangles overlap by a
    /// third of the side, so a region smaller than the overlap is always completely inside one
    /// rectangle.
    PixelRect overlapping_rect(int tile) const {
        const int around_px = side_px / 6;
        const int full_px = side_px + 2 * around_px;
        const PixelRect inner = rect(tile);
        const int u = std::clamp(inner.u_begin - around_px, 0, std::max(width_px - full_px, 0));
        const int v = std::clamp(inner.v_begin - around_px, 0, std::max(height_px - full_px, 0));
        return {u, v, std::min(u + full_px, width_px), std::min(v + full_px, height_px)};
    }
};

}  // namespace dotpose::calibrate
