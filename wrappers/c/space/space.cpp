// Poses in space for C. Exceptions thrown by the C++ library are converted to statuses.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "dotpose/tools/pen.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "dotpose_space.h"
#include "structs.hpp"

namespace {

using namespace dotpose;
using c::check_size;
using c::init;

/// Converts a camera. Throws BadArgument if a value is out of range.
Camera camera_of(const dotpose_space_camera& given) {
    Camera camera;
    camera.width_px = given.width_px;
    camera.height_px = given.height_px;
    camera.k_per_px2 = given.lens_k_per_px2;
    camera.centre_px = {given.lens_centre_u_px, given.lens_centre_v_px};
    camera.pinhole =
        Pinhole{given.focal_u_px, given.focal_v_px, {given.axis_u_px, given.axis_v_px}};
    if (!(given.print_scale > 0.1 && given.print_scale < 10)) throw BadArgument("print_scale");
    validate(camera);
    return camera;
}

void copy(const Quaternion& q, double* xyzw) {
    xyzw[0] = q.x;
    xyzw[1] = q.y;
    xyzw[2] = q.z;
    xyzw[3] = q.w;
}

void give(const SpacePose& pose, dotpose_space_pose& result) {
    init(&result, sizeof result);
    result.dots = pose.dots;
    result.is_ambiguous = pose.is_ambiguous() ? 1 : 0;
    result.has_second = pose.second ? 1 : 0;
    result.x_mm = pose.camera.x_mm;
    result.y_mm = pose.camera.y_mm;
    result.z_mm = pose.camera.z_mm;
    copy(pose.camera.rotation, result.quaternion_xyzw);
    const CameraLean lean = lean_of(pose.camera.rotation);
    result.tilt_rad = lean.tilt_rad;
    result.azimuth_rad = lean.azimuth_rad;
    result.turn_rad = lean.turn_rad;
    double* next = result.covariance_mm_rad;
    for (const auto& row : pose.covariance)
        next = std::copy(row.begin(), row.end(), next);
    result.residual_px = pose.residual_px;
    if (!pose.second) return;
    const CameraInSpace& second = pose.second->camera;
    result.second_odds = std::exp2(pose.second->odds_log2);
    result.second_position_mm[0] = second.x_mm;
    result.second_position_mm[1] = second.y_mm;
    result.second_position_mm[2] = second.z_mm;
    copy(second.rotation, result.second_quaternion_xyzw);
}

dotpose_status check_image(const ImageView& image, const dotpose_space_camera& camera) {
    if (image.pixels == nullptr) return DOTPOSE_NULL_POINTER;
    if (image.width_px != camera.width_px || image.height_px != camera.height_px)
        return DOTPOSE_BAD_VALUE;
    const bool overlaps =
        image.stride_bytes > -image.width_px && image.stride_bytes < image.width_px;
    return overlaps ? DOTPOSE_BAD_STRIDE : DOTPOSE_OK;
}

/// Converts the position, rotation and covariance of a pose. The other members keep their default
/// values.
SpacePose to_core(const dotpose_space_pose& given) {
    SpacePose pose;
    const double* q = given.quaternion_xyzw;
    pose.camera = {given.x_mm, given.y_mm, given.z_mm, {q[3], q[0], q[1], q[2]}};
    const double* next = given.covariance_mm_rad;
    for (auto& row : pose.covariance) {
        std::copy_n(next, row.size(), row.begin());
        next += row.size();
    }
    return pose;
}

}  // namespace

dotpose_status c::fit_space(const dotpose_locator* locator, const dotpose_space_camera* camera,
                            const ImageView& image, const MapPage* map, dotpose_space_pose* pose) {
    dotpose_status status = check_locator(locator);
    if (status == DOTPOSE_OK) status = check_size(camera);
    if (status == DOTPOSE_OK) status = check_size(pose);
    if (status == DOTPOSE_OK) status = check_image(image, *camera);
    if (status != DOTPOSE_OK) return status;
    return without_exceptions([&] {
        const Camera view = camera_of(*camera);
        const Trace trace = locator->locator->trace();
        if (!trace.fix || trace.fix.spacing_nm <= 0) return DOTPOSE_NO_FIX;
        const AxisScale print = {camera->print_scale, camera->print_scale};
        const auto found = space_pose(trace.fix, view, image, trace, print, map);
        if (!found) return DOTPOSE_TOO_FEW_DOTS;
        give(*found, *pose);
        return DOTPOSE_OK;
    });
}

