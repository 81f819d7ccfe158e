#include "calibration_frames.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "capture/source_kind.hpp"
#include "dotpose/tools/flip.hpp"
#include "dotpose/tools/follower.hpp"
#include "dotpose/tools/frame_file.hpp"
#include "live_sources.hpp"
#include "new_places.hpp"
#include "progress.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

/// Maximum number of frames chosen from one source. More frames would take longer without improving
/// the result.
constexpr std::size_t kMaxChosen = 50;

Follower follower_for(const CalibrateOptions& calibration) {
    FollowerOptions options;
    options.code = given_code(calibration);
    options.spacing_mm = calibration.pattern.spacing_mm;
    return Follower(options);
}

}  // namespace

CalibrationFrames::CalibrationFrames(const SourceArguments& arguments, Sources& sources,
                                     const CalibrateOptions& options)
    : options_(arguments.options) {
    capture::SourceOptions source_options = arguments.options;
    source_options.stop = interrupted;
    source_options.notify = notify;
    source_options.open_live = open_live;
    for (const std::string& name : sources.all_names()) {
        const capture::SourceKind kind = capture::kind_of(name);
        if (kind == capture::SourceKind::image || kind == capture::SourceKind::images) {
            for (std::string& file : capture::files_of(name))
                frames_.push_back({std::move(file), {}});
        } else {
            choose(name, source_options, options);
        }
    }
}

void CalibrationFrames::choose(const std::string& source, const capture::SourceOptions& options,
                               const CalibrateOptions& calibration) {
    const bool is_camera = capture::kind_of(source) == capture::SourceKind::camera;
    if (is_camera) {
        notify("move the camera over the sheet, until it has shown " + std::to_string(kMaxChosen) +
               " places or you end it with Ctrl-C");
    }
    std::optional<std::string> name = source;
    capture::SourceList list([&name] { return std::exchange(name, std::nullopt); }, options);
    Follower follower = follower_for(calibration);
    NewPlaces places;
    std::vector<GreyImage> chosen;
    std::int64_t frames = 0;
    std::int64_t located = 0;
    std::int64_t mirrored = 0;
    capture::Frame frame;
    ProgressLine line("reading " + source);
    while (!(is_camera && chosen.size() == kMaxChosen) && list.next(frame)) {
        const Located found = follower.locate(frame.image);
        line.update(++frames, list.length());
        located += found.fix.status == Status::ok;
        mirrored += found.fix.status == Status::mirrored;
        if (found.reduced_by > 1 || !places.take(found.fix, frame.image.view())) continue;
        chosen.push_back(std::move(frame.image));
        if (chosen.size() <= kMaxChosen) continue;
        remove_every_second(chosen);
        places.thin_out();
    }
    if (take_ctrl_c()) {
        notify("no more frames are read; Ctrl-C once more ends without a result");
    }
    if (interrupted()) throw Error("interrupted");
    if (located == 0 && mirrored > 0) throw Error(source + ": " + kMirrored);
    if (located == 0) {
        throw Error(fmt::format("{}: none of its {} frames shows a pattern that can be located",
                                source, frames));
    }
    notify(fmt::format("{}: {} of {} frames located; {} that show new places are used", source,
                       located, frames, chosen.size()));
    for (GreyImage& image : chosen)
        frames_.push_back({{}, std::move(image)});
}

bool CalibrationFrames::are_mirrored(const CalibrateOptions& options) const {
    constexpr int kMaxTries = 3;
    Follower follower = follower_for(options);
    for (int i = 0; i < std::min(count(), kMaxTries); ++i) {
        if (follower.locate(flipped(at(i).view())).fix.status == Status::ok) return true;
    }
    return false;
}

GreyImage CalibrationFrames::at(int index) const {
    const Frame& frame = frames_[static_cast<std::size_t>(index)];
    if (frame.file.empty()) return frame.image;
    GreyImage image = read_frame(system::path_of(frame.file));
    capture::prepare(options_, frame.file, image);
    return image;
}

}  // namespace dotpose::cli
