#include "dotpose/files/sheet_file.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <system_error>
#include <thread>

#include <fmt/core.h>

#include "base/system_error.hpp"
#include "dotpose/files/write_file.hpp"
#include "files/input_file.hpp"
#include "files/sheet_json.hpp"
#include "files/sheet_list.hpp"
#include "system/file_lock.hpp"
#include "system/path.hpp"

namespace dotpose {
namespace fs = std::filesystem;
using base::throw_system;
namespace {

/// Maximum size of a sheet file, sufficient for about 100,000 sheets.
constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

std::optional<std::string> text_of(const fs::path& path) {
    return files::text_of(path, kMaxBytes);
}

/// Acquires the lock of a sheet file. Throws Error if the lock cannot be acquired within
/// `wait.max_s`, if `wait.stop` returns true, or if the file system does not support locks.
void take(system::FileLock& lock, const fs::path& path, const SheetFileWait& wait) {
    using Clock = std::chrono::steady_clock;
    constexpr auto kPause = std::chrono::milliseconds(10);
    const auto end = Clock::now() + std::chrono::duration<double>(wait.max_s);
    bool is_reported = false;
    for (std::error_code error = lock.try_lock(); error; error = lock.try_lock()) {
        if (error != std::errc::resource_unavailable_try_again) throw_system("lock", path, error);
        if (wait.stop()) throw Error("stopped; nothing was written");
        if (Clock::now() >= end) {
            throw Error(
                fmt::format("cannot lock {}: another program has been changing it for {:g} s",
                            path.string(), wait.max_s));
        }
        if (!is_reported) {
            wait.notify(
                fmt::format("waiting for another program that is changing {}", path.string()));
        }
        is_reported = true;
        std::this_thread::sleep_for(kPause);
    }
}

fs::path lock_path_of(fs::path path) {
    path.replace_filename(system::path_of(fmt::format(".{}.lock", path.filename().string())));
    return path;
}

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

// Symbolic links are resolved first, because all names of a file must use the same lock.
SheetFile::SheetFile(const fs::path& path, const SheetFileWait& wait)
    : path_(without_links(path)), lock_(std::make_unique<system::FileLock>(lock_path_of(path_))) {
    take(*lock_, path_, wait);
    text_ = text_of(path_);
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
