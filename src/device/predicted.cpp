#include "device/predicted.hpp"

#include <algorithm>

#include "core/math/plane.hpp"
#include "device/near_dot.hpp"
#include "device/newest_rows.hpp"
#include "dotpose/image.hpp"

namespace dotpose::core {
namespace {

/// Range of cell shapes. The spacing is the side of a square with the area of a cell.
struct CellShapeRange {
    int min_spacing_px;
    int max_spacing_px;
    /// Maximum shear and stretch, relative to the reciprocal of the cell area. The shear is the dot
    /// product of the derivatives of the cell coordinates with respect to u and to v. The stretch
    /// is the difference of their squared lengths.
    int max_deformation;
};
/// Cells whose dots are read in the squares around their intersections. Motion during the readout
/// of a rolling shutter deforms the cells, so some shear and stretch must be accepted.
constexpr CellShapeRange kReadInSquares{7, 14, 1};
/// Cells whose dots are found independently of the prediction (device/fine_grid.hpp). Such cells
/// are tracked only if sheets are known.
constexpr CellShapeRange kReadAtDots{5, 20, 3};
/// Range of displacements that can be tracked: a twelfth to a third of the spacing.
constexpr std::int32_t kMinDisplacement_q16 = 65536 / 12;
constexpr std::int32_t kMaxDisplacement_q16 = 65536 / 3;

constexpr std::int64_t kOne_q24 = 1 << 24;
/// Maximum derivative of a cell coordinate, in 2^-24 cells per px.
constexpr std::int32_t kSteepest_q24 = (1 << 24) / 4;

/// Returns true if all values of the prediction are in the ranges that can be tracked. Within these
/// ranges, no later computation overflows.
bool is_sane(const Prediction& prediction) {
    const PlaneFromImage& plane = prediction.pattern_from_image;
    constexpr std::int32_t kFarthest_q8 = 1 << 21;
    constexpr std::int32_t kFarthest_q16 = 1 << 28;
    constexpr std::int32_t kSteepest_q30 = 1 << 24;
    const Place& place = prediction.place;
    return is_within(plane.centre_q8, kFarthest_q8) &&
           is_within(plane.at_centre_q16, kFarthest_q16) &&
           is_within(plane.du_q24, kSteepest_q24) && is_within(plane.dv_q24, kSteepest_q24) &&
           is_within(plane.perspective_q30, kSteepest_q30) && place.cell.x < kPositionsPerAxis &&
           place.cell.y < kPositionsPerAxis && place.section.u < kSections &&
           place.section.v < kSections && prediction.displacement_q16 >= kMinDisplacement_q16 &&
           prediction.displacement_q16 <= kMaxDisplacement_q16;
}

/// Shape of the cells of a plane, in 2^-24 cells per px^2. The derivatives must be at most
/// kSteepest_q24.
struct CellShape {
    std::int64_t det_q24;  ///< reciprocal of the cell area
    std::int32_t shear_q24;
    std::int32_t stretch_q24;

