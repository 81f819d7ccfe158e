#include "dotpose/files/sheet_file.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/system_error.hpp"
#include "dotpose/files/write_file.hpp"
#include "files/input_file.hpp"
#include "files/sheet_json.hpp"
#include "files/sheet_list.hpp"

namespace dotpose {
namespace fs = std::filesystem;
using base::throw_system;
namespace {

/// Maximum size of a sheet file, sufficient for about 100,000 sheets.
constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

std::optional<std::string> text_of(const fs::path& path) {
    return files::text_of(path, kMaxBytes);
}

/// Waits for locks on a file. All locks share one time limit.
class LockWait {
  public:
    LockWait(const fs::path& path, const SheetFileWait& wait)
        : path_(path),
          wait_(wait),
          end_(Clock::now() + std::chrono::duration<double>(wait.max_s)) {}

    /// Takes a lock. Throws Error after the time limit, or if the file system does not support
    /// locks.
    void lock(int descriptor) {
        constexpr auto kPause = std::chrono::milliseconds(10);
        while (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            if (errno != EWOULDBLOCK && errno != EINTR) throw_system("lock", path_, errno);
            if (wait_.stop()) throw Error("stopped; nothing was written");
            if (Clock::now() >= end_) {
                throw Error(
                    fmt::format("cannot lock {}: another program has been changing it for "
                                "{:g} s",
                                path_.string(), wait_.max_s));
            }
            if (!is_reported_) {
                wait_.tell(
                    fmt::format("waiting for another program that is changing {}", path_.string()));
            }
            is_reported_ = true;
            std::this_thread::sleep_for(kPause);
        }
    }

  private:
    using Clock = std::chrono::steady_clock;
    const fs::path& path_;
    const SheetFileWait& wait_;
    std::chrono::time_point<Clock, std::chrono::duration<double>> end_;
    bool is_reported_ = false;
};

}  // namespace

std::vector<SheetEntry> read_sheets(const fs::path& path) {
    const auto text = text_of(path);
    if (!text) {
        throw Error(
            fmt::format("cannot read {0}: no such file; 'dotpose print --sheets {0} --name NAME' "
                        "prints a sheet and creates the file",
                        path.string()));
    }
    return files::sheets_from_json(*text, path.string());
}

SheetFile::Lock::Lock(const fs::path& path, const SheetFileWait& wait) : path_(path) {
    path_.replace_filename(fmt::format(".{}.lock", path.filename().string()));
    LockWait lock_wait(path, wait);
    while (true) {
        descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw_system("lock", path, errno);
        try {
            lock_wait.lock(descriptor_);
        } catch (const Error&) {
            close(descriptor_);
            throw;
        }
        // The previous owner of the lock removes the lock file when it finishes. A lock on a
        // removed file has no effect, so the loop takes the lock again on a new file.
        struct stat held {};
        struct stat named {};
        if (fstat(descriptor_, &held) == 0 && stat(path_.c_str(), &named) == 0 &&
            held.st_ino == named.st_ino && held.st_dev == named.st_dev) {
            return;
        }
        close(descriptor_);
    }
}

SheetFile::Lock::~Lock() {
    unlink(path_.c_str());
    close(descriptor_);
}

// Symbolic links are resolved first, because all paths to a file must use the same lock.
SheetFile::SheetFile(const fs::path& path, const SheetFileWait& wait)
    : path_(without_links(path)), lock_(path_, wait), text_(text_of(path_)) {
    if (text_) sheets_ = files::sheets_from_json(*text_, path_.string());
}

SheetFile::~SheetFile() = default;

std::vector<SheetEntry> SheetFile::allocate(const std::string& name, const Sheet& sheet,
                                            int count) {
    if (count < 1) throw BadArgument(fmt::format("{} sheets: at least one is needed", count));
    std::vector<SheetEntry> sheets = sheets_;
    for (int page = 1; page <= count; ++page) {
        SheetEntry entry;
        entry.name = count == 1 || name.empty() ? name : fmt::format("{}-{}", name, page);
        entry.page = page;
        entry.sheet = sheet;
        entry.sheet.origin = files::free_origin(sheets, sheet.columns, sheet.rows);
        files::append(entry, sheets);
    }
    sheets_ = std::move(sheets);
    return {sheets_.end() - count, sheets_.end()};
}

SheetEntry SheetFile::allocate(SheetEntry entry) {
    entry.sheet.origin = files::free_origin(sheets_, entry.sheet.columns, entry.sheet.rows);
    files::append(entry, sheets_);
    return entry;
}

void SheetFile::add(const SheetEntry& entry) {
    files::append(entry, sheets_);
}

void SheetFile::replace(const SheetEntry& entry) {
    const auto found = std::ranges::find(sheets_, entry.name, &SheetEntry::name);
    if (found == sheets_.end()) {
        throw BadArgument(fmt::format("{} has no sheet '{}'", path_.string(), entry.name));
    }
    files::check_beside(entry, sheets_, &*found);
    *found = entry;
}

void SheetFile::rename(const std::string& name, const std::string& new_name) {
    const auto found = std::ranges::find(sheets_, name, &SheetEntry::name);
    if (found == sheets_.end()) {
        throw BadArgument(fmt::format("{} has no sheet '{}'", path_.string(), name));
    }
    SheetEntry entry = *found;
    entry.name = new_name;
    files::check_beside(entry, sheets_, &*found);
    *found = entry;
    const auto before = names_in_text_.extract(name);
    names_in_text_[new_name] = before.empty() ? name : before.mapped();
}

void SheetFile::remove(const std::string& name) {
    std::erase_if(sheets_, [&](const SheetEntry& entry) { return entry.name == name; });
}

void SheetFile::save() {
    if (text_of(path_) != text_) {
        throw Error(
            fmt::format("{} was changed by another program in the meantime; nothing was written",
                        path_.string()));
    }
    std::string text = files::json_from_sheets(sheets_, text_, names_in_text_);
    write_file(path_, text);
    text_ = std::move(text);
    names_in_text_.clear();
}

}  // namespace dotpose
