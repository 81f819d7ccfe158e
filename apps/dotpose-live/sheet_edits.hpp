/// Edits a sheet file, with undo. Other programs may change the file at the same time.
///
/// Each edit locks the file and reads it again. An edit of a sheet is refused if another program
/// has changed this sheet since the user saw it. If a function throws Error or BadArgument, the
/// file is unchanged.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/files/sheet_file.hpp"
#include "run_files.hpp"

namespace dotpose::cli {

class SheetEdits {
  public:
    /// Reads the file. Throws Error like `read_sheets`.
    SheetEdits(std::string path, SheetFileWait wait);

    /// Reads the file if it was changed. Returns true if its sheets or `problem` changed.
    bool refresh();

    /// Returns the sheets as they were last read.
    const std::vector<SheetEntry>& sheets() const { return sheets_; }
    /// Returns the reason why the file could not be read, or an empty string.
    const std::string& problem() const { return problem_; }
    /// Returns the revision of a sheet, which increases with each change of its place, print scale,
    /// offset or region. Returns 0 if there is no such sheet.
    std::int64_t revision(const std::string& name) const;

    /// Returns a number that increases with each change of any sheet.
    std::int64_t version() const { return version_; }

    /// A sheet to edit, with the revision that the user saw.
    struct Target {
        std::string name;
        std::int64_t revision = 0;
    };
    using Change = std::function<SheetEntry(const SheetEntry& before)>;

    /// Changes name, place, print scale or offset of a sheet. `what` describes the edit for `undo`,
    /// such as "move". Returns the new entry.
    SheetEntry change(const Target& target, const std::string& what, const Change& change);

    /// Removes a sheet. Throws Error if it is the only one, because a run needs a sheet. If the
    /// removal is undone, the sheet is added at the end of the file, and keys that dotpose does not
    /// know are lost.
    void remove(const Target& target);

    /// Replaces the places and print scales of several sheets by those in `measured`, in one edit.
    /// `targets` contains the sheets with their revisions at the start of the measurement.
    void change_all(const std::vector<Target>& targets, const std::vector<SheetEntry>& measured,
                    const std::string& what);

    /// Marks a reserved sheet as made, because its page exists now. The change cannot be undone.
    void confirm(const std::string& name);

    /// Returns the description of the edit that `undo` or `redo` would make, such as "move
    /// 'table'", or an empty string if there is none.
    std::string undo_text() const { return undo_.empty() ? "" : undo_.back().text; }
    std::string redo_text() const { return redo_.empty() ? "" : redo_.back().text; }

    /// Undoes or redoes the newest edit. Returns its description, or throws Error if there is none.
    /// If another program has since changed one of the sheets of the edit, throws Error and
    /// discards the edit.
    std::string undo();
    std::string redo();

    const SheetFileWait& wait() const { return wait_; }
    std::filesystem::path path() const;

  private:
    /// Values of a sheet that can be edited.
    struct Values {
        std::optional<std::array<double, 3>> world;
        std::array<double, 2> print_scale{};
        std::array<double, 2> origin_mm{};
        bool operator==(const Values&) const = default;
    };
    /// A changed sheet. `after` is missing if the sheet was removed.
    struct SheetStep {
        std::optional<SheetEntry> before;
        std::optional<SheetEntry> after;
    };
    struct Step {
        std::string text;
        std::vector<SheetStep> sheets;
    };
    struct Known {
        std::int64_t revision = 0;
        SheetEntry entry;
    };
    struct FileState {
        std::optional<FileIdentity> identity;
        std::filesystem::file_time_type changed_at;
        std::uintmax_t bytes = 0;
        bool operator==(const FileState&) const = default;
    };

    static Values values_of(const SheetEntry& entry);
    static SheetEntry with_values(SheetEntry entry, const Values& values);
    static bool is_same_sheet(const SheetEntry& a, const SheetEntry& b);
    FileState state() const;
    void take(const std::vector<SheetEntry>& sheets);
    SheetEntry require(const Target& target) const;
    void save(SheetFile& file, Step step);
    bool is_unchanged(const SheetStep& step) const;
    static void apply(SheetFile& file, const SheetStep& step);
    std::string move_step(std::vector<Step>& from, std::vector<Step>& to, bool is_undo);

    std::string path_;
    SheetFileWait wait_;
    std::optional<FileState> read_state_;
    std::vector<SheetEntry> sheets_;
    std::string problem_;
    std::map<std::string, Known> known_;
    std::int64_t newest_revision_ = 0;
    std::int64_t version_ = 0;
    std::vector<Step> undo_;
    std::vector<Step> redo_;
};

}  // namespace dotpose::cli
