#include "sheet_edits.hpp"

#include <algorithm>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/core.h>

#include "dotpose/files/error.hpp"
#include "system/path.hpp"

namespace dotpose::cli {
namespace {

constexpr std::size_t kMaxSteps = 200;

const SheetEntry* find(const std::vector<SheetEntry>& sheets, const std::string& name) {
    const auto found = std::ranges::find(sheets, name, &SheetEntry::name);
    return found == sheets.end() ? nullptr : &*found;
}

}  // namespace

SheetEdits::SheetEdits(std::string path, SheetFileWait wait)
    : path_(std::move(path)), wait_(std::move(wait)), read_state_(state()) {
    take(read_sheets(this->path()));
}

std::filesystem::path SheetEdits::path() const {
    return system::path_of(path_);
}

SheetEdits::FileState SheetEdits::state() const {
    std::error_code failed;
    FileState now;
    now.identity = identity_of(path_);
    now.changed_at = std::filesystem::last_write_time(path(), failed);
    now.bytes = std::filesystem::file_size(path(), failed);
    return now;
}

bool SheetEdits::refresh() {
    const FileState now = state();
    if (now == read_state_) return false;
    read_state_ = now;
    try {
        take(read_sheets(path()));
        problem_.clear();
    } catch (const Error& error) {
        problem_ = error.what();
    }
    return true;
}

SheetEdits::Values SheetEdits::values_of(const SheetEntry& entry) {
    Values values;
    if (const auto& world = entry.world) values.world = {world->x_m, world->y_m, world->yaw_rad};
    values.print_scale = {entry.print_scale_x, entry.print_scale_y};
    values.origin_mm = {entry.sheet.origin_x_mm, entry.sheet.origin_y_mm};
    return values;
}

SheetEntry SheetEdits::with_values(SheetEntry entry, const Values& values) {
    entry.world.reset();
    if (const auto& world = values.world) entry.world = {(*world)[0], (*world)[1], (*world)[2]};
    std::tie(entry.print_scale_x, entry.print_scale_y) =
        std::tie(values.print_scale[0], values.print_scale[1]);
    std::tie(entry.sheet.origin_x_mm, entry.sheet.origin_y_mm) =
        std::tie(values.origin_mm[0], values.origin_mm[1]);
    return entry;
}

bool SheetEdits::is_same_sheet(const SheetEntry& a, const SheetEntry& b) {
    const auto layout = [](const Sheet& sheet) {
        const Pattern& pattern = sheet.pattern;
        return std::tuple(pattern.code, pattern.section.u, pattern.section.v, pattern.spacing_mm,
                          sheet.origin.x, sheet.origin.y, sheet.columns, sheet.rows, sheet.width_mm,
                          sheet.height_mm);
    };
    return values_of(a) == values_of(b) && layout(a.sheet) == layout(b.sheet);
}

/// Stores the sheets. Sheets that have changed get a new revision.
void SheetEdits::take(const std::vector<SheetEntry>& sheets) {
    sheets_ = sheets;
    std::map<std::string, Known> known;
    const std::int64_t before_all = newest_revision_;
    for (const SheetEntry& entry : sheets_) {
        const auto before = known_.find(entry.name);
        const bool is_same = before != known_.end() && is_same_sheet(before->second.entry, entry);
        known[entry.name] = {is_same ? before->second.revision : ++newest_revision_, entry};
    }
    if (newest_revision_ != before_all || known.size() != known_.size()) ++version_;
    known_ = std::move(known);
}

std::int64_t SheetEdits::revision(const std::string& name) const {
    const auto found = known_.find(name);
    return found == known_.end() ? 0 : found->second.revision;
}

SheetEntry SheetEdits::require(const Target& target) const {
    const SheetEntry* entry = find(sheets_, target.name);
    if (entry == nullptr) {
        throw Error(
            fmt::format("there is no sheet '{}' any more; nothing was written", target.name));
    }
    if (revision(target.name) != target.revision) {
        throw Error(
            fmt::format("'{}' was changed by someone else in the meantime, so nothing was written; "
                        "the page shows its new values now",
                        target.name));
    }
    return *entry;
}

void SheetEdits::save(SheetFile& file, Step step) {
    file.save();
    take(file.sheets());
    read_state_ = state();
    problem_.clear();
    undo_.push_back(std::move(step));
    if (undo_.size() > kMaxSteps) undo_.erase(undo_.begin());
}

SheetEntry SheetEdits::change(const Target& target, const std::string& what, const Change& change) {
    SheetFile file(path(), wait_);
    take(file.sheets());
    const SheetEntry before = require(target);
    const SheetEntry after = change(before);
    const SheetStep step{before, after};
    apply(file, step);
    save(file, {fmt::format("{} '{}'", what, target.name), {step}});
    redo_.clear();
    return after;
}

void SheetEdits::remove(const Target& target) {
    SheetFile file(path(), wait_);
    take(file.sheets());
    const SheetStep step{require(target), std::nullopt};
    if (file.sheets().size() < 2) {
        throw Error(
            fmt::format("'{}' is the only sheet of the file, and this run needs a sheet: end the "
                        "run, and remove it with 'dotpose sheets remove'",
                        target.name));
    }
    apply(file, step);
    save(file, {fmt::format("remove '{}'", target.name), {step}});
    redo_.clear();
}

/// Returns true if the sheet in the file is equal to `step.before`, or if the step adds a sheet.
bool SheetEdits::is_unchanged(const SheetStep& step) const {
    if (!step.before) return true;
    const SheetEntry* entry = find(sheets_, step.before->name);
    return entry != nullptr && is_same_sheet(*entry, *step.before);
}

/// Applies a step to the file.
void SheetEdits::apply(SheetFile& file, const SheetStep& step) {
    if (!step.after) {
        file.remove(step.before->name);
        return;
    }
    if (!step.before) {
        file.add(*step.after);
        return;
    }
    const std::string& name = step.after->name;
    if (step.before->name != name) file.rename(step.before->name, name);
    file.replace(with_values(*find(file.sheets(), name), values_of(*step.after)));
}

void SheetEdits::change_all(const std::vector<Target>& targets,
                            const std::vector<SheetEntry>& measured, const std::string& what) {
    SheetFile file(path(), wait_);
    take(file.sheets());
    Step step{what, {}};
    for (const SheetEntry& entry : measured) {
        const auto target = std::ranges::find(targets, entry.name, &Target::name);
        const SheetEntry before =
            require(target == targets.end() ? Target{entry.name, 0} : *target);
        SheetEntry after = before;
        after.world = entry.world;
        after.print_scale_x = entry.print_scale_x;
        after.print_scale_y = entry.print_scale_y;
        file.replace(after);
        step.sheets.push_back({before, after});
    }
    save(file, std::move(step));
    redo_.clear();
}

void SheetEdits::confirm(const std::string& name) {
    SheetFile file(path(), wait_);
    const SheetEntry* found = find(file.sheets(), name);
    if (found == nullptr || !found->is_reserved) return;
    SheetEntry entry = *found;
    entry.is_reserved = false;
    file.replace(entry);
    file.save();
}

std::string SheetEdits::undo() {
    return move_step(undo_, redo_, true);
}

std::string SheetEdits::redo() {
    return move_step(redo_, undo_, false);
}

std::string SheetEdits::move_step(std::vector<Step>& from, std::vector<Step>& to, bool is_undo) {
    if (from.empty())
        throw Error(is_undo ? "there is nothing to undo" : "there is nothing to redo");
    SheetFile file(path(), wait_);
    take(file.sheets());
    const Step step = from.back();
    for (const SheetStep& done : step.sheets) {
        const SheetStep sheet = is_undo ? SheetStep{done.after, done.before} : done;
        std::string reason;
        if (!is_unchanged(sheet))
            reason = fmt::format("'{}' was changed by someone else since", sheet.before->name);
        try {
            if (reason.empty()) apply(file, sheet);
        } catch (const BadArgument& error) {
            reason = error.what();
        }
        if (reason.empty()) continue;
        from.pop_back();
        throw Error(fmt::format("{}, so \"{}\" can no longer be {}; nothing was written", reason,
                                step.text, is_undo ? "undone" : "redone"));
    }
    file.save();
    take(file.sheets());
    read_state_ = state();
    from.pop_back();
    to.push_back(step);
    return step.text;
}

}  // namespace dotpose::cli
