/// Sheet files: the region of the code plane on each printed page, and the place of the page in the
/// world (docs/sheet-files.md).
///
///     const std::vector<SheetEntry> sheets = read_sheets("sheets.json");
///
/// sheet_place.hpp finds the place of a fix on the sheets.
///
/// To print sheets, reserve their regions first, because every page must have an entry:
///
///     std::vector<SheetEntry> added;
///     SheetReservation reservation("sheets.json", [&](SheetFile& file) {
///         added = file.allocate("table", make_sheet(options));
///     });
///     write_sheet(added[0].sheet, "table.svg");
///     reservation.confirm();
///
/// Frames: *sheet*, mm from the top left corner of the page, x right, y DOWN; *world*, metres,
/// right-handed, z out of the paper, y up, angles counter-clockwise (ROS REP-103).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Version of the format, for writing and reading.
inline constexpr int kSheetFileVersion = 1;

/// Number of free cells around every allocated region. It exceeds the diagonal of the largest frame
/// (4096 x 4096 px, 6 px per spacing: 966 cells): a frame that shows two sheets and is located by
/// the dots of one is therefore never on the other.
inline constexpr std::uint32_t kSheetGap_cells = 1024;

/// Place and direction of a page in the world.
struct WorldPose {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;  ///< counter-clockwise from the world's x axis
};

/// The print parameters of a page, which together with the sheet reproduce the same page.
struct SheetPrint {
    std::string title;          ///< title of the page and its document
    int pages = 1;              ///< number of pages of the document with dots
    double dpi = 600;           ///< resolution of the printer
    std::string dots = "auto";  ///< how a PDF draws dots: "auto", "glyphs" or "strokes"
    bool has_labels = true;     ///< whether a PDF has text and rulers in the margins
    std::string command;        ///< command that makes the same page again
    std::string document;       ///< PDF under the dots; empty if there is none
};

/// One page of a sheet file.
struct SheetEntry {
    std::string name;  ///< unique in the file
    int page = 1;      ///< number among the pages printed together, from 1
    Sheet sheet;
    /// Printed length of a unit length, 0.5 to 2. The scale is about the first intersection, which
    /// is at (sheet.origin_x_mm, sheet.origin_y_mm) at any scale.
    double print_scale_x = 1;
    double print_scale_y = 1;
    AxisScale print_scale() const { return {print_scale_x, print_scale_y}; }
    /// Position of the top left corner of the page in the world, and direction of the upper edge of
    /// the page from this corner. None if not known.
    std::optional<WorldPose> world;
    /// Print parameters; none if the entry was made by an earlier version, or not by printing.
    std::optional<SheetPrint> print;
    /// Whether the region is reserved for a page that may not exist: it is being written, or the
    /// program was stopped while it wrote the page.
    bool is_reserved = false;
};

/// Checks one entry: a non-empty name in UTF-8 without terminal control characters; page at least
/// 1; scales in their range; world finite; for `print`, pages at least 1, a resolution above 0 and
/// a known drawing of dots; and `validate(sheet)`. Throws BadArgument.
void validate(const SheetEntry& entry);

/// Whether two sheets share cells. Different sections never overlap. The code variants anoto and
/// libdots agree on most of the plane, so they count as one; microdots is separate.
bool overlap(const Sheet& a, const Sheet& b);

/// Reads a sheet file. Throws Error with the names of the file and the key: the file cannot be
/// read, is not a sheet file or has another version; a key is missing, has the wrong type or a
/// value out of range; a name occurs twice; two regions overlap.
std::vector<SheetEntry> read_sheets(const std::filesystem::path& path);

/// Options for waiting while another program changes a sheet file.
struct SheetFileWait {
    /// Maximum time to wait, in seconds.
    double most_s = 60;
    /// Called once with a message if the program has to wait.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    /// Called now and then; true ends the wait.
    std::function<bool()> stop = [] { return false; };
};

