/// File operations that the standard library lacks. On failure, they set errno, unless documented
/// otherwise.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include "dotpose/export.hpp"

// These declarations are exported because several libraries use them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::system {

/// Opens a file as std::fopen does. Returns nullptr if that fails.
std::FILE* open_file(const std::filesystem::path& path, const char* mode);

/// Creates a new file and opens it for writing. The umask restricts its permissions, as for any new
/// file. Returns nullptr on failure. If the file already exists, errno is EEXIST.
std::FILE* create_new_file(const std::filesystem::path& path);

/// Returns true if the user may write to an existing file.
bool is_writable(const std::filesystem::path& path);

/// Creates an empty file, or truncates an existing one. Returns its descriptor, or -1 if that
/// fails. The caller must close the descriptor with `close_descriptor`.
int create_descriptor(const std::filesystem::path& path);

/// Writes all bytes to the file, starting at byte `offset`. Returns false if that fails.
bool write_at(int descriptor, const void* data, std::size_t size_bytes, std::uint64_t offset);

/// Closes a descriptor. Returns false if that fails.
bool close_descriptor(int descriptor);

/// Numbers that identify a file on this computer, regardless of its name.
struct FileNumbers {
    std::uint64_t device = 0;
    std::uint64_t file = 0;
    bool is_regular = false;  ///< false for folders, devices and pipes
    auto operator<=>(const FileNumbers&) const = default;
};

/// Returns the numbers that identify a file, or nullopt if the file does not exist.
std::optional<FileNumbers> numbers_of(const std::filesystem::path& path);
std::optional<FileNumbers> numbers_of(int descriptor);

/// Creates a temporary folder that only the user can read. Throws std::filesystem::filesystem_error
/// if that fails.
std::filesystem::path create_temporary_folder();

}  // namespace dotpose::system

DOTPOSE_END_EXPORT
