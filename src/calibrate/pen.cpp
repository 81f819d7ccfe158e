// Computes the position and height of the tip of a pen.
#include "dotpose/tools/pen.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace dotpose {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d cross_matrix(const Vector3d& v) {
    Matrix3d result;
    result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return result;
}

/// Returns the covariance of the tip in the camera frame.
Matrix3d tip_covariance(const std::map<std::string, double>& sigma) {
    Vector3d variances = Vector3d::Zero();
    Eigen::Index i = 0;
    for (const char* key : {"tip_x_mm", "tip_y_mm", "tip_z_mm"}) {
        const auto found = sigma.find(key);
        if (found != sigma.end()) variances[i] = found->second * found->second;
        ++i;
    }
    return variances.asDiagonal();
}

}  // namespace

double TipPose::sigma_mm(std::size_t axis) const {
    return std::sqrt(covariance[axis][axis]);
}

TipPose tip_of(const SpacePose& pose, const PenTip& tip,
               const std::map<std::string, double>& sigma) {
    const Quaternion& q = pose.camera.rotation;
    const Matrix3d rotation = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
    const Vector3d in_camera(tip.x_mm, tip.y_mm, tip.z_mm);
    const Vector3d turned = rotation * in_camera;
    Eigen::Matrix<double, 3, 6> by_pose;
    by_pose << Matrix3d::Identity(), -rotation * cross_matrix(in_camera);
    Eigen::Matrix<double, 6, 6> pose_covariance;
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            pose_covariance(Eigen::Index(i), Eigen::Index(j)) = pose.covariance[i][j];
    }
    Matrix3d covariance = by_pose * pose_covariance * by_pose.transpose() +
                          rotation * tip_covariance(sigma) * rotation.transpose();
    // The height is positive above the paper, whereas z points into the paper.
    const Vector3d signs(1, 1, -1);
    covariance = signs.asDiagonal() * covariance * signs.asDiagonal();
    TipPose result{pose.camera.x_mm + turned.x(),
                   pose.camera.y_mm + turned.y(),
                   -(pose.camera.z_mm + turned.z()) - tip.rest_mm,
                   {}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            result.covariance[i][j] = covariance(Eigen::Index(i), Eigen::Index(j));
    }
    return result;
}

TipPose on_sheet(const TipPose& tip, const SheetEntry& entry) {
    const CameraInSpace place = on_sheet(CameraInSpace{tip.x_mm, tip.y_mm, 0, {}}, entry);
    TipPose result = tip;
    result.x_mm = place.x_mm;
    result.y_mm = place.y_mm;
    return result;
}

bool PenContact::take(double height_mm, double sigma_mm) {
    is_down_ = height_mm < kLift_mm + (is_down_ ? 3 * sigma_mm : 0);
    return is_down_;
}

}  // namespace dotpose
