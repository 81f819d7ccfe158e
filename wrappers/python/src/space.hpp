// Converts poses in space to Python objects.
#pragma once

#include "binding.hpp"
#include "dotpose/tools/space_pose.hpp"

namespace dotpose::python {

inline py::tuple position_of(const CameraInSpace& camera) {
    return py::make_tuple(camera.x_mm, camera.y_mm, camera.z_mm);
}

inline py::tuple tuple_of(const Quaternion& q) {
    return py::make_tuple(q.x, q.y, q.z, q.w);
}

inline py::array_t<double> array_of(const SpaceCovariance& covariance) {
    py::array_t<double> array({6, 6});
    auto at = array.mutable_unchecked<2>();
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j)
            at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j)) = covariance[i][j];
    }
    return array;
}

}  // namespace dotpose::python