/// Exclusive access to a sheet file for changing it. Other writers wait until the object is
/// destroyed; readers do not wait. Not thread-safe.
class SheetFile {
  public:
    /// Waits for exclusive access, then reads the file; a missing file has no sheets. Throws Error
    /// as `read_sheets`, or if the file cannot be locked, for example because another program holds
    /// the lock for longer than `wait` allows.
    explicit SheetFile(const std::filesystem::path& path, const SheetFileWait& wait = {});
    ~SheetFile();
    SheetFile(const SheetFile&) = delete;
    SheetFile& operator=(const SheetFile&) = delete;

    const std::vector<SheetEntry>& sheets() const { return sheets_; }

    /// Adds `count` pages like `sheet`, each in the next free region; `sheet.origin` is ignored. A
    /// single page gets the given name, several pages get "name-1", "name-2" and so on.
    ///
    /// The next free region is the topmost, then leftmost region with a distance of kSheetGap_cells
    /// from the ends of the plane and from the regions of all other sheets, whatever their code
    /// variant and section. Allocated sheets therefore differ in their cells alone.
    ///
    /// Returns the added entries. Throws BadArgument: as `validate`, a name that is taken, a full
    /// plane, a count below 1.
    std::vector<SheetEntry> allocate(const std::string& name, const Sheet& sheet, int count = 1);

    /// Adds one page, with its own name and number, in the next free region, as above.
    SheetEntry allocate(SheetEntry entry);

    /// Adds a sheet with a given region, which may touch other regions but not overlap them. Throws
    /// BadArgument: as `validate`, and if the name or the region is taken (with the name of the
    /// other sheet).
    void add(const SheetEntry& entry);

    /// Replaces the sheet with the name of `entry`. Throws BadArgument as `add`, or if there is no
    /// such sheet.
    void replace(const SheetEntry& entry);

    /// Renames the sheet `name` and keeps its unknown keys. Throws BadArgument: there is no such
    /// sheet, the new name is taken or invalid.
    void rename(const std::string& name, const std::string& new_name);

    /// Removes the sheet with this name if it exists.
    void remove(const std::string& name);

    /// Writes the file completely or not at all. Unknown keys of the old file are kept. Throws
    /// Error: the file cannot be written, or an editor has changed it meanwhile.
    void save();

  private:
    friend class SheetReservation;

    /// A lock on a hidden file beside the sheet file.
    class Lock {
      public:
        Lock(const std::filesystem::path& path, const SheetFileWait& wait);
        ~Lock();
        Lock(const Lock&) = delete;
        Lock& operator=(const Lock&) = delete;

      private:
        std::filesystem::path path_;
        int descriptor_ = -1;
    };

    std::filesystem::path path_;
    Lock lock_;
    std::optional<std::string> text_;  ///< the file as read or saved; none if it did not exist
    std::vector<SheetEntry> sheets_;
    std::map<std::string, std::string>
        names_in_text_;  ///< names of renamed sheets in `text_`, by the new name
};

/// Enters sheets before their pages are written. They are marked as reserved: their regions stay
/// taken even if this program is killed. `confirm` removes the mark. Other programs may change the
/// file in between.
class SheetReservation {
  public:
    /// Calls `enter` to add the sheets. Throws Error as SheetFile; nothing is reserved then.
    SheetReservation(const std::filesystem::path& path,
                     const std::function<void(SheetFile&)>& enter, const SheetFileWait& wait = {});
    /// Removes unconfirmed entries if possible; an otherwise unchanged file is restored.
    ~SheetReservation();
    SheetReservation(const SheetReservation&) = delete;
    SheetReservation& operator=(const SheetReservation&) = delete;

    /// Removes the marks, because the pages exist. Throws Error: the file cannot be changed, and
    /// the sheets stay reserved; or another program has removed them and assigned their cells.
    void confirm();

  private:
    void release();

    std::filesystem::path path_;
    SheetFileWait wait_;
    std::vector<SheetEntry> entries_;  ///< reserved and unconfirmed entries
    std::optional<std::string>
        text_before_;  ///< the file before the reservation; none if it did not exist
    std::optional<std::string> text_reserved_;
};

}  // namespace dotpose

#pragma GCC visibility pop
