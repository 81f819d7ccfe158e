/// PyLocator: a Locator that keeps the data of the newest frame for later requests from Python.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "binding.hpp"
#include "camera_files.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/locate.hpp"
#include "fix.hpp"

namespace dotpose::python {

/// Settings of a locator: the code, the camera and the options.
struct LocatorSetup {
    std::optional<CodeVariant> code;  ///< none if the code is detected from all frames
    std::optional<Camera> camera;
    WithCamera with_camera = nullptr;  ///< null if `camera` has neither a view nor a heading
    std::optional<PixelPoint> reference_px;
    DeviceOptions options;
    bool keep_stages = false;
};

/// Locates frames in sequence. Several threads may share a locator. A thread that waits for the
/// locator does not hold the GIL.
class PyLocator : public StageSource, public std::enable_shared_from_this<PyLocator> {
  public:
    explicit PyLocator(const LocatorSetup& setup);

    /// Locates the pattern in an array. Throws TypeError if the object is not an image, and
    /// BadArgument if the size of the image differs from the size in the camera file.
    PyFix locate(const py::object& image, const std::optional<SeenPrediction>& expected,
                 const std::optional<MeasuredMotion>& motion);

    std::shared_ptr<const Stages> stages_of(std::uint64_t number) override;

    /// Returns the mean time, in µs, that C++ needs to locate the image. Used to measure the
    /// overhead of Python.
    double cpp_us(const py::object& image, int repeats);

    /// Returns the given code or, if the code is detected, the most likely code so far.
    CodeVariant code();

  private:
    /// Inputs of the newest frame, from which its stages can be recomputed.
    struct Request {
        std::uint64_t number = 0;
        CodeEvidence evidence;  ///< evidence before the frame was located
        CodeVariant code = CodeVariant::anoto;
        int bits_per_error = 0;  ///< measured before the frame was located
        std::optional<SeenPrediction> expected;
        std::optional<MeasuredMotion> motion;
        Fix fix;  ///< fix before the camera file is applied
    };

    void use_options_for(int width_px, int height_px);
    /// Sets the options for the newest frame: in the given code, and with the error rate that was
    /// measured before this frame, if it is measured.
    void set_options(CodeVariant code, bool show_stages);
    CodeReading read(const ImageView& image, const Request& request);
    PyFix locate_locked(const ImageView& image, const std::optional<SeenPrediction>& expected,
                        const std::optional<MeasuredMotion>& motion);

    LocatorSetup setup_;
    std::mutex mutex_;  ///< guards the members below, except those guarded by the GIL
    Locator locator_;
    DeviceOptions options_;  ///< options for the size of the newest image
    int width_px_ = 0;
    int height_px_ = 0;
    CodeEvidence evidence_;
    ErrorRate error_rate_;
    Request newest_;

    // Guarded by the GIL.
    py::object image_;
    std::uint64_t image_number_ = 0;
};

}  // namespace dotpose::python
