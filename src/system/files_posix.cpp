#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "system/files.hpp"

namespace dotpose::system {
namespace fs = std::filesystem;
namespace {

FileNumbers numbers_in(const struct stat& found) {
    return {static_cast<std::uint64_t>(found.st_dev), static_cast<std::uint64_t>(found.st_ino),
            S_ISREG(found.st_mode)};
}

}  // namespace

std::FILE* open_file(const fs::path& path, const char* mode) {
    return std::fopen(path.c_str(), mode);
}

std::FILE* create_new_file(const fs::path& path) {
    const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) return nullptr;
    std::FILE* const stream = fdopen(descriptor, "wb");
    if (stream == nullptr) {
        const int error_number = errno;
        close(descriptor);
        unlink(path.c_str());
        errno = error_number;
    }
    return stream;
}

bool is_writable(const fs::path& path) {
    return access(path.c_str(), W_OK) == 0;
}

int create_descriptor(const fs::path& path) {
    return open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
}

bool write_at(int descriptor, const void* data, std::size_t size_bytes, std::uint64_t offset) {
    const auto* const bytes = static_cast<const char*>(data);
    std::size_t written = 0;
    while (written < size_bytes) {
        const ssize_t count = pwrite(descriptor, bytes + written, size_bytes - written,
                                     static_cast<off_t>(offset + written));
        if (count < 0 && errno != EINTR) return false;
        if (count > 0) written += static_cast<std::size_t>(count);
    }
    return true;
}

bool close_descriptor(int descriptor) {
    return close(descriptor) == 0;
}

std::optional<FileNumbers> numbers_of(const fs::path& path) {
    struct stat found {};
    if (stat(path.c_str(), &found) != 0) return std::nullopt;
    return numbers_in(found);
}

std::optional<FileNumbers> numbers_of(int descriptor) {
    struct stat found {};
    if (fstat(descriptor, &found) != 0) return std::nullopt;
    return numbers_in(found);
}

fs::path create_temporary_folder() {
    std::string folder = (fs::temp_directory_path() / "dotpose-XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) {
        throw fs::filesystem_error("mkdtemp", folder, {errno, std::generic_category()});
    }
    return folder;
}

}  // namespace dotpose::system
