#include <cerrno>
#include <random>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>

#include "system/files.hpp"

namespace dotpose::system {
namespace fs = std::filesystem;
namespace {

std::wstring wide(const char* ascii) {
    const std::string text = ascii;
    return {text.begin(), text.end()};
}

std::optional<FileNumbers> numbers_of_handle(HANDLE handle) {
    BY_HANDLE_FILE_INFORMATION found{};
    if (GetFileType(handle) != FILE_TYPE_DISK) return FileNumbers{};
    if (GetFileInformationByHandle(handle, &found) == 0) return std::nullopt;
    const bool is_folder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    return FileNumbers{
        found.dwVolumeSerialNumber,
        (static_cast<std::uint64_t>(found.nFileIndexHigh) << 32) | found.nFileIndexLow, !is_folder};
}

}  // namespace

std::FILE* open_file(const fs::path& path, const char* mode) {
    return _wfopen(path.c_str(), wide(mode).c_str());
}

std::FILE* create_new_file(const fs::path& path) {
    const int descriptor =
        _wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT,
               _S_IREAD | _S_IWRITE);
    return descriptor < 0 ? nullptr : _fdopen(descriptor, "wb");
}

bool is_writable(const fs::path& path) {
    constexpr int kWrite = 2;
    return _waccess(path.c_str(), kWrite) == 0;
}

int create_descriptor(const fs::path& path) {
    return _wopen(path.c_str(), _O_WRONLY | _O_CREAT | _O_TRUNC | _O_BINARY | _O_NOINHERIT,
                  _S_IREAD | _S_IWRITE);
}

bool write_at(int descriptor, const void* data, std::size_t size_bytes, std::uint64_t offset) {
    constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  // _write takes an unsigned int
    const auto* bytes = static_cast<const char*>(data);
    if (_lseeki64(descriptor, static_cast<std::int64_t>(offset), SEEK_SET) < 0) return false;
    while (size_bytes > 0) {
        const auto part = static_cast<unsigned>(size_bytes < kMaxBytes ? size_bytes : kMaxBytes);
        const int count = _write(descriptor, bytes, part);
        if (count <= 0) return false;
        bytes += count;
        size_bytes -= static_cast<std::size_t>(count);
    }
    return true;
}

bool close_descriptor(int descriptor) {
    return _close(descriptor) == 0;
}

std::optional<FileNumbers> numbers_of(const fs::path& path) {
    // FILE_FLAG_BACKUP_SEMANTICS is required for opening folders.
    const HANDLE handle =
        CreateFileW(path.c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                    nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (handle == INVALID_HANDLE_VALUE) return std::nullopt;
    const auto numbers = numbers_of_handle(handle);
    CloseHandle(handle);
    return numbers;
}

std::optional<FileNumbers> numbers_of(int descriptor) {
    const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(descriptor));
    if (handle == INVALID_HANDLE_VALUE) return std::nullopt;
    return numbers_of_handle(handle);
}

fs::path create_temporary_folder() {
    // The system's temporary folder is private to the user, so the new folder does not need special
    // access rights.
    constexpr int kAttempts = 100;
    std::random_device random;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const fs::path folder =
            fs::temp_directory_path() / (L"dotpose-" + std::to_wstring(random()));
        if (fs::create_directory(folder)) return folder;
    }
    throw fs::filesystem_error("create_directory", fs::temp_directory_path(),
                               std::make_error_code(std::errc::file_exists));
}

}  // namespace dotpose::system
