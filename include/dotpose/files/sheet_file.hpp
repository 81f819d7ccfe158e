/// Sheet files list the printed pages: the region of the code plane on each page, and the pose of
/// the page in the world (docs/sheet-files.md).
///
///     const std::vector<SheetEntry> sheets = read_sheets("sheets.json");
///
/// `find_sheet` (sheet_place.hpp) returns the place of a fix on the sheets.
///
/// To print sheets, reserve their regions first, because every printed page must have an entry:
///
///     std::vector<SheetEntry> added;
///     SheetReservation reservation("sheets.json", [&](SheetFile& file) {
///         added = file.allocate("table", make_sheet(options));
///     });
///     write_sheet(added[0].sheet, "table.svg");
///     reservation.confirm();
///
/// Coordinate frames: *sheet*, mm from the top left corner of the page, x right, y DOWN; *world*,
/// metres, right-handed, z out of the paper, y up, angles counter-clockwise (ROS REP-103).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose::system {
class FileLock;
}

namespace dotpose {

/// Version of the sheet file format. `read_sheets` accepts no other version.
inline constexpr int kSheetFileVersion = 1;

/// Width, in cells, of the free border around every allocated region. The width exceeds the maximum
/// diagonal of a frame, which is 966 cells (4096 x 4096 px at 6 px per spacing). Therefore, even if
/// a frame shows two sheets, the pose computed from the dots of one sheet is never in the region of
/// the other sheet.
inline constexpr std::uint32_t kSheetGap_cells = 1024;

/// Pose of a page in the world.
struct WorldPose {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;  ///< counter-clockwise from the world's x axis
};

/// Print parameters of a page. Together with the sheet, they are sufficient to print the page
/// again.
struct SheetPrint {
    std::string title;          ///< first label of the page, and title of the document
    int pages = 1;              ///< number of pages with dots in the document
    double dpi = 600;           ///< resolution of the printer
    std::string dots = "auto";  ///< method of drawing dots in a PDF: "auto", "glyphs" or "strokes"
    bool has_labels = true;     ///< true if the PDF has text and rulers in the margins
    std::string command;        ///< command that reprints the page
    std::string document;       ///< PDF document to which the dots were added, or empty
};

/// One page of a sheet file.
struct SheetEntry {
    std::string name;  ///< name of the page, unique in the file
    int page = 1;      ///< number of the page within its print job, starting at 1
    Sheet sheet;
    /// Ratio of the printed to the nominal length, 0.5 to 2. The page is scaled about the first
    /// intersection, which is at (sheet.origin_x_mm, sheet.origin_y_mm) whatever the scale.
    double print_scale_x = 1;
    double print_scale_y = 1;
    AxisScale print_scale() const { return {print_scale_x, print_scale_y}; }
    /// World pose of the page: the position of its top left corner, and the direction of its upper
    /// edge, seen from this corner. None if not known.
    std::optional<WorldPose> world;
    /// Print parameters. None if the entry was created by an earlier version of dotpose, or was not
    /// created by printing.
    std::optional<SheetPrint> print;
    /// True if the region is reserved for a page that may not exist yet: the page is still being
    /// written, or the program was stopped while writing it.
    bool is_reserved = false;
};

/// Checks one entry. Throws BadArgument in these cases:
/// - The name is empty, is not UTF-8, or contains terminal control characters.
/// - The page number is below 1.
/// - A print scale is out of range.
/// - The world pose is not finite.
/// - `sheet` is invalid (see `validate(const Sheet&)`).
/// - `print` has no pages, a resolution of 0 or less, or an unknown method of drawing dots.
void validate(const SheetEntry& entry);

/// Returns true if two sheets have cells in common. Sheets in different sections never overlap. The
/// code variants anoto and libdots are treated as one variant, because their dots are identical on
/// most of the plane.
bool overlap(const Sheet& a, const Sheet& b);

/// Reads a sheet file. Throws Error, with the file name and the key in the message, in these cases:
/// - The file cannot be read, is not a sheet file, or has another version.
/// - A key is missing, has the wrong type, or has a value out of range.
/// - A name occurs twice, or two regions overlap.
std::vector<SheetEntry> read_sheets(const std::filesystem::path& path);

/// Options for waiting while another program changes a sheet file.
struct SheetFileWait {
    /// Maximum time to wait, in seconds.
    double max_s = 60;
    /// Called once with a message if the program has to wait.
    std::function<void(const std::string&)> notify = [](const std::string&) {};
    /// Called repeatedly during the wait. Returning true ends the wait with an Error.
    std::function<bool()> stop = [] { return false; };
};

/// Exclusive write access to a sheet file. Other writers wait until the object is destroyed.
/// Readers do not wait. Not thread-safe.
class SheetFile {
  public:
    /// Waits for exclusive access, then reads the file. A missing file is treated as a file without
    /// sheets. Throws Error if the file exists but cannot be read or is not valid (see
    /// `read_sheets`). Also throws Error if the file cannot be locked, for example because another
    /// program holds the lock for longer than `wait` allows.
    explicit SheetFile(const std::filesystem::path& path, const SheetFileWait& wait = {});
    ~SheetFile();
    SheetFile(const SheetFile&) = delete;
    SheetFile& operator=(const SheetFile&) = delete;

