#include "locator.hpp"

#include <chrono>

#include "dotpose/files/code_names.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/option_names.hpp"
#include "dotpose/files/sheet.hpp"
#include "image.hpp"
#include "rounded.hpp"

namespace dotpose::python {
namespace {

/// Returns true if two fixes of a frame have the same status, number of dots, position and angle.
/// If there is no pose, compares only the status and the number of dots.
bool are_alike(const Fix& a, const Fix& b) {
    return a.status == b.status && a.dots_seen == b.dots_seen &&
           (a.status != Status::ok ||
            (a.cell == b.cell && a.theta_bam == b.theta_bam &&
             a.fraction_x_q16 == b.fraction_x_q16 && a.fraction_y_q16 == b.fraction_y_q16));
}

std::int32_t offset_q8(double px, int side_px) {
    return rounded((px - (side_px - 1) / 2.0) * 256);
}

}  // namespace

PyLocator::PyLocator(const LocatorSetup& setup)
    : setup_(setup), locator_(setup.options), options_(setup.options) {
    if (setup.code) options_.code = *setup.code;
}

void PyLocator::use_options_for(int width_px, int height_px) {
    if (width_px == width_px_ && height_px == height_px_) return;
    DeviceOptions options = setup_.options;
    options.code = options_.code;
    if (setup_.camera) use_camera(*setup_.camera, width_px, height_px, options);
    if (setup_.reference_px) {
        options.reference_dx_q8 = offset_q8(setup_.reference_px->u, width_px);
        options.reference_dy_q8 = offset_q8(setup_.reference_px->v, height_px);
    }
    options.show_stages |= setup_.keep_stages;
    options_ = options;
    width_px_ = width_px;
    height_px_ = height_px;
    locator_.set_options(options_);
}

void PyLocator::set_options(CodeVariant code, bool show_stages) {
    DeviceOptions options = options_;
    options.code = code;
    options.show_stages |= show_stages;
    int& bits_per_error = options.integrity.bits_per_error;
    if (bits_per_error == kMeasuredErrorRate) bits_per_error = newest_.bits_per_error;
    locator_.set_options(options);
}

CodeReading PyLocator::read(const ImageView& image, const Request& request) {
    CodeReading reading;
    if (request.motion && setup_.code) {
        reading.code = *setup_.code;
        reading.fix = locator_.locate(image, *request.motion);
    } else if (request.motion) {
        reading = locator_.locate_in_any_code(image, *request.motion, request.evidence);
    } else if (setup_.code) {
        reading.code = *setup_.code;
        reading.fix = request.expected ? locator_.locate(image, request.expected->prediction)
                                       : locator_.locate(image);
    } else if (request.expected) {
        reading =
            locator_.locate_in_any_code(image, request.expected->prediction, request.evidence);
    } else {
        reading = locator_.locate_in_any_code(image, request.evidence);
    }
    return reading;
}

PyFix PyLocator::locate_locked(const ImageView& image,
                               const std::optional<SeenPrediction>& expected,
                               const std::optional<MeasuredMotion>& motion) {
    use_options_for(image.width_px, image.height_px);
    ++newest_.number;
    newest_.evidence = evidence_;
    newest_.code = locator_.options().code;
    newest_.expected = expected;
    newest_.motion = motion;
    newest_.bits_per_error = error_rate_.bits_per_error();
    const bool is_measured = options_.integrity.bits_per_error == kMeasuredErrorRate;
    const bool is_other_code = expected && !setup_.code && expected->code != newest_.code;
    if (is_other_code) newest_.code = expected->code;
    if (is_other_code || is_measured) set_options(newest_.code, false);
    const CodeReading reading = read(image, newest_);
    error_rate_.add(locator_.compared_bits());
    newest_.fix = reading.fix;
    if (!setup_.code) evidence_ = reading.evidence;
    PyFix seen = seen_fix(reading);
    if (setup_.with_camera != nullptr)
        seen.fix = setup_.with_camera(seen.fix, *setup_.camera, locator_.trace());
    if (seen.fix.status == Status::bad_argument) seen.fault = fault_text(locator_.options());
    seen.reference_q8 = {options_.reference_dx_q8, options_.reference_dy_q8};
    seen.number = newest_.number;
    if (setup_.keep_stages) seen.stages = std::make_shared<Stages>(image, locator_.trace());
    return seen;
}

PyFix PyLocator::locate(const py::object& image, const std::optional<SeenPrediction>& expected,
                        const std::optional<MeasuredMotion>& motion) {
    if (expected && motion) throw BadArgument("give a prediction or a motion, not both");
    if (motion && !motion->is_usable()) {
        throw BadArgument(
            "motion: all numbers must be finite and below 1e6, and the sigmas not negative");
    }
    const ImageView view = view_of(image);
    PyFix seen;
    {
        const py::gil_scoped_release others_may_run;
        const std::scoped_lock lock(mutex_);
        seen = locate_locked(view, expected, motion);
    }
    seen.source = shared_from_this();
    if (seen.number > image_number_) {
        image_ = image;
        image_number_ = seen.number;
    }
    return seen;
}

std::shared_ptr<const Stages> PyLocator::stages_of(std::uint64_t number) {
    const py::object image = image_;
    const bool is_newest = image_number_ == number;
    const ImageView view = is_newest ? view_of(image) : ImageView{};
    const py::gil_scoped_release others_may_run;
    const std::scoped_lock lock(mutex_);
    if (!is_newest || newest_.number != number) {
        throw Error(
            "the locator has located a newer frame, so the dots and picture of this frame "
            "are no longer available; Locator(keep_stages=True) keeps them with each fix");
    }
    if (newest_.motion) {
        throw Error(
            "a frame that was located with a motion can be located only once, so its dots and "
            "picture are not available; Locator(keep_stages=True) keeps them with each fix");
    }
    const CodeVariant code = locator_.options().code;
    set_options(newest_.code, true);
    const CodeReading again = read(view, newest_);
    std::shared_ptr<const Stages> stages;
    if (are_alike(again.fix, newest_.fix))
        stages = std::make_shared<Stages>(view, locator_.trace());
    set_options(code, false);
    if (!stages) throw Error("the image has been changed since it was located");
    return stages;
}

double PyLocator::cpp_us(const py::object& image, int repeats) {
    const ImageView view = view_of(image);
    const py::gil_scoped_release others_may_run;
    const std::scoped_lock lock(mutex_);
    use_options_for(view.width_px, view.height_px);
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < repeats; ++i)
        read(view, {.evidence = evidence_, .code = locator_.options().code});
    const std::chrono::duration<double, std::micro> elapsed =
        std::chrono::steady_clock::now() - start;
    return elapsed.count() / repeats;
}

