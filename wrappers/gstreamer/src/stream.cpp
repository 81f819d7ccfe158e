#include "stream.hpp"

#include <algorithm>

#include "dotpose/files/camera_file.hpp"
#include "dotpose/files/sheet_file.hpp"

namespace dotpose::gstreamer {
namespace {

FollowerOptions options_of(const Settings& settings) {
    FollowerOptions options = settings.options;
    options.track.spacing_mm = static_cast<float>(options.spacing_mm);
    // The overlay draws the dots. The locator stores them in the trace only if `show_stages` is
    // set.
    options.locate.show_stages = settings.has_overlay;
    if (!settings.camera.empty()) options.camera = read_camera(settings.camera);
    if (settings.sheets.empty()) return options;
    options.sheets = read_sheets(settings.sheets);
    if (options.sheets.empty()) throw Error(settings.sheets + " has no sheets");
    return options;
}

}  // namespace

Stream::Stream(const Settings& settings)
    : options_(options_of(settings)), is_tracked_(settings.is_tracked), follower_(options_) {}

void Stream::require_size(int width_px, int height_px) const {
    DeviceOptions unused;
    if (options_.camera) use_camera(*options_.camera, width_px, height_px, unused);
}

Reading Stream::read(ImageView image, bool is_inverted, std::int64_t time_us) {
    if (time_us < newest_us_) follower_.emplace(options_);
    newest_us_ = time_us;
    Reading reading;
    reading.frame = frames_++;
    reading.is_in_world = follower_->is_in_world();
    if (is_inverted || !is_tracked_) copy(image, is_inverted);
    if (!is_tracked_) {
        reading.located = follower_->locate(copy_);
        return reading;
    }
    Followed now = follower_->follow(is_inverted ? copy_.view() : image, time_us);
    reading.located = std::move(now.located);
    reading.track = now.track;
    return reading;
}

void Stream::copy(ImageView image, bool is_inverted) {
    copy_.width_px = image.width_px;
    copy_.height_px = image.height_px;
    copy_.pixels.clear();
    const std::uint8_t flip = is_inverted ? 255 : 0;
    for (int v = 0; v < image.height_px; ++v) {
        std::transform(
            image.row(v), image.row(v) + image.width_px, std::back_inserter(copy_.pixels),
            [flip](std::uint8_t grey) { return static_cast<std::uint8_t>(grey ^ flip); });
    }
}

}  // namespace dotpose::gstreamer
