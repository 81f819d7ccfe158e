#include <algorithm>
#include <cmath>
#include <string>

#include "simulate/ink.hpp"

namespace dotpose {
namespace simulate {
namespace {

void require(bool holds, const std::string& otherwise) {
    if (!holds) throw BadArgument(otherwise);
}

// Returns true if `value` is in the range [low, high]. Returns false for NaN.
bool within(double value, double low, double high) {
    return value >= low && value <= high;
}

void check_camera(const CameraModel& camera, const CameraPose& pose) {
    constexpr int kMaxSide_px = 16384;
    require(camera.width_px >= 1 && camera.width_px <= kMaxSide_px && camera.height_px >= 1 &&
                camera.height_px <= kMaxSide_px,
            "the image must be 1 x 1 to 16384 x 16384 px, not " + std::to_string(camera.width_px) +
                " x " + std::to_string(camera.height_px));
    require(within(camera.mm_per_px, 1e-6, 1e6), "mm per px must be above 0");
    require(within(camera.working_distance_mm, 1e-6, 1e9), "the working distance must be above 0");
    const double half_u = camera.width_px / 2.0;
    const double half_v = camera.height_px / 2.0;
    // Maximum motion during the readout, as a fraction of half the image width or height.
    constexpr double kMaxReadout = 1.5;
    require(within(camera.readout_px.x, -kMaxReadout * half_u, kMaxReadout * half_u) &&
                within(camera.readout_px.y, -kMaxReadout * half_v, kMaxReadout * half_v),
            "the motion during the readout must be at most 75 % of the image");
    // Maximum downward motion of a point, in rows, while the camera reads one row of a rotating
    // scene. A point appears only once in the image if this motion is less than one row.
    constexpr double kMaxFall = 0.95;
    require(std::abs(camera.readout_turn_rad) * half_u + std::abs(camera.readout_px.y) <=
                kMaxFall * camera.height_px,
            "the rotation during the readout is too fast for this image: the scene would overtake "
            "the rows");
    const double corner_square = half_u * half_u + half_v * half_v;
    // The lens model (paper, equation 2) is valid only if |k| r^2 is less than 1. At 1, the image
    // folds over itself if k is positive, and the undistorted position is infinite if k is
    // negative.
    require(within(camera.k * corner_square, -0.9, 0.9),
            "the distortion k is too strong for this image: |k| r^2 must stay below 0.9 in the "
            "corners");
    require(within(pose.theta_rad, -1e6, 1e6) && within(pose.fraction_x, -1e6, 1e6) &&
                within(pose.fraction_y, -1e6, 1e6),
            "the pose is not a number");
    // In the direction of the tilt, the depth of the paper increases by `slope` mm per mm of
    // sideways distance. The viewing ray of an image corner moves sideways by at most `widest` mm
    // per mm of depth. The ray meets the paper only if slope * widest is less than 1.
    const double widest = std::sqrt(corner_square) / std::min(1.0, 1 + camera.k * corner_square) *
                          camera.mm_per_px / camera.working_distance_mm;
    const double slope = std::hypot(std::tan(pose.tilt_x_rad),
                                    std::tan(pose.tilt_y_rad) / std::cos(pose.tilt_x_rad));
    require(within(pose.tilt_x_rad, -1.5, 1.5) && within(pose.tilt_y_rad, -1.5, 1.5) &&
                slope * widest < 0.9,
            "the tilt is too large: the camera would look past the paper");
}

}  // namespace

void check(const Page& page, const CameraModel& camera, const CameraPose& pose,
           const Imperfections& imperfections) {
    check_camera(camera, pose);
    const Pattern& pattern = page.pattern;
    require(page.print_scale.x > 0 && page.print_scale.y > 0, "the print scale must be above 0");
    require(pattern.spacing_mm / camera.mm_per_px >= 1, "the grid spacing must be at least 1 px");
    require(within(pattern.dot_mm, 0, 100 * pattern.spacing_mm) && pattern.dot_mm > 0,
            "the dot diameter must be above 0");
    require(within(pattern.displacement_mm, 0, pattern.spacing_mm),
            "the displacement must be 0 to 1 spacing");
    require(pattern.section.u < kSections && pattern.section.v < kSections,
            "the section must be 0 to 62");
    const Imperfections& i = imperfections;
    require(within(i.paper_level, 0, 255), "the paper level must be 0 to 255");
    for (const double fraction :
         {i.ink_reflectance, i.ink_variation, i.palest_ink, i.vignetting, i.salt_and_pepper,
          i.missing, i.texture, page.table_reflectance}) {
        require(within(fraction, 0, 1), "fractions and reflectances must be 0 to 1");
    }
    require(within(i.fall, 0, 2), "the fall of light must be 0 to 2");
    require(within(i.blur_sigma_px, 0, 100), "the blur must be 0 to 100 px");
    require(std::hypot(i.motion_px.x, i.motion_px.y) <= 100, "the motion must be 0 to 100 px");
    require(within(i.fall_direction_rad, -1e6, 1e6), "the direction of the fall is not a number");
    require(within(i.noise_sigma, 0, 1000), "the noise must be 0 to 1000 grey levels");
    require(within(i.fixed_pattern, 0, 1000), "the fixed pattern must be 0 to 1000 grey levels");
    require(within(i.jitter_mm, 0, pattern.spacing_mm), "the jitter must be 0 to 1 spacing");
    require(i.sub_pixels == 0 || i.sub_pixels == 2 || i.sub_pixels == 4 || i.sub_pixels == 8,
            "`sub_pixels` must be 0, 2, 4 or 8");
    require(within(i.dirt_blobs, 0, 1e6) && within(i.graphics, 0, 1e6),
            "counts must be 0 to a million");
}

}  // namespace simulate

GreyImage render(const Page& page, const CameraModel& camera, const CameraPose& pose,
                 const Imperfections& imperfections, std::uint64_t seed) {
    simulate::check(page, camera, pose, imperfections);
    const simulate::View view(camera, pose, imperfections);
    Rng rng(seed);
    simulate::Ink ink;
    simulate::add_dots(ink, view, page, imperfections, simulate::code_of(page.pattern));
    simulate::add_graphics(ink, view, imperfections, rng);
    simulate::add_dirt(ink, view, page.pattern.dot_mm, imperfections, rng);
    return simulate::read_out(simulate::expose(ink, view, page, imperfections), camera,
                              imperfections, rng);
}

GreyImage render(const Pattern& pattern, const CameraModel& camera, const CameraPose& pose,
                 const Imperfections& imperfections, std::uint64_t seed) {
    Page page;
    page.pattern = pattern;
    return render(page, camera, pose, imperfections, seed);
}

GreyImage render(const PageImage& page, const CameraModel& camera, const CameraPose& pose,
                 const Imperfections& imperfections, std::uint64_t seed) {
    simulate::check({}, camera, pose, imperfections);
    simulate::require(page.mm_per_px > 0, "the pixels of the page must have a size");
    Rng rng(seed);
    return simulate::read_out(
        simulate::expose(page, simulate::View(camera, pose, imperfections), imperfections), camera,
        imperfections, rng);
}

GreyImage render(const Shot& shot) {
    return render(shot.page, shot.camera, shot.pose, shot.imperfections, shot.seed);
}

}  // namespace dotpose
