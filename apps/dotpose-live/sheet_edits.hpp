/// Edits a sheet file, with undo. Other programs may change the file at any time.
///
/// Each edit locks the file and reads it again. An edit is rejected if another program has changed
/// the sheet since the user last saw it. If a function throws Error or BadArgument, the file has
/// not been changed.
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
    /// Reads the file. Throws the same errors as `read_sheets`.
    SheetEdits(std::string path, SheetFileWait wait);

    /// Reads the file again if it has changed. Returns true if the sheets or `problem` have
    /// changed.
    bool refresh();

    /// Returns the sheets as they were last read.
    const std::vector<SheetEntry>& sheets() const { return sheets_; }
    /// Returns the reason why the file could not be read, or an empty string.
    const std::string& problem() const { return problem_; }
    /// Returns the revision of a sheet, which increases with every change to its world pose, print
    /// scale, offset or region. Returns 0 if there is no such sheet.
    std::int64_t revision(const std::string& name) const;

    /// Returns a number that increases with every change to any sheet.
    std::int64_t version() const { return version_; }

    /// A sheet to edit, with the revision that the user saw.
    struct Target {
        std::string name;
        std::int64_t revision = 0;
    };
    using Change = std::function<SheetEntry(const SheetEntry& before)>;

    /// Changes the name, world pose, print scale or offset of a sheet. `what` is a description for
    /// `undo_text`, such as "move". Returns the new entry.
    SheetEntry change(const Target& target, const std::string& what, const Change& change);

    /// Removes a sheet. Throws Error if it is the only sheet in the file, because `dotpose watch`
    /// needs at least one sheet. If the removal is undone, the sheet is appended to the file, and
    /// any keys in its entry that dotpose does not recognise are lost.
    void remove(const Target& target);

    /// Replaces the world poses and print scales of several sheets with the values in `measured`,
    /// as a single edit. `targets` lists the sheets with their revisions at the start of the
    /// measurement.
    void change_all(const std::vector<Target>& targets, const std::vector<SheetEntry>& measured,
                    const std::string& what);

    /// Marks a sheet as no longer reserved. Must be called after the PDF of the sheet has been
    /// created. This change cannot be undone.
    void confirm(const std::string& name);

    /// Return a description of the edit that `undo` or `redo` would affect, such as "move 'table'",
    /// or an empty string if there is no such edit.
    std::string undo_text() const { return undo_.empty() ? "" : undo_.back().text; }
    std::string redo_text() const { return redo_.empty() ? "" : redo_.back().text; }

    /// Undo or redo the last edit and return its description. Throw Error if there is no such edit.
    /// If another program has meanwhile changed a sheet that the edit affects, discard the edit and
    /// throw Error.
    std::string undo();
    std::string redo();

    const SheetFileWait& wait() const { return wait_; }
    std::filesystem::path path() const;

  private:
    /// The editable values of a sheet.
    struct Values {
        std::optional<std::array<double, 3>> world;
        std::array<double, 2> print_scale{};
        std::array<double, 2> origin_mm{};
        bool operator==(const Values&) const = default;
    };
    /// A change to one sheet. `before` is nullopt if the sheet was added, and `after` is nullopt if
    /// it was removed.
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
