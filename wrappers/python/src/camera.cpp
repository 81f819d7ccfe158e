// Bindings for cameras: their lens, view and mount.
#include "dotpose/files/camera.hpp"

#include <array>

#include <fmt/core.h>

#include "binding.hpp"

namespace dotpose::python {
namespace {

using Pair = std::array<double, 2>;

/// Defines a property whose value is an image point (u, v).
template <typename Member>
void define_point(py::class_<Camera>& camera, const char* name, Member member, const char* doc) {
    camera.def_property(
        name, [member](const Camera& c) { return py::make_tuple((c.*member).u, (c.*member).v); },
        [member](Camera& c, const Pair& point) {
            c.*member = {point[0], point[1]};
        },
        doc);
}

/// Applies `map`, a function of a single point, to each row of an n x 2 array of points.
template <typename Map>
py::array_t<double> mapped(
    const Camera& camera,
    const py::array_t<double, py::array::c_style | py::array::forcecast>& points, const Map& map) {
    if (points.ndim() != 2 || points.shape(1) != 2) {
        throw py::type_error("points are an array of the shape (n, 2)");
    }
    py::array_t<double> result({points.shape(0), py::ssize_t{2}});
    const auto from = points.unchecked<2>();
    auto to = result.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < points.shape(0); ++i) {
        const PixelPoint point = map(camera, PixelPoint{from(i, 0), from(i, 1)});
        to(i, 0) = point.u;
        to(i, 1) = point.v;
    }
    return result;
}

Camera new_camera(int width_px, int height_px, double k_per_px2,
                  const std::optional<Pair>& centre_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    camera.k_per_px2 = k_per_px2;
    camera.centre_px = centre_px ? PixelPoint{(*centre_px)[0], (*centre_px)[1]}
                                 : PixelPoint{(width_px - 1) / 2.0, (height_px - 1) / 2.0};
    validate(camera);
    return camera;
}

py::object reference(const Camera& camera) {
    if (!camera.reference_px) return py::none();
    return py::make_tuple(camera.reference_px->u, camera.reference_px->v);
}

void define_view(py::module_& module) {
    py::class_<PaperScale>(
        module, "PaperScale",
        "The map from the undistorted image to the paper, for a camera at a fixed height.")
        .def_readwrite("mm_per_px_x", &PaperScale::mm_per_px_x, "Scale along x, in mm per px.")
        .def_readwrite("mm_per_px_y", &PaperScale::mm_per_px_y, "Scale along y, in mm per px.")
        .def_readwrite("skew", &PaperScale::skew,
                       "Shift of each row relative to the next, in px per px.")
        .def_readwrite("perspective_u", &PaperScale::perspective_u, "Perspective, per px.")
        .def_readwrite("perspective_v", &PaperScale::perspective_v, "Perspective, per px.");
    py::class_<Tilt>(module, "Tilt", "Tilt of the paper relative to the image plane.")
        .def_readwrite("x_rad", &Tilt::x_rad, "About the image x axis, in rad.")
        .def_readwrite("y_rad", &Tilt::y_rad, "About the image y axis, in rad.");
    py::class_<PenTip>(
        module, "PenTip",
        "Tip of a pen in the frame of its camera: x right and y down in the image, z "
        "forward.")
        .def(py::init<double, double, double, double>(), "x_mm"_a, "y_mm"_a, "z_mm"_a,
             "rest_mm"_a = 0.0, "Make a tip.")
        .def_readwrite("x_mm", &PenTip::x_mm, "x, in mm.")
        .def_readwrite("y_mm", &PenTip::y_mm, "y, in mm.")
        .def_readwrite("z_mm", &PenTip::z_mm, "z, in mm.")
        .def_readwrite("rest_mm", &PenTip::rest_mm,
                       "Measured height of the tip while the pen rests on the paper, in mm.");
}

}  // namespace

