#include "live_sources.hpp"

#include "capture/source_kind.hpp"
#include "terminal_text.hpp"
#include "video/module.hpp"

namespace dotpose::cli {

void hand_over() {}

void hand_over_if_possible() {}

std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions& options) {
    const bool is_camera = capture::kind_of(name) == capture::SourceKind::camera;
    const video::Module& video = video::module();
    return is_camera ? video.open_camera(name, options) : video.open_video(name, options);
}

std::unique_ptr<video::GreyVideo> create_video(const std::string& path, double fps) {
    return video::module().create_video(path, fps, notify);
}

}  // namespace dotpose::cli
