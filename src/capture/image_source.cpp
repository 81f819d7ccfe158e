#include <filesystem>
#include <utility>

#include <fmt/core.h>

#include "capture/frame_source.hpp"
#include "dotpose/tools/image_file.hpp"
#include "system/path.hpp"

namespace dotpose::capture {
namespace {

constexpr double kDefaultFps = 30;

class ImageSource : public FrameSource {
  public:
    ImageSource(std::function<std::optional<std::string>()> next_path, const SourceOptions& options)
        : next_path_(std::move(next_path)), options_(options) {}

    bool next(Frame& frame) override {
        while (!options_.stop()) {
            const auto path = next_path_();
            if (!path) return false;
            frame.index = taken_++;
            frame.time_us = time_of(frame.index, rate());
            frame.file = *path;
            try {
                options_.before_reading(*path);
                std::string note;
                frame.image = read_image(system::path_of(*path), options_.max_pixels, note);
                if (!note.empty()) options_.notify(note);
                tell_of_pages(system::path_of(*path));
                return true;
            } catch (const Error& error) {
                options_.on_unreadable(*path, error);
            }
        }
        return false;
    }
    double rate() const override { return options_.fps.value_or(kDefaultFps); }

  private:
    void tell_of_pages(const std::filesystem::path& path) const {
        // Only TIFF files can have several pages.
        const std::string ending = path.extension().string();
        if (!ending.starts_with(".t") && !ending.starts_with(".T")) return;
        const int pages = count_pages(path);
        if (pages == 1) return;
        options_.notify(
            fmt::format("{} has {} pages, of which only the first is read", path.string(), pages));
    }

    std::function<std::optional<std::string>()> next_path_;
    SourceOptions options_;
    std::int64_t taken_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> open_images(std::function<std::optional<std::string>()> next_path,
                                         const SourceOptions& options) {
    return std::make_unique<ImageSource>(std::move(next_path), options);
}

}  // namespace dotpose::capture
