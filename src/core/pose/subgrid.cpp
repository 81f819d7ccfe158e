#include "core/pose/subgrid.hpp"

#include "core/math/plane.hpp"

namespace dotpose::core {

PlaneFromImage upright_plane(const PlaneFromImage& grid_from_image, QuarterTurn pattern_from_grid) {
    PlaneFromImage pattern = grid_from_image;
    pattern.at_centre_q16 = pattern_from_grid(grid_from_image.at_centre_q16);
    pattern.du_q24 = pattern_from_grid(grid_from_image.du_q24);
    pattern.dv_q24 = pattern_from_grid(grid_from_image.dv_q24);
    return pattern;
}

namespace {

/// Writes the pose at the centre of an affine plane to `fix`.
void write_pose(const PlaneFromImage& there, CodeVariant code, const Place& place, Fix& fix) {
    // The pose is the decoded position plus the vector from there to the reference point, in
    // spacings (paper, equations 10-12).
    const FixedVec t = there.at_centre_q16;
    const Place at = moved(code, place, t.x >> 16, t.y >> 16);
    fix.cell = at.cell;
    fix.section = at.section;
    fix.fraction_x_q16 = static_cast<std::uint16_t>(t.x & 0xFFFF);
    fix.fraction_y_q16 = static_cast<std::uint16_t>(t.y & 0xFFFF);
    const FixedVec du = there.du_q24;
    fix.theta_bam = angle_bam(du);
    // The spacing in px is 1 / |du|. The divisor is clamped, because |du| may be almost 0 at a
    // reference point far outside the image.
    const auto du_length_q24 = square_root(static_cast<std::uint64_t>(squared(du)));
    const std::int64_t spacing_q16 =
        (std::int64_t{1} << 40) / std::max<std::uint32_t>(du_length_q24, 1U);
    fix.spacing_px_q16 = static_cast<std::int32_t>(std::min<std::int64_t>(spacing_q16, INT32_MAX));
}

}  // namespace

void write_pose(const PlaneFromImage& pattern_from_image, FixedVec reference_q8, CodeVariant code,
                const Place& place, Fix& fix) {
    fix.pattern_from_image = pattern_from_image;
    fix.place = place;
    write_pose(tangent(pattern_from_image, reference_q8), code, place, fix);
}

void write_affine_pose(const PlaneFromImage& pattern_from_image, FixedVec reference_q8,
                       CodeVariant code, const Place& place, Fix& fix) {
    fix.pattern_from_image = pattern_from_image;
    fix.place = place;
    write_pose(affine_tangent(pattern_from_image, reference_q8), code, place, fix);
}

}  // namespace dotpose::core
