#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "system/file_lock.hpp"
#include "system/files.hpp"

namespace dotpose::system {

std::error_code FileLock::try_lock() {
    while (true) {
        const int descriptor = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) return {errno, std::generic_category()};
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const int error_number = errno == EINTR ? EWOULDBLOCK : errno;
            close(descriptor);
            return {error_number, std::generic_category()};
        }
        // The previous owner removes the lock file when it releases the lock. If `path_` no longer
        // refers to the locked file, the lock is useless, so the loop tries again with a new file.
        const auto named = numbers_of(path_);
        if (named && named == numbers_of(descriptor)) {
            handle_ = descriptor;
            return {};
        }
        close(descriptor);
    }
}

FileLock::~FileLock() {
    if (handle_ == kNotHeld) return;
    unlink(path_.c_str());
    close(static_cast<int>(handle_));
}

}  // namespace dotpose::system
