#include "locate/pale.hpp"

#include "core/detect/undistort.hpp"
#include "core/math/plane.hpp"

namespace dotpose::core {
namespace {

/// Returns the grey level at a point on the paper, or -1 if the point is outside the image.
int level_at(const ImageView& image, const FixedLens& lens, const PlaneFromImage& plane,
             FixedVec point_q16) {
    const FixedVec at_q8 = distorted_point_q8(lens, plane, point_q16) + FixedVec{128, 128};
    const std::int32_t u = at_q8.x >> 8;
    const std::int32_t v = at_q8.y >> 8;
    if (u < 0 || v < 0 || u >= image.width_px || v >= image.height_px) return -1;
    return image.row(v)[u];
}

}  // namespace

bool is_pale(const ImageView& image, const DeviceOptions& options, CodeVariant code,
             const Fix& fix) {
    constexpr std::int32_t kReach_cells = 10;
    constexpr std::int32_t kSpacing_q16 = 1 << 16;
    if (options.min_contrast == 0) return false;
    const PlaneFromImage& plane = fix.pattern_from_image;
    const FixedVec middle{plane.at_centre_q16.x >> 16, plane.at_centre_q16.y >> 16};
    int contrast = 0;
    int dots = 0;
    for (std::int32_t j = middle.y - kReach_cells; j <= middle.y + kReach_cells; ++j) {
        for (std::int32_t i = middle.x - kReach_cells; i <= middle.x + kReach_cells; ++i) {
            const Place place = moved(code, fix.place, i, j);
            const Symbol symbol = symbol_at(code, place.cell, place.section);
            const FixedVec cell_q16{i * kSpacing_q16, j * kSpacing_q16};
            const FixedVec dot_q16 = cell_q16 + FixedVec{dx(symbol) * fix.displacement_q16,
                                                         dy(symbol) * fix.displacement_q16};
            // The grey level of the paper is sampled midway between four intersections, where there
            // is no dot.
            const FixedVec paper_q16 = cell_q16 + FixedVec{kSpacing_q16 / 2, kSpacing_q16 / 2};
            const int ink = level_at(image, options.lens, plane, dot_q16);
            const int paper = level_at(image, options.lens, plane, paper_q16);
            if (ink < 0 || paper < 0) continue;
            contrast += paper - ink;
            ++dots;
        }
    }
    return contrast < options.min_contrast * dots;
}

}  // namespace dotpose::core