CodeVariant PyLocator::code() {
    const py::gil_scoped_release others_may_run;
    const std::scoped_lock lock(mutex_);
    return setup_.code.value_or(evidence_.likeliest());
}

namespace {

std::shared_ptr<PyLocator> new_locator(const std::string& code, double spacing_mm,
                                       const std::optional<Camera>& camera,
                                       const std::optional<std::array<double, 2>>& reference,
                                       const LocatorOptions& options, bool keep_stages) {
    LocatorSetup setup;
    setup.code = code_or_auto(code);
    setup.camera = camera;
    if (camera) validate(*camera);
    if (camera && (camera->paper || camera->theta_offset_rad != 0)) {
        const py::capsule with_camera =
            tools_for("a mounted camera").attr("_with_camera").cast<py::capsule>();
        setup.with_camera = *with_camera.get_pointer<const WithCamera>();
    }
    if (reference) setup.reference_px = PixelPoint{(*reference)[0], (*reference)[1]};
    setup.options = checked(options);
    if (!(spacing_mm > 0 && spacing_mm < 2000)) {
        throw BadArgument("spacing_mm: must be above 0 and below 2000");
    }
    setup.options.spacing_nm = rounded(spacing_mm * 1e6);
    setup.keep_stages = keep_stages;
    return std::make_shared<PyLocator>(setup);
}

}  // namespace

void define_locator(py::module_& module) {
    py::class_<PyLocator, std::shared_ptr<PyLocator>>(
        module, "Locator",
        "Locates the pattern in images.\n\n"
        "Threads run concurrently if each has its own locator. Threads that share a locator wait\n"
        "for each other.")
        .def(
            py::init(&new_locator), "code"_a = "auto", "spacing_mm"_a = kDefaultSpacing_mm,
            py::kw_only(), "camera"_a = py::none(), "reference_px"_a = py::none(),
            py::arg_v("options", LocatorOptions{}, "Options()"), "keep_stages"_a = false,
            "Make a locator.\n\n"
            "code: code of the sheet: \"anoto\", \"libdots\", \"microdots\", or \"auto\" to detect "
            "the code from all frames.\n"
            "spacing_mm: spacing of the printed grid, in mm.\n"
            "camera: a Camera with its lens and view; images must have its size.\n"
            "reference_px: reference point (u, v) of the pose; default: that of the camera, or "
            "the image centre.\n"
            "options: thresholds and limits.\n"
            "keep_stages: if true, each fix keeps its image, dots and grid for later calls of dots "
            "and draw; costs time and memory.")
        .def("locate", &PyLocator::locate, "image"_a, "prediction"_a = py::none(), py::kw_only(),
             "motion"_a = py::none(),
             "Return the Fix of an image: a numpy array of uint8 with the shape (height, width), "
             "0 is black, with dark dots on light paper. The image is not copied; rows need not be "
             "contiguous.\n\n"
             "With a prediction, the pattern is first searched at the predicted position. A frame "
             "that does not confirm the prediction is located without it.\n\n"
             "motion: the MeasuredMotion since the previous frame. Frames that are not certain "
             "alone are then read together with the previous frames; fix.frames is their number.")
        .def("_cpp_us", &PyLocator::cpp_us, "image"_a, "repeats"_a)
        .def_property_readonly(
            "code", [](PyLocator& self) { return name(self.code()); },
            "The given code or, if the code is detected, the most likely code so far.");
}

}  // namespace dotpose::python
