// Reserves regions in a sheet file while their pages are written.
#include <algorithm>
#include <system_error>

#include <fmt/core.h>

#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/write_file.hpp"

namespace dotpose {
namespace fs = std::filesystem;
namespace {

const SheetEntry* find(const SheetFile& file, const std::string& name) {
    const auto found = std::ranges::find(file.sheets(), name, &SheetEntry::name);
    return found == file.sheets().end() ? nullptr : &*found;
}

/// Returns true if two sheets have the same region. Two sheets with the same name may have
/// different regions, because the name may have been reassigned.
bool is_same_region(const Sheet& a, const Sheet& b) {
    return a.origin == b.origin && a.columns == b.columns && a.rows == b.rows &&
           a.pattern.code == b.pattern.code && a.pattern.section == b.pattern.section;
}

}  // namespace

SheetReservation::SheetReservation(const fs::path& path,
                                   const std::function<void(SheetFile&)>& enter,
                                   const SheetFileWait& wait)
    : path_(path), wait_(wait) {
    SheetFile file(path_, wait_);
    const std::size_t before = file.sheets().size();
    enter(file);
    for (std::size_t i = before; i < file.sheets().size(); ++i) {
        SheetEntry entry = file.sheets()[i];
        entry.is_reserved = true;
        file.replace(entry);
        entries_.push_back(entry);
    }
    text_before_ = file.text_;
    try {
        file.save();
    } catch (const Error&) {
        entries_.clear();
        throw;
    }
    text_reserved_ = file.text_;
}

SheetReservation::~SheetReservation() {
    if (entries_.empty()) return;
    try {
        release();
    } catch (const Error& error) {
        wait_.notify(fmt::format("{}; the regions reserved in {} remain reserved", error.what(),
                                 path_.string()));
    }
}

void SheetReservation::confirm() {
    // Moves the entries out of `entries_`, so the destructor does not release them. If this
    // function fails, the entries remain marked as reserved in the file, and their regions are not
    // assigned to other sheets.
    const std::vector<SheetEntry> entries = std::move(entries_);
    entries_.clear();
    SheetFile file(path_, wait_);
    for (SheetEntry entry : entries) {
        // Reads the entry again, because another program may have added a world pose in the
        // meantime.
        const SheetEntry* now = find(file, entry.name);
        if (now != nullptr && !is_same_region(now->sheet, entry.sheet)) {
            throw Error(
                fmt::format("the name '{}' in {} was given to another sheet in the meantime",
                            entry.name, path_.string()));
        }
        if (now != nullptr) entry = *now;
        entry.is_reserved = false;
        now != nullptr ? file.replace(entry) : file.add(entry);
    }
    file.save();
}

void SheetReservation::release() {
    SheetFile file(path_, wait_);
    if (file.text_ == text_reserved_) {
        if (!text_before_) {
            fs::remove(file.path_);
            return;
        }
        write_file(file.path_, *text_before_);
        return;
    }
    for (const SheetEntry& entry : entries_) {
        const SheetEntry* now = find(file, entry.name);
        if (now != nullptr && now->is_reserved && is_same_region(now->sheet, entry.sheet)) {
            file.remove(entry.name);
        }
    }
    file.save();
}

}  // namespace dotpose
