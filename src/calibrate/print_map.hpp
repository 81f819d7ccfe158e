// Print map: where the cells of the code are seen in a scan, around one place.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "dotpose/code.hpp"

namespace dotpose::calibrate {

/// Maps between the code plane, in cells, and the scan, in px, within some tens of cells: pixel =
/// centre + (px_per_cell * d) / (1 + perspective . d), with d = cell - centre.
struct LocalMap {
    Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
    Eigen::Vector2d centre_cell = Eigen::Vector2d::Zero();
    Eigen::Matrix2d px_per_cell = Eigen::Matrix2d::Identity();
    Eigen::Vector2d perspective_per_cell = Eigen::Vector2d::Zero();

    Eigen::Vector2d pixel(const Eigen::Vector2d& cell) const {
        const Eigen::Vector2d d = cell - centre_cell;
        return centre_px + px_per_cell * d / (1 + perspective_per_cell.dot(d));
    }
    Eigen::Vector2d cell(const Eigen::Vector2d& pixel) const {
        const Eigen::Vector2d q = px_per_cell.inverse() * (pixel - centre_px);
        return centre_cell + q / (1 - perspective_per_cell.dot(q));
    }
    double spacing_px() const { return std::sqrt(std::abs(px_per_cell.determinant())); }
};

/// The perspective in which a camera sees the whole paper; `at` gives that of the map around a
/// place.
struct Perspective {
    Eigen::Vector2d centre_cell = Eigen::Vector2d::Zero();
    Eigen::Vector2d per_cell = Eigen::Vector2d::Zero();

    Eigen::Vector2d at(const Eigen::Vector2d& cell) const {
        return per_cell / (1 + per_cell.dot(cell - centre_cell));
    }
};

/// A rectangle of pixels, ends exclusive.
struct PixelRect {
    int u_begin = 0;
    int v_begin = 0;
    int u_end = 0;
    int v_end = 0;

    Eigen::Vector2d centre_px() const {
        return {0.5 * (u_begin + u_end - 1), 0.5 * (v_begin + v_end - 1)};
    }
    /// Whether a point lies in the rectangle or at most `border_px` outside.
    bool contains(const Eigen::Vector2d& pixel, double border_px) const {
        return pixel.x() >= u_begin - 0.5 - border_px && pixel.x() < u_end - 0.5 + border_px &&
               pixel.y() >= v_begin - 0.5 - border_px && pixel.y() < v_end - 0.5 + border_px;
    }
};

/// The tiles of a scan, in which cells are searched one after the other.
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
};

}  // namespace dotpose::calibrate
