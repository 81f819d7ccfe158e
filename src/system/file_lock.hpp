/// An inter-process lock, based on a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <system_error>

#include "dotpose/export.hpp"

// These declarations are exported because several libraries use them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::system {

/// A lock that at most one program can hold at a time. The system releases the lock when the
/// program exits, even if the program is killed.
class FileLock {
  public:
    /// `path` is the lock file, which exists only while a program holds the lock or waits for it.
    explicit FileLock(std::filesystem::path path) : path_(std::move(path)) {}
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Tries to acquire the lock. Returns std::errc::resource_unavailable_try_again if another
    /// program holds it. Returns another error if the file cannot be created or the file system
    /// does not support locks.
    std::error_code try_lock();

  private:
    static constexpr std::intptr_t kNotHeld = -1;

    std::filesystem::path path_;
    std::intptr_t handle_ = kNotHeld;  ///< descriptor or handle of the locked file
};

}  // namespace dotpose::system

DOTPOSE_END_EXPORT