    explicit CellShape(const PlaneFromImage& plane) {
        const FixedVec du = plane.du_q24;
        const FixedVec dv = plane.dv_q24;
        det_q24 = cross(du, dv) >> 24;
        const FixedVec x{du.x >> 8, dv.x >> 8};
        const FixedVec y{du.y >> 8, dv.y >> 8};
        shear_q24 = (x.x * x.y + y.x * y.y) >> 8;
        stretch_q24 = (x.x * x.x + y.x * y.x - x.y * x.y - y.y * y.y) >> 8;
    }
    bool is_in(const CellShapeRange& range) const {
        const std::int64_t max_q24 = range.max_deformation * det_q24;
        return det_q24 >= kOne_q24 / (range.max_spacing_px * range.max_spacing_px) &&
               det_q24 <= kOne_q24 / (range.min_spacing_px * range.min_spacing_px) &&
               magnitude(shear_q24) <= max_q24 && magnitude(stretch_q24) <= max_q24;
    }
};

/// Sets `cells` to the inverse of a plane with determinant `det_q24`.
void invert(const PlaneFromImage& plane, std::int32_t det_q24, CellMap& cells) {
    const FixedVec at_q16 = plane.at_centre_q16;
    const FixedVec du = plane.du_q24;
    const FixedVec dv = plane.dv_q24;
    const auto step_q16 = [&](std::int32_t a_q24) {
        return short_quotient(std::int64_t{a_q24} << 16, det_q24);
    };
    cells.along_x_q16 = {step_q16(dv.y), step_q16(-du.y)};
    cells.along_y_q16 = {step_q16(-dv.x), step_q16(du.x)};
    const auto origin_q16 = [&](std::int32_t centre_q8, std::int32_t x_q16, std::int32_t y_q16) {
        const std::int64_t from_centre_q32 =
            std::int64_t{at_q16.x} * x_q16 + std::int64_t{at_q16.y} * y_q16;
        return centre_q8 * 256 - static_cast<std::int32_t>(from_centre_q32 >> 16);
    };
    cells.origin_q16 = {origin_q16(plane.centre_q8.x, cells.along_x_q16.x, cells.along_y_q16.x),
                        origin_q16(plane.centre_q8.y, cells.along_x_q16.y, cells.along_y_q16.y)};
}

/// Crops a frame until its cells fit in memory. Returns the maximum distance of a cell from the
/// middle of the remaining part, in cells.
int leave_out_edges(std::int32_t spacing_q8, Tracking& tracking) {
    int width_px = tracking.width_px;
    int height_px = tracking.height_px;
    for (;;) {
        const auto squared_px =
            static_cast<std::uint32_t>(width_px * width_px + height_px * height_px);
        const int cells = static_cast<int>(square_root(squared_px)) * 128 / spacing_q8 + 3;
        if (cells <= kMaxComparedLines / 2) {
            // Crops the same number of pixels from opposite sides, so the image centre does not
            // change.
            tracking.left_out_px = static_cast<std::int16_t>((tracking.width_px - width_px) >> 1);
            tracking.rows_above = static_cast<std::int16_t>((tracking.height_px - height_px) >> 1);
            tracking.height_px = height_px;
            return cells;
        }
        width_px -= width_px >> 4 << 1;
        height_px -= height_px >> 4 << 1;
    }
}

/// Sets the members that depend on the spacing. Returns false if the memory is too small, if the
/// frame has too few rows, or if the image must be cropped to less than `min_side_px` to make its
/// cells fit in the memory.
bool lay_out_memory(std::int32_t spacing_q8, Tracking& tracking) {
    const int cells = leave_out_edges(spacing_q8, tracking);
    const int width_px = tracking.width_px - 2 * tracking.left_out_px;
    if (std::min(width_px, tracking.height_px) < tracking.min_side_px) return false;
    tracking.first_cell = kMaxComparedLines / 2 - cells;
    tracking.last_cell = kMaxComparedLines / 2 + cells - 1;
    tracking.stride_px = stride_of(tracking.width_px);
    tracking.rows_kept = static_cast<int>(tracking.rows.size()) / tracking.stride_px;
    set_half_side(kHalf_px, tracking);
    if (2 * kRowsNeeded + kRowsAtOnce > tracking.rows_kept) return false;
    // If the memory has room for all rows, the prediction error is measured from the whole frame.
    // Otherwise, it is measured from the first rows, up to a height of 13/4 spacings. At least 5/2
    // spacings are required.
    const bool keeps_frame = tracking.height_px <= tracking.rows_kept;
    tracking.first_rows =
        keeps_frame ? tracking.height_px
                    : std::min<std::int32_t>(13 * spacing_q8 / (4 * 256), tracking.rows_kept);
    return tracking.first_rows * 256 >= 5 * spacing_q8 / 2;
}

/// Returns the radius of the search around the predicted position, in px at the image centre. The
/// radius is three standard deviations of the prediction, but at most 3/5 of the spacing.
int reach_px(const Prediction& prediction, std::int32_t spacing_q8) {
    const std::int64_t wanted_q16 = 3 * std::int64_t{prediction.sigma_q16};
    const auto shift_q16 =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(wanted_q16, 0, 65536 * 3 / 5));
    return ((shift_q16 >> 8) * spacing_q8) >> 16;
}

/// Returns the minimum distance from one column or one row of cells to the next, in 2^-8 px: the
/// reciprocal of the larger gradient of the two cell coordinates.
std::int32_t min_step_q8(const PlaneFromImage& plane) {
    const auto squared_q32 = [](std::int32_t du_q24, std::int32_t dv_q24) {
        const std::int32_t du_q16 = du_q24 >> 8;
        const std::int32_t dv_q16 = dv_q24 >> 8;
        return du_q16 * du_q16 + dv_q16 * dv_q16;
    };
    const std::int32_t max_q32 = std::max(squared_q32(plane.du_q24.x, plane.dv_q24.x),
                                          squared_q32(plane.du_q24.y, plane.dv_q24.y));
    return static_cast<std::int32_t>(
        square_root(UINT32_MAX / static_cast<std::uint32_t>(max_q32 >> 16)));
}

/// Sets the cells of a grid that is not fine, and the members that depend on the cells. Returns
/// false in the same cases as `lay_out_memory`.
bool lay_cells(const Prediction& prediction, const PlaneFromImage& plane, std::int32_t det_q24,
               Tracking& tracking) {
    invert(plane, det_q24, tracking.cells);
    // The spacing is the side of a square with the area of a cell.
    const std::int64_t area_q32 = cross(tracking.cells.along_x_q16, tracking.cells.along_y_q16);
    const auto spacing_q8 =
        static_cast<std::int32_t>(square_root(static_cast<std::uint64_t>(area_q32)) >> 8);
    if (!lay_out_memory(spacing_q8, tracking)) return false;
    tracking.cells.origin_q16.y -= tracking.rows_above * 65536;
    tracking.du_q20 = {plane.du_q24.x >> 4, plane.du_q24.y >> 4};
    tracking.dv_q20 = {plane.dv_q24.x >> 4, plane.dv_q24.y >> 4};
    tracking.spacing_q8 = spacing_q8;
    tracking.reach_px = reach_px(prediction, spacing_q8);
    set_displacement(prediction.displacement_q16 >> 4, tracking);
    return true;
}

}  // namespace

