// Bindings for SpacePose: poses of cameras in space.
#include "space.hpp"

#include <fmt/core.h>

#include "dotpose/tools/pen.hpp"
#include "dotpose/tools/space_pose.hpp"
#include "sheets.hpp"

namespace dotpose::python {
namespace {

/// Returns the camera's pose in the world, computed from its pose on the page of `entry`. Returns
/// none if the page has no pose in the world.
std::optional<CameraInWorld> in_world_of(const SpacePose& pose, const SheetEntry& entry) {
    if (!entry.world) return std::nullopt;
    return in_world(on_sheet(pose.camera, entry), pose.covariance, *entry.world);
}

void define_world_pose(py::module_& module) {
    py::class_<CameraInWorld>(module, "WorldSpacePose",
                              "Pose of a camera in the world: m, y up, z out of the paper.")
        .def_property_readonly(
            "position_m",
            [](const CameraInWorld& c) { return py::make_tuple(c.x_m, c.y_m, c.z_m); },
            "Position (x, y, z) of the projection centre, in m.")
        .def_property_readonly(
            "quaternion", [](const CameraInWorld& c) { return tuple_of(c.rotation); },
            "Rotation (x, y, z, w) from the camera frame to the world.")
        .def_property_readonly(
            "covariance", [](const CameraInWorld& c) { return array_of(c.covariance); },
            "Covariance of the position, in m, and of a small rotation vector about the axes of "
            "the world, in rad, 6 x 6.");
}

void define_tip(py::module_& module) {
    py::class_<TipPose>(module, "TipPose",
                        "Position of the tip of a pen, in the pattern frame or on a page.")
        .def_readonly("x_mm", &TipPose::x_mm, "x, in mm.")
        .def_readonly("y_mm", &TipPose::y_mm, "y, downwards, in mm.")
        .def_readonly("height_mm", &TipPose::height_mm,
                      "Height above the paper, in mm; 0 while the pen rests on the paper.")
        .def_property_readonly(
            "covariance",
            [](const TipPose& tip) {
                py::array_t<double> array({3, 3});
                auto at = array.mutable_unchecked<2>();
                for (std::size_t i = 0; i < 3; ++i) {
                    for (std::size_t j = 0; j < 3; ++j) {
                        at(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(j)) =
                            tip.covariance[i][j];
                    }
                }
                return array;
            },
            "Covariance of x, y and the height, in mm^2, 3 x 3.")
        .def(
            "on_sheet",
            [](const TipPose& tip, const SheetEntry& entry) { return on_sheet(tip, entry); },
            "entry"_a, "TipPose relative to the top left corner of a page.");
}

}  // namespace

void define_space(py::module_& module) {
    define_world_pose(module);
    define_tip(module);
    py::class_<SpacePose>(
        module, "SpacePose",
        "Pose of a camera in space. Frames: pattern, x right, y DOWN, z INTO the paper, mm; "
        "camera, x right and y down in the image, z forward.")
        .def_property_readonly(
            "position_mm", [](const SpacePose& p) { return position_of(p.camera); },
            "Position (x, y, z) of the projection centre in the pattern frame, in mm; z is "
            "negative above the paper.")
        .def_property_readonly(
            "quaternion", [](const SpacePose& p) { return tuple_of(p.camera.rotation); },
            "Rotation (x, y, z, w) from the camera frame to the pattern frame.")
        .def_property_readonly(
            "tilt_rad", [](const SpacePose& p) { return lean_of(p.camera.rotation).tilt_rad; },
            "Angle between the optical axis and the normal of the paper, in rad.")
        .def_property_readonly(
            "azimuth_rad",
            [](const SpacePose& p) { return lean_of(p.camera.rotation).azimuth_rad; },
            "Direction on the paper in which the camera leans, clockwise, in rad.")
        .def_property_readonly(
            "turn_rad", [](const SpacePose& p) { return lean_of(p.camera.rotation).turn_rad; },
            "Angle of the image x axis on the paper after removal of the tilt, clockwise, in rad.")
        .def_property_readonly(
            "covariance", [](const SpacePose& p) { return array_of(p.covariance); },
            "Covariance of the position, in mm, and of a small rotation vector in the camera "
            "frame, in rad, 6 x 6.")
        .def_readonly("dots", &SpacePose::dots, "Number of dots used.")
        .def_readonly("residual_px", &SpacePose::residual_px,
                      "Root mean square residual of these dots, per axis, in px.")
        .def_property_readonly("is_ambiguous", &SpacePose::is_ambiguous,
                               "True if the dots do not exclude the second pose.")
        .def_property_readonly(
            "second",
            [](const SpacePose& p) -> std::optional<py::tuple> {
                if (!p.second) return std::nullopt;
                return py::make_tuple(position_of(p.second->camera),
                                      tuple_of(p.second->camera.rotation), p.second->odds_log2);
            },
            "Position in mm, quaternion, and log2 of the odds of the second pose that explains the "
            "view; None if there is none.")
        .def(
            "on_sheet",
            [](const SpacePose& p, const SheetEntry& entry) {
                return position_of(on_sheet(p.camera, entry));
            },
            "entry"_a, "Position (x, y, z) relative to the top left corner of a page, in mm.")
        .def("in_world", &in_world_of, "entry"_a,
             "WorldSpacePose for the page of an entry; None if the page has no pose in the world.")
        .def("__repr__", [](const SpacePose& p) {
            return fmt::format("<SpacePose ({:.3f}, {:.3f}, {:.3f}) mm, tilt {:.4f} rad>",
                               p.camera.x_mm, p.camera.y_mm, p.camera.z_mm,
                               lean_of(p.camera.rotation).tilt_rad);
        });
}

}  // namespace dotpose::python
