#include "dotpose/sheet_file.hpp"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "input_file.hpp"
#include "output_file.hpp"
#include "sheet_json.hpp"
#include "sheet_list.hpp"
#include "system_error.hpp"

namespace dotpose {
namespace fs = std::filesystem;
using print::throw_system;
namespace {

/// Some 100,000 sheets.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;

std::optional<std::string> text_of(const fs::path& path) {
    return print::text_of(path, kMostBytes);
}

}  // namespace

std::vector<SheetEntry> read_sheets(const fs::path& path) {
    const auto text = text_of(path);
    if (!text) throw_system("read", path, ENOENT);
    return print::sheets_from_json(*text, path.string());
}

SheetFile::Lock::Lock(const fs::path& path) : path_(path) {
    path_.replace_filename(fmt::format(".{}.lock", path.filename().string()));
    while (true) {
        descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw_system("lock", path, errno);
        int result = 0;
        do {
            result = flock(descriptor_, LOCK_EX);
        } while (result != 0 && errno == EINTR);
        if (result != 0) {
            const int error_number = errno;
            close(descriptor_);
            throw_system("lock", path, error_number);
        }
        // The one before removes the file: a lock on what is no longer there locks nobody out.
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

// Whoever names the file by a link must wait for the same lock as the others.
SheetFile::SheetFile(const fs::path& path)
    : path_(print::without_links(path)), lock_(path_), text_(text_of(path_)) {
    if (text_) sheets_ = print::sheets_from_json(*text_, path_.string());
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
        entry.sheet.origin = print::free_origin(sheets, sheet.columns, sheet.rows);
        print::append(entry, sheets);
    }
    sheets_ = std::move(sheets);
    return {sheets_.end() - count, sheets_.end()};
}

SheetEntry SheetFile::allocate(SheetEntry entry) {
    entry.sheet.origin = print::free_origin(sheets_, entry.sheet.columns, entry.sheet.rows);
    print::append(entry, sheets_);
    return entry;
}

void SheetFile::add(const SheetEntry& entry) {
    print::append(entry, sheets_);
}

void SheetFile::replace(const SheetEntry& entry) {
    const auto found = std::ranges::find(sheets_, entry.name, &SheetEntry::name);
    if (found == sheets_.end()) {
        throw BadArgument(fmt::format("{} has no sheet '{}'", path_.string(), entry.name));
    }
    print::check_beside(entry, sheets_, &*found);
    *found = entry;
}

void SheetFile::save() {
    if (text_of(path_) != text_) {
        throw Error(fmt::format("{} was changed by somebody else meanwhile; nothing was written",
                                path_.string()));
    }
    std::string text = print::json_from_sheets(sheets_, text_);
    print::OutputFile file(path_);
    file.write(text);
    file.commit();
    text_ = std::move(text);
}

}  // namespace dotpose
