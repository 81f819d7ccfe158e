#include "calibrate/map_start.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <Eigen/Geometry>

#include "calibrate/fix_plane.hpp"
#include "calibrate/located_frame.hpp"
#include "calibrate/map_geometry.hpp"
#include "calibrate/median.hpp"
#include "calibrate/similarity.hpp"
#include "dotpose/code.hpp"

namespace dotpose::calibrate {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// Returns the position in mm of an observation whose coordinates are still in px.
Vector2d place_of(const FixPlane& view, const MapObservation& seen) {
    return view.place(Vector2d(double(seen.x_mm), double(seen.y_mm)) - view.centre_px);
}

/// Returns the view of a frame in mm, without position and rotation. `linear` is then symmetric.
FixPlane view_of(const PlaneFromImage& plane, const Vector2d& pitch_mm) {
    FixPlane view(plane);
    const Matrix2d linear = pitch_mm.asDiagonal() * view.linear;
    const double angle = std::atan2(linear(1, 0) - linear(0, 1), linear(0, 0) + linear(1, 1));
    const Matrix2d shape = Eigen::Rotation2D<double>(-angle).toRotationMatrix() * linear;
    view.linear = (shape + shape.transpose()) / 2;
    view.at.setZero();
    return view;
}

double median_of(const std::vector<FixPlane>& views,
                 const std::function<double(const FixPlane&)>& value) {
    std::vector<double> values;
    for (const FixPlane& view : views)
        values.push_back(value(view));
    return upper_median(std::move(values));
}

FixPlane median_view(const std::vector<FixPlane>& views) {
    FixPlane view = views.front();
    for (int i = 0; i < 2; ++i) {
        view.perspective[i] = median_of(views, [&](const FixPlane& v) { return v.perspective[i]; });
        for (int j = 0; j < 2; ++j)
            view.linear(i, j) = median_of(views, [&](const FixPlane& v) { return v.linear(i, j); });
    }
    view.lens = median_of(views, [](const FixPlane& v) { return v.lens; });
    return view;
}

/// Returns true if the views differ so much that the camera must have been hand-held: the median
/// relative difference between `linear` of a view and `typical.linear` exceeds kMaxMedianChange.
bool differ(const std::vector<FixPlane>& views, const FixPlane& typical) {
    constexpr double kMaxMedianChange = 0.01;
    return median_of(views, [&](const FixPlane& view) {
               return (view.linear - typical.linear).norm() / typical.linear.norm();
           }) > kMaxMedianChange;
}

}  // namespace

MapGrid grid_of(const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    MapGrid grid{
        sheet.columns,
        sheet.rows,
        sheet.pattern.spacing_mm * Eigen::Vector2d(entry.print_scale_x, entry.print_scale_y),
        {}};
    const Place first{sheet.origin, sheet.pattern.section};
    for (int j = 0; j < sheet.rows; ++j) {
        for (int i = 0; i < sheet.columns; ++i) {
            const Place place = moved(sheet.pattern.code, first, i, j);
            const Symbol symbol = symbol_at(sheet.pattern.code, place.cell, place.section);
            grid.directions.push_back(
                {static_cast<std::int8_t>(dx(symbol)), static_cast<std::int8_t>(dy(symbol))});
        }
    }
    return grid;
}

bool add_sighting(const Fix& fix, const Trace& trace, const MapPage& page, std::size_t min_dots,
                  std::vector<MapSighting>& frames, std::vector<MapObservation>& observations) {
    MapSighting frame{observations.size(), 0, fix.pattern_from_image};
    for (const LocatedDot& dot : dots_read(trace)) {
        const auto index =
            page.index_of(moved(trace.options.code, trace.decoding.place, dot.step.x, dot.step.y));
        if (!index) continue;
        observations.push_back({static_cast<std::uint32_t>(*index), static_cast<float>(dot.pixel.u),
                                static_cast<float>(dot.pixel.v)});
    }
    frame.count = observations.size() - frame.first;
    if (frame.count < min_dots) {
        observations.resize(frame.first);
        return false;
    }
    frames.push_back(frame);
    return true;
}