void define_camera(py::module_& module) {
    define_view(module);
    py::class_<Camera> camera(module, "Camera",
                              "The optics of a camera, its view of the paper and its mount on a "
                              "robot: the content of a camera file.");
    camera
        .def(py::init(&new_camera), "width_px"_a, "height_px"_a, "k_per_px2"_a = 0.0,
             "centre_px"_a = py::none(),
             "Make a camera from a lens: k in 1/px^2, negative for barrel distortion, about a "
             "centre (u, v) in px, by default the image centre.")
        .def_static(
            "read",
            [](const std::filesystem::path& path) {
                return tools_for("Camera.read").attr("_read_camera")(path);
            },
            "path"_a, "Return the camera of a camera file, or of a camera_info file of ROS.")
        .def(
            "write",
            [](const Camera& self, const std::filesystem::path& path) {
                tools_for("Camera.write").attr("_write_camera")(path, self);
            },
            "path"_a, "Write a camera file atomically.")
        .def_readwrite("width_px", &Camera::width_px, "Width of the images, in px.")
        .def_readwrite("height_px", &Camera::height_px, "Height of the images, in px.")
        .def_readwrite("k_per_px2", &Camera::k_per_px2,
                       "Radial distortion, in 1/px^2; negative for barrel distortion.")
        .def_readwrite("paper", &Camera::paper,
                       "View of the paper of a mounted camera; None for a hand-held camera.")
        .def_readwrite("focal_px", &Camera::focal_px, "Focal length, in px; None if unknown.")
        .def_readwrite("tilt", &Camera::tilt, "Tilt of a mounted camera; None if unknown.")
        .def_property(
            "reference_px", &reference,
            [](Camera& c, const std::optional<Pair>& point) {
                c.reference_px.reset();
                if (point) c.reference_px = PixelPoint{(*point)[0], (*point)[1]};
            },
            "Reference point of the pose, as an undistorted pixel (u, v); None for the image "
            "centre.")
        .def_readwrite("theta_offset_rad", &Camera::theta_offset_rad,
                       "Heading of the robot minus the angle of the image x axis, in rad.")
        .def_readwrite("tip", &Camera::tip,
                       "PenTip of the pen that contains the camera; None if the camera is not in "
                       "a pen.")
        .def_readwrite("flip", &Camera::flip,
                       "True if frames must be flipped, left to right, before they are located: "
                       "image[:, ::-1].")
        .def_readwrite("flat_field", &Camera::flat_field,
                       "Brightness of white paper in the image, relative to the brightest point: "
                       "a list of rows of equally spaced values; empty if even or unknown. To "
                       "change it, assign a modified copy.")
        .def_readwrite(
            "readout_ms", &Camera::readout_ms,
            "Time from the first to the last row of a rolling shutter, in ms; None for a "
            "global shutter.")
        .def_readwrite("exposure_us", &Camera::exposure_us, "Exposure, in us.")
        .def_readwrite("gain", &Camera::gain, "Gain of the sensor.")
        .def_readwrite("sigma", &Camera::sigma,
                       "Standard deviations from a calibration, with the keys of the camera file.")
        .def(
            "undistorted",
            [](const Camera& self,
               const py::array_t<double, py::array::c_style | py::array::forcecast>& points) {
                return mapped(self, points, &dotpose::undistorted);
            },
            "points"_a, "Return the undistorted positions of pixels (u, v): n x 2 arrays.")
        .def(
            "distorted",
            [](const Camera& self,
               const py::array_t<double, py::array::c_style | py::array::forcecast>& points) {
                return mapped(self, points, &dotpose::distorted);
            },
            "points"_a,
            "Return the pixels of this camera for undistorted positions (u, v): n x 2 arrays.")
        .def("__repr__", [](const Camera& self) {
            return fmt::format("<Camera {} x {} px, k {:.4g} per px^2>", self.width_px,
                               self.height_px, self.k_per_px2);
        });
    define_point(camera, "centre_px", &Camera::centre_px,
                 "Centre (u, v) of the distortion, in px.");
}

}  // namespace dotpose::python
