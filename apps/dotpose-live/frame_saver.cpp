#include "frame_saver.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include "dotpose/files/error.hpp"
#include "lines.hpp"

namespace dotpose::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "frame_";

const char* ending_of(ImageEncoding format) {
    switch (format) {
        case ImageEncoding::jpeg:
            return ".jpg";
        case ImageEncoding::pgm:
            return ".pgm";
        case ImageEncoding::png:
            break;
    }
    return ".png";
}

/// Returns the number of the next frame to save in a folder: the highest existing number plus one,
/// or 0 if the folder contains no frames.
std::int64_t number_after(const fs::path& folder) {
    std::int64_t next = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().stem().string();
        if (!name.starts_with(kPrefix)) continue;
        std::int64_t number = 0;
        std::from_chars(name.data() + kPrefix.size(), name.data() + name.size(), number);
        next = std::max(next, number + 1);
    }
    return next;
}

[[noreturn]] void throw_unwritten(const fs::path& path, int error_number) {
    throw Error("cannot write " + path.string() + ": " + std::strerror(error_number));
}

/// Creates and writes a file. Returns false if a file with this name already exists.
bool write_new(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST) return false;
    if (descriptor < 0) throw_unwritten(path, errno);
    File file(fdopen(descriptor, "wb"));
    errno = 0;
    const bool is_written =
        file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size();
    // The result of fclose is also checked, because fclose writes the buffered bytes and fails if
    // the disk is full.
    const bool is_closed = file && std::fclose(file.release()) == 0;
    if (is_written && is_closed) return true;
    const int error_number = errno;
    unlink(path.c_str());
    throw_unwritten(path, error_number);
}

}  // namespace

FrameSaver::FrameSaver(SaveOptions options) : options_(std::move(options)) {
    std::error_code failed;
    // Creates only the last folder of the path. If its parent is missing, the path is probably
    // mistyped.
    fs::create_directory(options_.folder, failed);
    if (!fs::is_directory(options_.folder)) {
        throw Error(fmt::format("cannot create the folder {}: {}", options_.folder,
                                failed ? failed.message() : "a file has this name"));
    }
    next_number_ = number_after(options_.folder);
}

bool FrameSaver::is_wanted(ImageView image, const Fix& fix) {
    const std::int64_t number = frames_++;
    return options_.every > 0 ? number % options_.every == 0 : places_.take(fix, image);
}

void FrameSaver::take(ImageView image, const Fix& fix) {
    if (image.width_px == 0 || !is_wanted(image, fix)) return;
    const std::vector<std::uint8_t> bytes = encode_image(options_.format, image);
    const auto path = [this] {
        return fs::path(options_.folder) /
               fmt::format("{}{:06}{}", kPrefix, next_number_, ending_of(options_.format));
    };
    // Skips numbers that another program has already used in this folder.
    while (!write_new(path(), bytes))
        ++next_number_;
    ++next_number_;
    ++saved_;
}

}  // namespace dotpose::cli
