#include "picture_folder.hpp"

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "dotpose/tools/draw.hpp"

namespace dotpose::cli {

namespace fs = std::filesystem;

namespace {

/// Returns the name of an image without its ending, or drive-17 for the frame drive.mp4#17.
std::string stem_of(const std::string& name) {
    const std::size_t mark = name.rfind('#');
    if (mark == std::string::npos ||
        name.find_first_not_of("0123456789", mark + 1) != std::string::npos) {
        return fs::path(name).stem().string();
    }
    return fs::path(name.substr(0, mark)).stem().string() + "-" + name.substr(mark + 1);
}

}  // namespace

PictureFolder::PictureFolder(fs::path folder, const RunFiles& files)
    : folder_(std::move(folder)), files_(files) {
    std::error_code error;
    // Only the last folder of the path is created: if others are missing, the name is mistyped.
    fs::create_directory(folder_, error);
    if (!fs::is_directory(folder_)) {
        throw Error(fmt::format("cannot create the folder {}: {}", folder_.string(),
                                error ? error.message() : "a file has this name"));
    }
}

void PictureFolder::add(const std::string& image_name, ImageView image, const Trace& trace,
                        double spacing_mm, const std::string& sheet) {
    const std::string stem = stem_of(image_name);
    std::string file = stem + ".svg";
    for (int n = 2; !used_.insert(file).second; ++n)
        file = fmt::format("{}-{}.svg", stem, n);
    files_.require_free("--draw", (folder_ / file).string());
    draw_frame(folder_ / file, image, trace,
               {.spacing_mm = spacing_mm,
                .title = fs::path(image_name).filename().string(),
                .sheet = sheet});
}

}  // namespace dotpose::cli