    const std::vector<SheetEntry>& sheets() const { return sheets_; }

    /// Adds `count` pages with the layout of `sheet`, each in the next free region. Ignores
    /// `sheet.origin`. A single page is called `name`. Several pages are called "name-1", "name-2"
    /// and so on.
    ///
    /// A free region is at least kSheetGap_cells away from the edges of the plane and from all
    /// other regions, regardless of their code variant and section. The coordinates of a cell are
    /// therefore sufficient to identify an allocated sheet. The next free region is the topmost
    /// one. Ties are broken by taking the leftmost.
    ///
    /// Returns the added entries. Throws BadArgument if an entry would not be valid (see
    /// `validate`), if the name is taken, if the plane is full, or if the count is below 1.
    std::vector<SheetEntry> allocate(const std::string& name, const Sheet& sheet, int count = 1);

    /// Adds one page, with the name and page number in `entry`, in the next free region. Ignores
    /// `entry.sheet.origin`. Returns the added entry. Throws BadArgument if the entry is not valid
    /// (see `validate`), if the name is taken, or if the plane is full.
    SheetEntry allocate(SheetEntry entry);

    /// Adds a sheet with a given region. The region may touch other regions, but must not overlap
    /// them. Throws BadArgument if the entry is not valid (see `validate`), if the name is taken,
    /// or if the region overlaps the region of another sheet. The message names the other sheet.
    void add(const SheetEntry& entry);

    /// Replaces the sheet that has the same name as `entry`. Throws BadArgument if there is no such
    /// sheet, if the entry is not valid (see `validate`), or if the region overlaps the region of
    /// another sheet.
    void replace(const SheetEntry& entry);

    /// Renames the sheet `name`. Preserves unrecognised keys of this sheet in the file. Throws
    /// BadArgument if the sheet does not exist, or if the new name is taken or invalid.
    void rename(const std::string& name, const std::string& new_name);

    /// Removes the sheet with this name, if there is one.
    void remove(const std::string& name);

    /// Writes the file atomically. Preserves unrecognised keys of the previous file. Throws Error
    /// if the file cannot be written, or if a program that does not use the lock, such as an
    /// editor, has changed the file since it was read.
    void save();

  private:
    friend class SheetReservation;

    std::filesystem::path path_;
    std::unique_ptr<system::FileLock> lock_;  ///< lock on a hidden file beside the sheet file
    /// Contents of the file as last read or saved. None if the file did not exist.
    std::optional<std::string> text_;
    std::vector<SheetEntry> sheets_;
    /// Maps the new name of each renamed sheet to its name in `text_`.
    std::map<std::string, std::string> names_in_text_;
};

/// Adds sheets to a sheet file before their pages are written. The sheets are marked as reserved,
/// and keep their regions even if this program is killed. `confirm` removes the mark. The file is
/// not locked in the meantime, so other programs can change it.
class SheetReservation {
  public:
    /// Calls `enter` to add the sheets, and saves the file. Throws Error if the file cannot be
    /// read, locked or written, and propagates exceptions thrown by `enter`. After an exception, no
    /// region is reserved.
    SheetReservation(const std::filesystem::path& path,
                     const std::function<void(SheetFile&)>& enter, const SheetFileWait& wait = {});
    /// Removes the entries that were not confirmed. Restores the previous file if no other program
    /// has changed it. If the file cannot be changed, the entries remain reserved, and
    /// SheetFileWait::notify is called with a message.
    ~SheetReservation();
    SheetReservation(const SheetReservation&) = delete;
    SheetReservation& operator=(const SheetReservation&) = delete;

    /// Removes the marks from the reserved sheets. Call this after the pages have been written.
    /// If another program has removed the sheets in the meantime, adds them again. Throws Error if
    /// the file cannot be changed, or if another program has assigned the names or cells of the
    /// reserved sheets to other sheets. After an Error, the file is unchanged.
    void confirm();

  private:
    void release();

    std::filesystem::path path_;
    SheetFileWait wait_;
    std::vector<SheetEntry> entries_;  ///< reserved and unconfirmed entries
    /// Text of the file before the reservation. None if the file did not exist.
    std::optional<std::string> text_before_;
    std::optional<std::string> text_reserved_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
