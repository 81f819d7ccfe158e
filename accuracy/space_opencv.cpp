#include "space_opencv.hpp"

#ifdef DOTPOSE_HAS_CALIB3D

#include <vector>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

namespace dotpose::tables {

calibrate::SpaceState opencv_pose(const calibrate::SpaceFit& fit, double focal_px) {
    std::vector<cv::Point3d> places;
    std::vector<cv::Point2d> pixels;
    for (const calibrate::SpaceDot& dot : fit.used) {
        const Eigen::Vector2d at = dot.intersection_mm + fit.state.displacement * dot.direction_mm;
        places.emplace_back(at.x(), at.y(), 0);
        pixels.emplace_back(dot.pixel.x(), dot.pixel.y());
    }
    const cv::Matx33d matrix(focal_px, 0, 0, 0, focal_px, 0, 0, 0, 1);
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    cv::solvePnPGeneric(places, pixels, matrix, {}, turns, shifts, false, cv::SOLVEPNP_IPPE);
    cv::solvePnPRefineLM(places, pixels, matrix, {}, turns.front(), shifts.front());
    const cv::Vec3d turn(turns.front());
    const cv::Vec3d shift(shifts.front());
    const Eigen::Vector3d vector(turn[0], turn[1], turn[2]);
    calibrate::SpaceState state;
    state.rotation = Eigen::AngleAxisd(-vector.norm(), vector.normalized()).toRotationMatrix();
    state.position_mm = -(state.rotation * Eigen::Vector3d(shift[0], shift[1], shift[2]));
    return state;
}

}  // namespace dotpose::tables

#endif
