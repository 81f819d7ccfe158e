#include "space_apriltag.hpp"

#ifdef DOTPOSE_HAS_APRILTAG

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include <Eigen/Geometry>
#include <apriltag/apriltag_pose.h>
#include <apriltag/tag36h11.h>

#include "../bench/tag_picture.hpp"

namespace dotpose::tables {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct DestroyTags {
    void operator()(apriltag_family_t* family) const { tag36h11_destroy(family); }
    void operator()(apriltag_detector_t* detector) const { apriltag_detector_destroy(detector); }
    void operator()(zarray_t* detections) const { apriltag_detections_destroy(detections); }
    // Calls `free`, because libapriltag allocates matrices with calloc and does not export
    // `matd_destroy`.
    void operator()(matd_t* matrix) const { std::free(matrix); }
};
template <typename Value>
using Tags = std::unique_ptr<Value, DestroyTags>;

/// Returns the side of the largest square on the paper that is centred at the pose point and
/// completely in view, in mm.
double side_in_view_mm(const Shot& shot) {
    const Projection projection(shot.camera, shot.pose);
    const auto is_in_view = [&](double half_mm) {
        return std::ranges::all_of(std::array{Vec2{half_mm, half_mm}, Vec2{-half_mm, half_mm},
                                              Vec2{half_mm, -half_mm}, Vec2{-half_mm, -half_mm}},
                                   [&](const Vec2& corner) {
                                       const Vec2 pixel = projection.pixel_from_offset(corner);
                                       return pixel.x >= 1 && pixel.y >= 1 &&
                                              pixel.x <= shot.camera.width_px - 2 &&
                                              pixel.y <= shot.camera.height_px - 2;
                                   });
    };
    double inside_mm = 0;
    double outside_mm = shot.camera.width_px * shot.camera.mm_per_px;
    for (int i = 0; i < 30; ++i) {
        const double middle_mm = (inside_mm + outside_mm) / 2;
        (is_in_view(middle_mm) ? inside_mm : outside_mm) = middle_mm;
    }
    return 2 * inside_mm;
}

/// Returns the pose of the camera relative to the centre of the tag, along the axes of the pattern.
TrueSpacePose pose_of(apriltag_detection_t& tag, const CameraModel& camera, double border_mm) {
    const double focal_px = camera.working_distance_mm / camera.mm_per_px;
    // In libapriltag, the origin is the corner of the first pixel.
    apriltag_detection_info_t info = {
        &tag, border_mm, focal_px, focal_px, camera.width_px / 2.0, camera.height_px / 2.0};
    apriltag_pose_t found = {};
    estimate_tag_pose(&info, &found);
    const Tags<matd_t> rotation(found.R);
    const Tags<matd_t> shift(found.t);
    const Matrix3d camera_from_tag =
        Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation->data);
    return {-camera_from_tag.transpose() * Eigen::Map<Vector3d>(shift->data),
            camera_from_tag.transpose()};
}

}  // namespace

std::optional<SpaceVector> apriltag_error(const Shot& shot, int id) {
    constexpr int kPxPerSquare = 128;
    const Tags<apriltag_family_t> family(tag36h11_create());
    const Tags<apriltag_detector_t> detector(apriltag_detector_create());
    apriltag_detector_add_family(detector.get(), family.get());
    detector->quad_decimate = 1;

    const GreyImage printed = bench::draw_tag(*family, id, kPxPerSquare);
    const double side_mm = side_in_view_mm(shot);
    const PageImage page = {printed.view(), side_mm / printed.width_px, {side_mm / 2, side_mm / 2}};
    GreyImage image = render(page, shot.camera, shot.pose, shot.imperfections, shot.seed);
    image_u8_t view = {image.width_px, image.height_px, image.width_px, image.pixels.data()};
    const Tags<zarray_t> detections(apriltag_detector_detect(detector.get(), &view));
    if (zarray_size(detections.get()) != 1) return std::nullopt;
    apriltag_detection_t* tag = nullptr;
    zarray_get(detections.get(), 0, &tag);
    if (tag->id != id) return std::nullopt;

    const double border_mm = side_mm * family->width_at_border / family->total_width;
    const TrueSpacePose found = pose_of(*tag, shot.camera, border_mm);
    const Eigen::Quaterniond rotation(found.rotation);
    TrueSpacePose truth = true_space_pose(shot);
    truth.position_mm = -truth.rotation * Vector3d(0, 0, shot.camera.working_distance_mm);
    return space_error({found.position_mm.x(),
                        found.position_mm.y(),
                        found.position_mm.z(),
                        {rotation.w(), rotation.x(), rotation.y(), rotation.z()}},
                       truth);
}

}  // namespace dotpose::tables

#endif
