#include "space_opencv.hpp"

#ifdef DOTPOSE_HAS_CALIB3D

#include <vector>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

#include "calibrate/located_frame.hpp"

namespace dotpose::tables {

CameraInSpace opencv_pose(const Fix& fix, const Camera& camera, const Trace& trace) {
    const double mm = fix.spacing_mm();
    const double displacement = fix.displacement_q16 / 65536.0;
    std::vector<cv::Point3d> places;
    std::vector<cv::Point2d> pixels;
    for (const calibrate::LocatedDot& dot : calibrate::dots_read(trace)) {
        places.emplace_back((dot.step.x + displacement * dx(dot.symbol)) * mm,
                            (dot.step.y + displacement * dy(dot.symbol)) * mm, 0);
        pixels.emplace_back(dot.pixel.u, dot.pixel.v);
    }
    const double focal_px = *camera.focal_px;
    const cv::Matx33d matrix(focal_px, 0, camera.centre_px.u, 0, focal_px, camera.centre_px.v, 0, 0,
                             1);
    std::vector<cv::Mat> turns;
    std::vector<cv::Mat> shifts;
    cv::solvePnPGeneric(places, pixels, matrix, {}, turns, shifts, false, cv::SOLVEPNP_IPPE);
    cv::solvePnPRefineLM(places, pixels, matrix, {}, turns.front(), shifts.front());
    const cv::Vec3d turn(turns.front());
    const cv::Vec3d shift(shifts.front());
    const Eigen::Vector3d vector(turn[0], turn[1], turn[2]);
    const Eigen::Quaterniond rotation(
        Eigen::AngleAxisd(-vector.norm(), vector.normalized()));  // camera to pattern
    const Eigen::Vector3d position = -(rotation * Eigen::Vector3d(shift[0], shift[1], shift[2]));
    const Cell start = trace.decoding.place.cell;
    return {position.x() + mm * start.x,
            position.y() + mm * start.y,
            position.z(),
            {rotation.w(), rotation.x(), rotation.y(), rotation.z()}};
}

}  // namespace dotpose::tables

#endif