FixedVec middle_cell(const Tracking& tracking) {
    const FixedVec middle_q8{(tracking.width_px - 1) * 128, (tracking.first_rows - 1) * 128};
    const FixedVec p_q8 =
        middle_q8 - FixedVec{tracking.cells.origin_q16.x >> 8, tracking.cells.origin_q16.y >> 8};
    const auto cell = [&](std::int32_t du_q20, std::int32_t dv_q20) {
        return shift_rounded(std::int64_t{du_q20} * p_q8.x + std::int64_t{dv_q20} * p_q8.y, 28);
    };
    return {cell(tracking.du_q20.x, tracking.dv_q20.x), cell(tracking.du_q20.y, tracking.dv_q20.y)};
}

void set_displacement(std::int32_t displacement_q12, Tracking& tracking) {
    tracking.displacement_q12 = displacement_q12;
    const auto displaced = [&](FixedVec along_q16) {
        return FixedVec{((along_q16.x >> 4) * displacement_q12) >> 8,
                        ((along_q16.y >> 4) * displacement_q12) >> 8};
    };
    const FixedVec x = displaced(tracking.cells.along_x_q16);
    const FixedVec y = displaced(tracking.cells.along_y_q16);
    for (std::size_t s = 0; s < tracking.displaced_q16.size(); ++s) {
        const auto symbol = static_cast<Symbol>(s);
        tracking.displaced_q16[s] = {dx(symbol) * x.x + dy(symbol) * y.x,
                                     dx(symbol) * x.y + dy(symbol) * y.y};
    }
}

Status lay_predicted_cells(const Prediction& prediction, CodeVariant code, PlaneFromImage& plane,
                           Tracking& tracking) {
    if (!is_sane(prediction)) return Status::not_tracked;
    const FixedVec centre_q8{(tracking.width_px - 1) * 128, (tracking.height_px - 1) * 128};
    plane = tangent(prediction.pattern_from_image, centre_q8);
    // Cell (kMaxComparedLines / 2, kMaxComparedLines / 2) is in the middle of the image.
    const FixedVec at = plane.at_centre_q16;
    const FixedVec first{(at.x >> 16) - kMaxComparedLines / 2,
                         (at.y >> 16) - kMaxComparedLines / 2};
    tracking.corner = moved(code, prediction.place, first.x, first.y);
    const FixedVec at_q16{at.x - first.x * 65536, at.y - first.y * 65536};
    // The perspective of the prediction may make the tangent steeper than the prediction itself.
    if (!is_within(plane.du_q24, kSteepest_q24) || !is_within(plane.dv_q24, kSteepest_q24))
        return Status::not_tracked;
    const CellShape shape(plane);
    const bool knows_sheets = tracking.min_side_px < kMinFrameSide_px;
    tracking.is_fine = !shape.is_in(kReadInSquares);
    if (tracking.is_fine && !(knows_sheets && shape.is_in(kReadAtDots))) return Status::not_tracked;
    plane.at_centre_q16 = at_q16;
    if (tracking.is_fine) {
        tracking.displacement_q12 = prediction.displacement_q16 >> 4;
        return lay_out_memory(min_step_q8(plane), tracking) ? Status::ok : Status::not_tracked;
    }
    return lay_cells(prediction, plane, static_cast<std::int32_t>(shape.det_q24), tracking)
               ? Status::ok
               : Status::not_tracked;
}

}  // namespace dotpose::core
