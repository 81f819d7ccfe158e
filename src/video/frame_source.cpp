#include "video/frame_source.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/core.h>

#include "video/sources.hpp"

namespace dotpose::video {
namespace {

namespace fs = std::filesystem;

bool is_camera(const std::string& name) {
    return name.find_first_not_of("0123456789") == std::string::npos ||
           name.starts_with("/dev/video") || is_url(name);
}

/// Crops every frame of another source to a region.
class Cropped : public FrameSource {
  public:
    Cropped(std::unique_ptr<FrameSource> whole, const Region& region)
        : whole_(std::move(whole)), region_(region) {}

    bool next(Frame& frame) override {
        if (!whole_->next(frame)) return false;
        if (!frame.image.pixels.empty()) frame.image = cropped(frame.image, region_);
        return true;
    }
    std::int64_t dropped() const override { return whole_->dropped(); }
    double rate() const override { return whole_->rate(); }

  private:
    std::unique_ptr<FrameSource> whole_;
    Region region_;
};

bool is_images(const std::string& name) {
    return fs::is_directory(name) || name.find_first_of("*?[") != std::string::npos;
}

std::unique_ptr<FrameSource> open_whole(const SourceOptions& options) {
    const std::string& name = options.name;
    if (name.empty()) throw BadArgument("the name of the source is empty");
    if (name == "-") return open_raw(options);
    if (is_camera(name)) return open_camera(options);
    if (is_images(name)) return open_images(options);
    return open_video(options);
}

}  // namespace

bool is_url(const std::string& name) {
    return name.find("://") != std::string::npos;
}

std::vector<std::string> files_of(const std::string& name) {
    if (name.empty() || is_camera(name)) return {};
    return is_images(name) ? images_at(name) : std::vector{name};
}

std::unique_ptr<FrameSource> open_source(const SourceOptions& options) {
    auto source = open_whole(options);
    if (!options.region) return source;
    return std::make_unique<Cropped>(std::move(source), *options.region);
}

GreyImage cropped(const GreyImage& image, const Region& region) {
    if (region.left < 0 || region.top < 0 || region.width < 1 || region.height < 1 ||
        region.left > image.width_px - region.width ||
        region.top > image.height_px - region.height) {
        throw BadArgument(fmt::format("the region {},{} {}x{} leaves the frame of {}x{} px",
                                      region.left, region.top, region.width, region.height,
                                      image.width_px, image.height_px));
    }
    GreyImage part;
    part.width_px = region.width;
    part.height_px = region.height;
    part.pixels.reserve(static_cast<std::size_t>(region.width) *
                        static_cast<std::size_t>(region.height));
    const ImageView view = image.view();
    for (int v = region.top; v < region.top + region.height; ++v) {
        const std::uint8_t* first = view.row(v) + region.left;
        part.pixels.insert(part.pixels.end(), first, first + region.width);
    }
    return part;
}

}  // namespace dotpose::video
