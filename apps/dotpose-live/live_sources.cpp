#include "live_sources.hpp"

#include "capture/source_kind.hpp"
#include "terminal_text.hpp"
#include "video/recording.hpp"
#include "video/sources.hpp"

namespace dotpose::cli {

namespace {

class GreyRecording : public VideoOutput {
  public:
    GreyRecording(const std::string& path, double fps) : recording_(path, fps, tell) {}
    void write(const GreyImage& image) override { recording_.write(image.view()); }
    void finish() override { recording_.finish(); }

  private:
    video::Recording recording_;
};

}  // namespace

void hand_over() {}

void hand_over_if_possible() {}

std::unique_ptr<capture::FrameSource> open_live(const std::string& name,
                                                const capture::SourceOptions& options) {
    const bool is_camera = capture::kind_of(name) == capture::SourceKind::camera;
    return is_camera ? video::open_camera(name, options) : video::open_video(name, options);
}

std::unique_ptr<VideoOutput> create_video(const std::string& path, double fps) {
    return std::make_unique<GreyRecording>(path, fps);
}

}  // namespace dotpose::cli
