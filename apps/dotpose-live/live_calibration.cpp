#include "live_calibration.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "calibration_display.hpp"
#include "capture/source_kind.hpp"
#include "frame_saver.hpp"
#include "lens_collector.hpp"
#include "progress.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {
namespace {

using namespace std::chrono_literals;

class LiveCalibration {
  public:
    LiveCalibration(const CalibrateOptions& calibration, const LiveCalibrationOptions& options,
                    bool is_camera)
        : is_camera_(is_camera),
          collector_(calibration),
          display_(!options.has_no_window && video::has_display()) {
        if (!options.save.empty()) saver_.emplace(SaveOptions{options.save, 1, {}});
    }

    void say(const std::string& message) { display_.say(message); }

    /// Collects frames until there are enough, the source ends, or the user stops.
    void take_all(capture::FrameSource& source) {
        try {
            capture::Frame frame;
            while (!collector_.is_enough() && !collector_.is_full() && source.next(frame)) {
                collector_.set_bits_per_px(source.bits_per_px());
                if (!look(frame) || !go_on_calibrating()) break;
            }
        } catch (const BadArgument&) {
            throw;
        } catch (const Error& error) {
            // Reports the failure but continues, because the frames collected so far may be enough.
            say(error.what());
        }
    }

    LensCalibration result();

  private:
    bool look(capture::Frame& frame);
    bool go_on_calibrating();

    bool is_camera_;
    LensCollector collector_;
    CalibrationDisplay display_;
    std::optional<FrameSaver> saver_;
};

/// Displays a frame, and collects the frame if it is suitable for the calibration. Returns false if
/// the user wants to stop.
bool LiveCalibration::look(capture::Frame& frame) {
    // An unplugged camera delivers empty frames.
    if (frame.image.pixels.empty()) return display_.is_wanted();
    const LensCollector::Outcome outcome = collector_.take(frame);
    if (saver_ && outcome.is_taken()) saver_->take(outcome.image, collector_.trace().fix);
    return display_.show(collector_.status(outcome), outcome.image, collector_.trace());
}

/// Starts a calibration with the frames collected so far if its result is likely to be better than
/// the last result. If the source is a camera, returns without waiting for the calibration, because
/// the camera continues to deliver frames. For any other source, waits for the calibration, so the
/// result does not depend on the speed of the computer. Returns false if the user wants to stop.
bool LiveCalibration::go_on_calibrating() {
    collector_.start_if_useful();
    while (collector_.is_calibrating()) {
        if (collector_.wait(is_camera_ ? 0ms : 50ms)) continue;
        if (is_camera_) return true;
        if (interrupted() || !display_.is_wanted()) return false;
    }
    return true;
}

/// Returns the calibration based on all frames. Throws Error if there are not enough frames, or if
/// the user interrupts the calculation.
LensCalibration LiveCalibration::result() {
    // The first Ctrl-C only stops the collection of frames. The next Ctrl-C interrupts the
    // calculation.
    take_ctrl_c();
    const ProgressLine line("calibrating the lens");
    collector_.finish([this] {
        if (interrupted()) throw Error("stopped; nothing was written");
        display_.is_wanted();
        return true;
    });
    const LensCalibration& newest = collector_.result();
    for (const CalibrationNeed& need : collector_.needs())
        say("the calibration can be used, but could be improved: " + need.advice);
    return newest;
}

}  // namespace

LensCalibration calibrate_live(const SourceArguments& arguments, Sources& sources,
                               const CalibrateOptions& calibration,
                               const LiveCalibrationOptions& options) {
    const bool is_camera = std::ranges::any_of(arguments.names, [](const std::string& name) {
        return capture::kind_of(name) == capture::SourceKind::camera;
    });
    LiveCalibration live(calibration, options, is_camera);
    capture::SourceOptions source_options = arguments.options;
    source_options.stop = interrupted;
    source_options.notify = [&live](const std::string& message) { live.say(message); };
    source_options.on_unreadable = [&live](const std::string&, const Error& error) {
        live.say(error.what());
    };
    const auto source = sources.open(source_options);
    source->open();
    live.take_all(*source);
    return live.result();
}

}  // namespace dotpose::cli
