#include "base/output_file.hpp"

#include <cerrno>
#include <random>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/system_error.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"

namespace dotpose::base {
namespace fs = std::filesystem;
namespace {

constexpr int kNameAttempts = 100;

}  // namespace

OutputFile::OutputFile(const fs::path& target) : target_(without_links(target)) {
    std::error_code error;
    const fs::file_status status = fs::status(target_, error);
    if (fs::is_directory(status)) throw_system("write", target_, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw Error(fmt::format("cannot write {}: it is not a regular file", target_.string()));
    }
    // Renaming a file does not require write permission for the file that it replaces. Without this
    // check, `commit` would replace a write-protected file.
    if (fs::exists(status) && access(target_.c_str(), W_OK) != 0) {
        throw_system("write", target_, errno);
    }
    open_temporary();
    if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
}

OutputFile::~OutputFile() {
    if (stream_ == nullptr) return;
    std::fclose(stream_);
    unlink(temporary_.c_str());
}

void OutputFile::open_temporary() {
    std::random_device random;
    int descriptor = -1;
    for (int attempt = 0; attempt < kNameAttempts && descriptor < 0; ++attempt) {
        temporary_ = target_;
        temporary_.replace_filename(
            fmt::format(".{:.200}.{:08x}.tmp", target_.filename().string(), random()));
        // Uses open instead of mkstemp, because open applies the user's umask to the mode of the
        // file.
        descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno != EEXIST) break;
    }
    if (descriptor < 0) throw_system("create", target_, errno);
    stream_ = fdopen(descriptor, "wb");
    if (stream_ == nullptr) {
        const int error_number = errno;
        close(descriptor);
        unlink(temporary_.c_str());
        throw_system("create", target_, error_number);
    }
}

void OutputFile::fail() noexcept {
    if (error_number_ == 0) error_number_ = errno != 0 ? errno : EIO;
}

void OutputFile::write(const void* data, std::size_t size_bytes) noexcept {
    if (error_number_ != 0 || size_bytes == 0) return;
    errno = 0;
    if (std::fwrite(data, 1, size_bytes, stream_) != size_bytes) fail();
}

std::int64_t OutputFile::seek(std::int64_t offset, int whence) noexcept {
    errno = 0;
    if (fseeko(stream_, offset, whence) != 0) fail();
    return ftello(stream_);
}

void OutputFile::require_good() const {
    if (error_number_ != 0) throw_system("write", target_, error_number_);
}

void OutputFile::commit() {
    require_good();
    std::FILE* stream = stream_;
    stream_ = nullptr;
    // Network file systems report a full disk only when the file is closed.
    if (std::fclose(stream) != 0 || std::rename(temporary_.c_str(), target_.c_str()) != 0) {
        const int error_number = errno;
        unlink(temporary_.c_str());
        throw_system("write", target_, error_number);
    }
}

}  // namespace dotpose::base

namespace dotpose {
namespace fs = std::filesystem;

void write_file(const fs::path& target, std::string_view contents) {
    base::OutputFile file(target);
    file.write(contents);
    file.commit();
}

void require_writable(const fs::path& target) {
    const base::OutputFile never_committed(target);
}

fs::path without_links(fs::path path) {
    constexpr int kMaxLinks = 40;  // same limit as Linux
    std::error_code error;
    for (int i = 0; i < kMaxLinks && fs::is_symlink(path, error); ++i) {
        const fs::path target = fs::read_symlink(path, error);
        if (error) break;
        path = path.parent_path() / target;
    }
    return path;
}

}  // namespace dotpose
