#include "picture_folder.hpp"

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "print/lower_case.hpp"
#include "system/path.hpp"

namespace dotpose::cli {

namespace fs = std::filesystem;

namespace {

/// Returns the name of an image without its file extension. For drive.mp4#17, which is frame 17 of
/// a video, returns drive-17.
std::string stem_of(const std::string& name) {
    const std::size_t mark = name.rfind('#');
    if (mark == std::string::npos ||
        name.find_first_not_of("0123456789", mark + 1) != std::string::npos) {
        return system::path_of(name).stem().string();
    }
    return system::path_of(name.substr(0, mark)).stem().string() + "-" + name.substr(mark + 1);
}

}  // namespace

bool is_picture_name(const fs::path& path) {
    return print::lower_case(path.extension().string()) == ".svg" && !fs::is_directory(path);
}

PictureFolder::PictureFolder(fs::path path, const RunFiles& files)
    : path_(std::move(path)), files_(files) {
    if (is_picture_name(path_)) return;
    std::error_code error;
    // Creates only the last folder of the path. If its parent does not exist, the path is probably
    // mistyped.
    fs::create_directory(path_, error);
    if (!fs::is_directory(path_)) {
        throw Error(fmt::format("cannot create the folder {}: {}", path_.string(),
                                error ? error.message() : "a file has this name"));
    }
}

void PictureFolder::add(const std::string& image_name, ImageView image, const Trace& trace,
                        DrawOptions options) {
    options.title = system::path_of(image_name).filename().string();
    draw_frame(is_picture_name(path_) ? path_ : path_in_folder(image_name), image, trace, options);
}

fs::path PictureFolder::path_in_folder(const std::string& image_name) {
    const std::string stem = stem_of(image_name);
    std::string file = stem + ".svg";
    for (int n = 2; !used_.insert(file).second; ++n)
        file = fmt::format("{}-{}.svg", stem, n);
    fs::path path = path_ / system::path_of(file);
    files_.require_free("--draw", path.string());
    return path;
}

}  // namespace dotpose::cli