extern "C" {

dotpose_status dotpose_space_camera_init(dotpose_space_camera* camera, size_t bytes,
                                         int32_t width_px, int32_t height_px, double focal_px) {
    const dotpose_status status = init(camera, bytes);
    if (status != DOTPOSE_OK) return status;
    camera->width_px = width_px;
    camera->height_px = height_px;
    camera->focal_u_px = camera->focal_v_px = focal_px;
    camera->axis_u_px = camera->lens_centre_u_px = (width_px - 1) / 2.0;
    camera->axis_v_px = camera->lens_centre_v_px = (height_px - 1) / 2.0;
    camera->print_scale = 1;
    return DOTPOSE_OK;
}

dotpose_status dotpose_space_use_camera(const dotpose_space_camera* camera,
                                        dotpose_options* options) {
    const dotpose_status status = check_size(camera);
    if (status != DOTPOSE_OK) return status;
    if (options == nullptr) return DOTPOSE_NULL_POINTER;
    options->lens_k_per_px2 = camera->lens_k_per_px2;
    options->lens_centre_dx_px = camera->lens_centre_u_px - (camera->width_px - 1) / 2.0;
    options->lens_centre_dy_px = camera->lens_centre_v_px - (camera->height_px - 1) / 2.0;
    options->show_stages = 1;
    return DOTPOSE_OK;
}

dotpose_status dotpose_space_pose_init(dotpose_space_pose* pose, size_t bytes) {
    return init(pose, bytes);
}

dotpose_status dotpose_space_fit(const dotpose_locator* locator, const dotpose_space_camera* camera,
                                 const uint8_t* pixels, int32_t width_px, int32_t height_px,
                                 ptrdiff_t stride_bytes, dotpose_space_pose* pose) {
    return c::fit_space(locator, camera, {pixels, width_px, height_px, stride_bytes}, nullptr,
                        pose);
}

dotpose_status dotpose_space_pen_init(dotpose_space_pen* pen, size_t bytes) {
    return init(pen, bytes);
}

dotpose_status dotpose_space_tip_init(dotpose_space_tip* tip, size_t bytes) {
    return init(tip, bytes);
}

dotpose_status dotpose_space_tip_of(const dotpose_space_pose* pose, const dotpose_space_pen* pen,
                                    dotpose_space_tip* tip) {
    dotpose_status status = check_size(pose);
    if (status == DOTPOSE_OK) status = check_size(pen);
    if (status == DOTPOSE_OK) status = check_size(tip);
    if (status != DOTPOSE_OK) return status;
    if (pose->dots <= 0) return DOTPOSE_NO_FIX;
    const std::array values = {pen->x_mm,        pen->y_mm,        pen->z_mm,       pen->rest_mm,
                               pen->sigma_mm[0], pen->sigma_mm[1], pen->sigma_mm[2]};
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (!std::all_of(values.begin(), values.end(), is_finite)) return DOTPOSE_BAD_VALUE;
    return c::without_exceptions([&] {
        const TipPose found =
            tip_of(to_core(*pose), PenTip{pen->x_mm, pen->y_mm, pen->z_mm, pen->rest_mm},
                   {{"tip_x_mm", pen->sigma_mm[0]},
                    {"tip_y_mm", pen->sigma_mm[1]},
                    {"tip_z_mm", pen->sigma_mm[2]}});
        tip->x_mm = found.x_mm;
        tip->y_mm = found.y_mm;
        tip->height_mm = found.height_mm;
        double* next = tip->covariance_mm2;
        for (const auto& row : found.covariance)
            next = std::copy(row.begin(), row.end(), next);
        return DOTPOSE_OK;
    });
}

dotpose_status dotpose_space_update_contact(const dotpose_space_tip* tip, int32_t* is_down) {
    const dotpose_status status = check_size(tip);
    if (status != DOTPOSE_OK) return status;
    if (is_down == nullptr) return DOTPOSE_NULL_POINTER;
    PenContact contact(*is_down != 0);
    *is_down = contact.take(tip->height_mm, std::sqrt(tip->covariance_mm2[8])) ? 1 : 0;
    return DOTPOSE_OK;
}
}
