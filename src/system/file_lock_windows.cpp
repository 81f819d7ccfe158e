#include <windows.h>

#include "system/file_lock.hpp"

namespace dotpose::system {

std::error_code FileLock::try_lock() {
    // While a program has the file open without sharing it, no other program can open it. Windows
    // removes the file when the handle is closed, even if the program is killed.
    constexpr DWORD kNotShared = 0;
    const HANDLE handle =
        CreateFileW(path_.c_str(), GENERIC_WRITE, kNotShared, nullptr, OPEN_ALWAYS,
                    FILE_ATTRIBUTE_HIDDEN | FILE_FLAG_DELETE_ON_CLOSE, nullptr);
    if (handle != INVALID_HANDLE_VALUE) {
        handle_ = reinterpret_cast<std::intptr_t>(handle);
        return {};
    }
    const DWORD error = GetLastError();
    if (error == ERROR_SHARING_VIOLATION || error == ERROR_DELETE_PENDING) {
        return std::make_error_code(std::errc::resource_unavailable_try_again);
    }
    // Converts the error to an errno value if there is a corresponding one. The messages of errno
    // values are the same on all systems.
    const std::error_code code(static_cast<int>(error), std::system_category());
    const std::error_condition condition = code.default_error_condition();
    if (condition.category() != std::generic_category()) return code;
    return {condition.value(), std::generic_category()};
}

FileLock::~FileLock() {
    if (handle_ != kNotHeld) CloseHandle(reinterpret_cast<HANDLE>(handle_));
}

}  // namespace dotpose::system
