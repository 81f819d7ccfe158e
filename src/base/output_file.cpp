#include "base/output_file.hpp"

#include <cerrno>
#include <random>
#include <system_error>

#include <fmt/core.h>

#include "base/system_error.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/write_file.hpp"
#include "system/files.hpp"
#include "system/path.hpp"

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
    // Renaming a file onto the target does not require write permission for the target, so a
    // read-only target must be rejected here.
    if (fs::exists(status) && !system::is_writable(target_)) {
        throw_system("write", target_, errno);
    }
    open_temporary();
    if (fs::exists(status)) fs::permissions(temporary_, status.permissions(), error);
}

OutputFile::~OutputFile() {
    if (stream_ == nullptr) return;
    std::fclose(stream_);
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void OutputFile::open_temporary() {
    std::random_device random;
    for (int attempt = 0; attempt < kNameAttempts && stream_ == nullptr; ++attempt) {
        temporary_ = target_;
        temporary_.replace_filename(system::path_of(
            fmt::format(".{:.200}.{:08x}.tmp", target_.filename().string(), random())));
        stream_ = system::create_new_file(temporary_);
        if (stream_ == nullptr && errno != EEXIST) break;
    }
    if (stream_ == nullptr) throw_system("create", target_, errno);
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
    // Checks the result of fclose, because some network file systems report a full disk only when
    // the file is closed.
    std::error_code error;
    if (std::fclose(stream) != 0) {
        error.assign(errno, std::generic_category());
    } else {
        fs::rename(temporary_, target_, error);
    }
    if (!error) return;
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    throw_system("write", target_, error);
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
    constexpr int kMaxLinks = 40;  // maximum number of links to follow, as in Linux
    std::error_code error;
    for (int i = 0; i < kMaxLinks && fs::is_symlink(path, error); ++i) {
        const fs::path target = fs::read_symlink(path, error);
        if (error) break;
        path = path.parent_path() / target;
    }
    return path;
}

}  // namespace dotpose
