// Reads the images of a folder or glob in the order of their names.
#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include <fmt/core.h>
#include <glob.h>

#include "dotpose/tools/frame_file.hpp"
#include "video/sources.hpp"

namespace dotpose::video {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultFps = 30;

bool is_image(const fs::path& path) {
    constexpr std::array<std::string_view, 10> kEndings = {
        ".pgm", ".ppm", ".pbm", ".pnm", ".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::find(kEndings, ending) != kEndings.end();
}

std::vector<std::string> images_of_folder(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
        if (is_image(entry.path())) names.push_back(entry.path().string());
    }
    if (failed) throw Error("cannot read " + folder.string() + ": " + failed.message());
    std::ranges::sort(names);
    return names;
}

std::vector<std::string> images_of_glob(const std::string& pattern) {
    glob_t found{};
    std::vector<std::string> names;
    if (glob(pattern.c_str(), 0, nullptr, &found) == 0) {
        names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    globfree(&found);
    return names;
}

class ImageSource : public FrameSource {
  public:
    explicit ImageSource(const SourceOptions& options)
        : options_(options), names_(images_at(options.name)) {
        if (names_.empty()) throw Error("no images at " + options.name);
    }

    bool next(Frame& frame) override {
        while (next_ < names_.size() && !options_.stop()) {
            const std::string& name = names_[next_];
            frame.index = static_cast<std::int64_t>(next_++);
            frame.time_us = time_of(frame.index, rate());
            frame.file = name;
            try {
                frame.image = read_frame(name);
                return true;
            } catch (const Error& error) {
                // After an image that cannot be read, the source goes on with the next one.
                options_.tell(error.what());
            }
        }
        return false;
    }
    double rate() const override { return options_.fps.value_or(kDefaultFps); }

  private:
    SourceOptions options_;
    std::vector<std::string> names_;
    std::size_t next_ = 0;
};

}  // namespace

std::vector<std::string> images_at(const std::string& name) {
    return fs::is_directory(name) ? images_of_folder(name) : images_of_glob(name);
}

std::unique_ptr<FrameSource> open_images(const SourceOptions& options) {
    return std::make_unique<ImageSource>(options);
}

}  // namespace dotpose::video
