#include "capture/source_kind.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "dotpose/files/error.hpp"
#include "images/image_format.hpp"
#include "system/glob.hpp"
#include "system/path.hpp"

namespace dotpose::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 14> kImageEndings = {
    ".pgm", ".ppm", ".pbm",  ".pnm",  ".png",  ".jpg",  ".jpeg",
    ".bmp", ".tif", ".tiff", ".webp", ".heic", ".heif", ".avif"};
constexpr std::array<std::string_view, 24> kVideoEndings = {
    ".mp4",  ".m4v", ".mov",  ".mkv",  ".webm", ".avi",  ".ts",  ".mts",
    ".m2ts", ".mpg", ".mpeg", ".m2v",  ".wmv",  ".flv",  ".ogv", ".3gp",
    ".mjpg", ".nut", ".y4m",  ".h264", ".264",  ".hevc", ".gif", ".mjpeg"};

std::string ending_of(const fs::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

template <typename Endings>
bool has_ending(const fs::path& path, const Endings& endings) {
    return std::ranges::find(endings, ending_of(path)) != endings.end();
}

/// Returns true if the file has the signature of MP4, Matroska or AVI. Pipes are not examined,
/// because reading would consume their bytes.
bool begins_like_video(const fs::path& name) {
    std::error_code failed;
    if (!fs::is_regular_file(name, failed)) return false;
    std::string head(images::kMagicBytes, '\0');
    std::ifstream file(name, std::ios::binary);
    if (!file.read(head.data(), static_cast<std::streamsize>(head.size()))) return false;
    const std::string_view bytes = head;
    const images::Bytes numbers(reinterpret_cast<const std::uint8_t*>(head.data()), head.size());
    const bool is_mp4 = bytes.substr(4, 4) == "ftyp" && images::format_of(numbers) == nullptr &&
                        images::other_format_of(numbers) == nullptr;
    return is_mp4 || bytes.starts_with("\x1a\x45\xdf\xa3") ||
           (bytes.starts_with("RIFF") && bytes.substr(8, 4) == "AVI ");
}

std::vector<std::string> images_of_folder(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed)) {
        if (has_ending(entry.path(), kImageEndings)) names.push_back(entry.path().generic_string());
    }
    if (failed) throw Error("cannot read " + folder.string() + ": " + failed.message());
    if (names.empty()) {
        throw Error("cannot read " + folder.string() + ": there are no images in this folder");
    }
    std::ranges::sort(names);
    return names;
}

std::vector<std::string> images_of_glob(const std::string& pattern) {
    std::vector<std::string> names = system::glob(pattern);
    if (names.empty()) throw Error("no images at " + pattern);
    return names;
}

bool is_camera(const std::string& name) {
    const bool is_number =
        !name.empty() && name.find_first_not_of("0123456789") == std::string::npos;
    return is_number || name.starts_with("/dev/video") || is_url(name);
}

}  // namespace

bool is_url(const std::string& name) {
    return name.find("://") != std::string::npos;
}

SourceKind kind_of(const std::string& name) {
    std::error_code failed;
    if (name == "-") return SourceKind::raw;
    if (is_camera(name)) return SourceKind::camera;
    const fs::path path = system::path_of(name);
    if (fs::is_directory(path, failed)) return SourceKind::images;
    if (name.find_first_of("*?[") != std::string::npos && !fs::exists(path, failed)) {
        return SourceKind::images;
    }
    if (has_ending(path, kVideoEndings)) return SourceKind::video;
    if (has_ending(path, kImageEndings) || !begins_like_video(path)) return SourceKind::image;
    return SourceKind::video;
}

bool needs_video_libraries(SourceKind kind) {
    return kind == SourceKind::camera || kind == SourceKind::video;
}

std::vector<std::string> images_at(const std::string& name) {
    std::error_code failed;
    const fs::path path = system::path_of(name);
    return fs::is_directory(path, failed) ? images_of_folder(path) : images_of_glob(name);
}

std::vector<std::string> files_of(const std::string& name) {
    switch (kind_of(name)) {
        case SourceKind::camera:
            return {};
        case SourceKind::images:
            return images_at(name);
        default:
            return {name};
    }
}

}  // namespace dotpose::capture