double start_map(const MapGrid& grid, const EarlierOffsets& earlier,
                 const std::optional<Camera>& camera, const std::vector<MapSighting>& frames,
                 std::vector<MapObservation>& observations, MapSolution& solution) {
    std::vector<FixPlane> views;
    for (const MapSighting& frame : frames)
        views.push_back(view_of(frame.plane, grid.pitch_mm));
    const FixPlane typical = median_view(views);
    const bool is_mounted = !differ(views, typical);
    double reach_mm = 0;
    std::vector<double> scales;
    for (std::size_t f = 0; f < frames.size(); ++f) {
        MapFrame frame{.first = frames[f].first, .count = frames[f].count};
        std::vector<SimilarPoint> points;
        for (std::size_t i = frame.first; i < frame.first + frame.count; ++i) {
            MapObservation& seen = observations[i];
            Vector2d at = place_of(is_mounted ? typical : views[f], seen);
            if (camera && camera->paper) {
                const CameraPoint on = on_paper(*camera, {seen.x_mm, seen.y_mm});
                at = {on.x_mm, on.y_mm};
            }
            seen.x_mm = static_cast<float>(at.x());
            seen.y_mm = static_cast<float>(at.y());
            reach_mm = std::max(reach_mm, at.norm());
            const auto& [dx, dy] = grid.directions[seen.dot];
            Vector2d place = grid.place_mm(seen.dot);
            if (!earlier.views.empty()) place += earlier.offset_mm[seen.dot].cast<double>();
            points.push_back({at, place, Vector2d(dx, dy)});
        }
        const Similarity fit = fit_similarity(points);
        frame.place_mm = fit.place;
        frame.angle_rad = fit.angle_rad;
        frame.displacement_mm = fit.displacement;
        solution.frames.push_back(frame);
        scales.push_back(fit.scale);
    }
    const auto scale = static_cast<float>(upper_median(scales));
    for (MapObservation& seen : observations) {
        seen.x_mm *= scale;
        seen.y_mm *= scale;
    }
    return reach_mm * double(scale);
}

double misfit(const MapGrid& grid, const EarlierOffsets& earlier, double reach_mm,
              const std::vector<MapObservation>& observations, const MapSolution& solution) {
    double with_map = 0;
    double without = 0;
    for (const MapFrame& frame : solution.frames) {
        const MapView view(grid, frame, reach_mm);
        // Removes the components of the residuals that a fit of the pose and the view would absorb.
        Eigen::MatrixXd design(2 * static_cast<Eigen::Index>(frame.count), kFrameTerms);
        Eigen::MatrixXd residuals(design.rows(), 2);
        for (std::size_t k = 0; k < frame.count; ++k) {
            const MapObservation& seen = observations[frame.first + k];
            const auto row = 2 * static_cast<Eigen::Index>(k);
            design.middleRows<2>(row) = view.terms(seen).derivatives();
            residuals.block<2, 1>(row, 0) = view.residual(seen);
            residuals.block<2, 1>(row, 1) =
                view.residual(seen) - view.page_from_camera().transpose() *
                                          earlier.offset_mm[seen.index()].cast<double>();
        }
        const Eigen::MatrixXd normal = design.transpose() * design;
        const Eigen::MatrixXd left =
            residuals - design * normal.ldlt().solve(design.transpose() * residuals);
        const auto median_square = [&](Eigen::Index column) {
            const Eigen::VectorXd squares = left.col(column).cwiseAbs2();
            return upper_median({squares.begin(), squares.end()});
        };
        without += median_square(0);
        with_map += median_square(1);
    }
    return with_map / without;
}

}  // namespace dotpose::calibrate
