/// Sheet files: which region of the code plane is printed on which page, and where the page lies in
/// the world. The format is described in docs/sheet-files.md.
///
///     const std::vector<SheetEntry> sheets = read_sheets("sheets.json");
///
/// sheet_place.hpp finds where a fix lies on them.
///
/// To print sheets, reserve their regions first, so that no page is ever without its entry:
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

/// Version of the format that is written, and the only one that is read.
inline constexpr int kSheetFileVersion = 1;

/// Number of cells left free around every allocated region. It is more than the diagonal of the
/// largest frame (4096 x 4096 px, 6 px per spacing: 966 cells), so that a frame that shows two
/// sheets, located by the dots of one of them, is never taken for the other.
inline constexpr std::uint32_t kSheetGap_cells = 1024;

/// Place and direction of a page in the world.
struct WorldPose {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;  ///< counter-clockwise from the world's x axis
};

/// How a page was printed: what is needed, besides the sheet, to print the very same page again.
struct SheetPrint {
    std::string title;          ///< what the page and its document call themselves
    int pages = 1;              ///< pages of the document, or those of it that got dots
    double dpi = 600;           ///< resolution of the printer
    std::string dots = "auto";  ///< how a PDF draws dots: "auto", "glyphs" or "strokes"
    bool has_labels = true;     ///< whether a PDF has text and rulers in the margins
    std::string command;        ///< makes the same dots on the same page again
    std::string document;       ///< PDF over which the dots were laid; empty if there was none
};

/// One page of a sheet file.
struct SheetEntry {
    std::string name;  ///< unique in the file
    int page = 1;      ///< number among the pages that were printed together, from 1
    Sheet sheet;
    /// Printed length of a unit length, 0.5 to 2. The scale is about the first intersection, whose
    /// place on the page is (sheet.origin_x_mm, sheet.origin_y_mm) at any scale.
    double print_scale_x = 1;
    double print_scale_y = 1;
    AxisScale print_scale() const { return {print_scale_x, print_scale_y}; }
    /// Where the top left corner of the page lies in the world, and the direction in which the
    /// page's upper edge runs from there. None: not known.
    std::optional<WorldPose> world;
    /// None: entered by an earlier version, or not by printing.
    std::optional<SheetPrint> print;
    /// Whether the region is taken although the page may not exist: it is being written, or the
    /// program that wrote it was stopped.
    bool is_reserved = false;
};

/// Checks one entry: a name that is not empty and is UTF-8 without characters that act on a
/// terminal; page at least 1; scales in their range; world finite; of `print`, pages at least 1, a
/// resolution above 0 and a known way to draw dots; and `validate(sheet)`. Throws BadArgument.
void validate(const SheetEntry& entry);

/// Whether some cell belongs to both sheets. Different sections never overlap. The profiles anoto
/// and libdots agree on most of the plane, so they count as one; microdots is another.
bool overlap(const Sheet& a, const Sheet& b);

/// Reads a sheet file. Throws Error, naming the file and the key concerned: the file cannot be
/// read, is no sheet file or of another version, a key is missing, has the wrong type or a value
/// out of range, a name occurs twice, two regions overlap.
std::vector<SheetEntry> read_sheets(const std::filesystem::path& path);

/// How to wait while another program changes a sheet file.
struct SheetFileWait {
    /// Longest time to wait, in seconds.
    double most_s = 60;
    /// Called once with a message, if there is anything to wait for.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    /// Called now and then; true ends the wait.
    std::function<bool()> stop = [] { return false; };
};

/// Exclusive use of a sheet file, to change it. Other writers wait until the object is destroyed;
/// readers do not wait. Not for use by several threads at once.
class SheetFile {
  public:
    /// Waits for the exclusive use, then reads the file; one that does not exist has no sheets.
    /// Throws Error as `read_sheets`, or if the file cannot be locked, also because another program
    /// has it for longer than `wait` allows.
    explicit SheetFile(const std::filesystem::path& path, const SheetFileWait& wait = {});
    ~SheetFile();
    SheetFile(const SheetFile&) = delete;
    SheetFile& operator=(const SheetFile&) = delete;

    const std::vector<SheetEntry>& sheets() const { return sheets_; }

    /// Adds `count` pages like `sheet`, each in the next free region; `sheet.origin` does not
    /// matter. A single page gets the name as it is, several get "name-1", "name-2" and so on.
    ///
    /// The next free region is the topmost, then leftmost one that keeps kSheetGap_cells from the
    /// ends of the plane and from the regions of all other sheets, whatever their profile and
    /// section: allocated sheets differ in their cells alone.
    ///
    /// Returns the added entries. Throws BadArgument: as `validate`, a name that is taken, a full
    /// plane, a count below 1.
    std::vector<SheetEntry> allocate(const std::string& name, const Sheet& sheet, int count = 1);

    /// Adds one page, with its own name and number, in the next free region, as above.
    SheetEntry allocate(SheetEntry entry);

    /// Adds a sheet whose region was chosen elsewhere; it may touch others but not overlap them.
    /// Throws BadArgument: as `validate`, and if the name or the region is taken (saying by which
    /// sheet).
    void add(const SheetEntry& entry);

    /// Replaces the sheet that has the name of `entry`. Throws BadArgument as `add`, or if there is
    /// no such sheet.
    void replace(const SheetEntry& entry);

    /// Gives the sheet `name` another name; the keys that this version does not know stay with it.
    /// Throws BadArgument: there is no such sheet, the new name is taken or not valid.
    void rename(const std::string& name, const std::string& new_name);

    /// Removes the sheet of this name, if there is one.
    void remove(const std::string& name);

    /// Writes the file completely or not at all. Keys of the old file that this version does not
    /// know are kept. Throws Error: the file cannot be written, or an editor changed it in the
    /// meantime.
    void save();

  private:
    friend class SheetReservation;

    /// The right to change the file, held by a lock on a hidden file beside it.
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
    std::optional<std::string> text_;  ///< the file as it was read or saved; none if it did not
                                       ///< exist
    std::vector<SheetEntry> sheets_;
    std::map<std::string, std::string> names_in_text_;  ///< of renamed sheets: by the new name, the
                                                        ///< one in `text_`
};

/// Sheets that are entered before their pages are written. They are marked as reserved, so that
/// their regions stay taken even if this program is killed; the mark goes once they are confirmed.
/// Other programs may change the file in between.
class SheetReservation {
  public:
    /// Calls `enter` to add the sheets. Throws Error as SheetFile; nothing is reserved then.
    SheetReservation(const std::filesystem::path& path,
                     const std::function<void(SheetFile&)>& enter, const SheetFileWait& wait = {});
    /// Removes what was not confirmed, if possible; a file that nobody else changed becomes what it
    /// was.
    ~SheetReservation();
    SheetReservation(const SheetReservation&) = delete;
    SheetReservation& operator=(const SheetReservation&) = delete;

    /// Removes the marks, because the pages exist. Throws Error: the file cannot be changed, and
    /// the sheets stay reserved; or another program removed them and gave their cells away.
    void confirm();

  private:
    void release();

    std::filesystem::path path_;
    SheetFileWait wait_;
    std::vector<SheetEntry> entries_;         ///< entries that are reserved and not confirmed
    std::optional<std::string> text_before_;  ///< the file before; none if it did not exist
    std::optional<std::string> text_reserved_;
};

}  // namespace dotpose

#pragma GCC visibility pop
