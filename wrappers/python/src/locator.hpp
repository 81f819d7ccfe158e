/// LocatorOfPython: a Locator with all that Python may ask of it later.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "binding.hpp"
#include "dotpose/files/camera.hpp"
#include "dotpose/locate.hpp"
#include "fix.hpp"

namespace dotpose::python {

/// What is known of code and camera.
struct LocatorSetup {
    std::optional<CodeVariant> code;  ///< none: found from all frames
    std::optional<Camera> camera;
    std::optional<PixelPoint> reference_px;
    Options options;
    bool keep_stages = false;
};

/// Locates frames one after the other; threads that share it wait for each other, without the
/// interpreter's lock.
class LocatorOfPython : public StageSource, public std::enable_shared_from_this<LocatorOfPython> {
  public:
    explicit LocatorOfPython(const LocatorSetup& setup);

    /// Locates an array. Throws TypeError for what is no image, BadArgument if the image does not
    /// have the size of the camera file.
    SeenFix locate(const py::object& image, const std::optional<SeenPrediction>& expected);

    std::shared_ptr<const Stages> stages_of(std::uint64_t number) override;

    /// Returns the mean time in us that the same image takes in C++, for tests of what Python adds.
    double cpp_us(const py::object& image, int repeats);

    /// Returns the code variant that was given, otherwise the likeliest so far.
    CodeVariant code();

  private:
    /// What the newest frame was located with, so that its stages can be found once more.
    struct Request {
        std::uint64_t number = 0;
        CodeEvidence evidence;  ///< before the frame
        CodeVariant code = CodeVariant::anoto;
        std::optional<SeenPrediction> expected;
        Fix fix;  ///< before the camera file is applied
    };

    void use_options_for(int width_px, int height_px);
    void set_options(CodeVariant code, bool show_stages);
    CodeReading read(const ImageView& image, const Request& request);
    SeenFix locate_locked(const ImageView& image, const std::optional<SeenPrediction>& expected);

    LocatorSetup setup_;
    std::mutex mutex_;  ///< of all below but the image
    Locator locator_;
    Options options_;  ///< for images of the newest size
    int width_px_ = 0;
    int height_px_ = 0;
    CodeEvidence evidence_;
    Request newest_;

    // Guarded by the interpreter's lock.
    py::object image_;
    std::uint64_t image_number_ = 0;
};

}  // namespace dotpose::python
