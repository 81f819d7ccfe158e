// Bindings for calibration: lens, view and mount of a camera, and poses of adjacent sheets.
#include "dotpose/tools/calibrate.hpp"

#include <fmt/core.h>

#include "dotpose/files/code_names.hpp"
#include "dotpose/tools/draw.hpp"
#include "frames.hpp"
#include "progress.hpp"
#include "sheets.hpp"

namespace dotpose::python {
namespace {

CalibrateOptions options_of(const std::string& name, double spacing_mm) {
    CalibrateOptions options;
    const auto code = code_or_auto(name);
    options.any_code = !code;
    options.pattern.code = code.value_or(CodeVariant::anoto);
    options.pattern.spacing_mm = spacing_mm;
    options.progress = [](int, int) { return !was_interrupted(); };
    return options;
}

/// Calls `work` with the GIL released, passing the number of images and a function that returns the
/// image with a given index.
template <typename Work>
auto over(const py::iterable& images, const Work& work) {
    const std::vector<Frame> frames = frames_of(images);
    const FrameAt frame_at = [&frames](int index) {
        return pixels_of(frames[static_cast<std::size_t>(index)]);
    };
    return without_lock([&] { return work(static_cast<int>(frames.size()), frame_at); });
}

void define_lens(py::module_& module) {
    py::class_<LensCalibration>(module, "LensCalibration",
                                "A calibrated camera, with statistics of the calibration.")
        .def_readonly("camera", &LensCalibration::camera, "The Camera.")
        .def_property_readonly(
            "verdict", [](const LensCalibration& c) { return name(c.verdict); },
            "\"good\", or the reason why the result is unreliable: \"too_few_frames\", "
            "\"same_place\", "
            "\"out_of_focus\", \"corners_unseen\".")
        .def_readonly("advice", &LensCalibration::advice, "One or two sentences for the user.")
        .def_property_readonly(
            "code", [](const LensCalibration& c) { return name(c.code); }, "Code of the sheet.")
        .def_readonly("is_mounted", &LensCalibration::is_mounted,
                      "True if all frames have the same height and tilt.")
        .def_readonly("frames", &LensCalibration::frames, "Number of frames given.")
        .def_readonly("located", &LensCalibration::located,
                      "Number of different frames with a fix.")
        .def_readonly("dots", &LensCalibration::dots, "Number of dots used.")
        .def_readonly("outliers", &LensCalibration::outliers,
                      "Number of dots rejected as outliers.")
        .def_readonly("residual_before_px", &LensCalibration::residual_before_px,
                      "Rms residual per axis of a model without distortion, skew and tilt, in px.")
        .def_readonly("residual_px", &LensCalibration::residual_px, "Rms residual per axis, in px.")
        .def_readonly("px_per_spacing", &LensCalibration::px_per_spacing,
                      "Mean grid spacing over the frames, in px.")
        .def_readonly("coverage", &LensCalibration::coverage,
                      "Fraction of the image blocks that contain dots.")
        .def(
            "draw",
            [](const LensCalibration& c, const std::filesystem::path& path) {
                draw_calibration(path, c);
            },
            "path"_a, "Write a picture (SVG) of the residuals before and after calibration.");
    module.def(
        "calibrate",
        [](const py::iterable& images, const std::string& code, double spacing_mm) {
            return over(images, [options = options_of(code, spacing_mm)](int frames,
                                                                         const FrameAt& frame_at) {
                return calibrate_lens(frames, frame_at, options);
            });
        },
        "images"_a, py::kw_only(), "code"_a = "auto", "spacing_mm"_a = kDefaultSpacing_mm,
        "Return the LensCalibration of a camera, from at least 5 images of any sheet: arrays or "
        "file names.\n\n"
        "Lengths are correct if spacing_mm is the printed spacing.");
}

void define_mount(py::module_& module) {
    py::class_<SpinCalibration>(
        module, "SpinCalibration",
        "The mounting position of a camera, from a robot that turned on the spot.")
        .def_readonly("camera", &SpinCalibration::camera, "The Camera with its reference point.")
        .def_property_readonly(
            "verdict", [](const SpinCalibration& c) { return name(c.verdict); },
            "\"good\", or \"drifted\" if the robot moved while it turned.")
        .def_property_readonly(
            "offset_mm",
            [](const SpinCalibration& c) {
                return py::make_tuple(c.offset_mm.x_mm, c.offset_mm.y_mm);
            },
            "Centre of rotation relative to the paper point at the image centre, along the image "
            "axes, in mm.")
        .def_readonly("located", &SpinCalibration::located, "Number of frames with a fix.")
        .def_readonly("sigma_mm", &SpinCalibration::sigma_mm,
                      "Standard deviation of the centre per axis, in mm.")
        .def_readonly("residual_mm", &SpinCalibration::residual_mm, "Rms residual per axis, in mm.")
        .def_readonly("turn_rad", &SpinCalibration::turn_rad,
                      "Arc that contains all angles, in rad.")
        .def(
            "draw",
            [](const SpinCalibration& c, const std::filesystem::path& path) { draw_spin(path, c); },
            "path"_a, "Write a picture (SVG) of the turn.");
    py::class_<DriveCalibration>(module, "DriveCalibration",
                                 "The direction of a camera, from a straight forward drive.")
        .def_readonly("camera", &DriveCalibration::camera, "The Camera with its direction.")
        .def_readonly("located", &DriveCalibration::located, "Number of frames with a fix.")
        .def_readonly("sigma_rad", &DriveCalibration::sigma_rad,
                      "Standard deviation of the direction, in rad.")
        .def_readonly("residual_mm", &DriveCalibration::residual_mm,
                      "Rms distance from a straight line, in mm.")
        .def_readonly("length_mm", &DriveCalibration::length_mm, "Length of the drive, in mm.");
    module.def(
        "calibrate_spin",
        [](const py::iterable& images, const std::optional<Camera>& camera, const std::string& code,
           double spacing_mm) {
            const CalibrateOptions options = options_of(code, spacing_mm);
            return over(images, [&](int frames, const FrameAt& frame_at) {
                return calibrate_spin(frames, frame_at, camera, options);
            });
        },
        "images"_a, "camera"_a = py::none(), py::kw_only(), "code"_a = "auto",
        "spacing_mm"_a = kDefaultSpacing_mm,
        "Return the mounting position of the camera, from at least 3 frames of a robot that turns "
        "on the spot.");
    module.def(
        "calibrate_drive",
        [](const py::iterable& images, const std::optional<Camera>& camera, const std::string& code,
           double spacing_mm) {
            const CalibrateOptions options = options_of(code, spacing_mm);
            return over(images, [&](int frames, const FrameAt& frame_at) {
                return calibrate_drive(frames, frame_at, camera, options);
            });
        },
        "images"_a, "camera"_a = py::none(), py::kw_only(), "code"_a = "auto",
        "spacing_mm"_a = kDefaultSpacing_mm,
        "Return the direction of the camera, from frames of a straight forward drive, in order.");
    py::class_<PivotCalibration>(module, "PivotCalibration",
                                 "The tip of a pen, from frames of a pen that pivots about it.")
        .def_readonly("camera", &PivotCalibration::camera, "The Camera with its tip.")
        .def_readonly("located", &PivotCalibration::located,
                      "Number of frames with a pose in space.")
        .def_readonly("used", &PivotCalibration::used, "Number of frames with the tip at rest.")
        .def_readonly("residual_mm", &PivotCalibration::residual_mm,
                      "Rms distance of the tip from the point of rest, per axis, in mm.");
    module.def(
        "calibrate_pivot",
        [](const py::iterable& images, const Camera& camera, const std::string& code,
           double spacing_mm) {
            const CalibrateOptions options = options_of(code, spacing_mm);
            return over(images, [&](int frames, const FrameAt& frame_at) {
                return calibrate_pivot(frames, frame_at, camera, options);
            });
        },
        "images"_a, "camera"_a, py::kw_only(), "code"_a = "auto",
        "spacing_mm"_a = kDefaultSpacing_mm,
        "Return the tip of a pen, from at least 6 frames of a pen whose tip rests at one point "
        "while the pen is tilted to all sides. The camera needs a focal length.");
}

void define_stitching(py::module_& module) {
    py::class_<Stitching>(module, "Stitching", "Poses of sheets in the world.")
        .def_readonly("sheets", &Stitching::sheets, "The entries, with world poses and scales.")
        .def_readonly("unconnected", &Stitching::unconnected,
                      "Names of sheets that no frame shows together with another sheet.")
        .def_readonly("frames", &Stitching::frames, "Number of frames given.")
        .def_readonly("used", &Stitching::used, "Number of frames that show two sheets.");
    module.def(
        "stitch_sheets",
        [](const py::iterable& images, const std::vector<SheetEntry>& sheets,
           const std::optional<Camera>& camera) {
            const CalibrateOptions options = options_of("auto", kDefaultSpacing_mm);
            return over(images, [&](int frames, const FrameAt& frame_at) {
                return stitch_sheets(frames, frame_at, sheets, camera, options);
            });
        },
        "images"_a, "sheets"_a, "camera"_a = py::none(),
        "Return the poses of sheets, from images that each show parts of two sheets.");
}

}  // namespace

void define_calibrate(py::module_& module) {
    define_lens(module);
    define_mount(module);
    define_stitching(module);
}

}  // namespace dotpose::python
