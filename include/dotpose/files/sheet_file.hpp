/// Sheet files: which region of the code plane is which page, and where the page lies in the world.
/// The format is described in docs/sheet-files.md.
///
///     const std::vector<SheetEntry> sheets = read_sheets("sheets.json");
///
/// Where a fix lies on them tells sheet_place.hpp.
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

/// Cells left free around every allocated region. More than the diagonal of the largest frame
/// (4096 x 4096 px, 6 px per spacing: 966 cells), so that a frame that shows two sheets, located by
/// the dots of one of them, is never taken for the other.
inline constexpr std::uint32_t kSheetGap_cells = 1024;

/// Where a page lies: a place and a direction in the world.
struct WorldPose {
    double x_m = 0;
    double y_m = 0;
    double yaw_rad = 0;  ///< counter-clockwise from the world's x axis
};

/// One page of a sheet file.
struct SheetEntry {
    std::string name;  ///< unique in the file
    int page = 1;      ///< its number among the pages it was printed with, from 1
    Sheet sheet;
    /// True length of what was printed as a unit length, 0.5 to 2. The scale is about the first
    /// intersection, whose place on the page is (sheet.origin_x_mm, sheet.origin_y_mm) whatever the
    /// scale.
    double print_scale_x = 1;
    double print_scale_y = 1;
    AxisScale print_scale() const { return {print_scale_x, print_scale_y}; }
    /// Where the top left corner of the page lies in the world, and the direction in which the
    /// page's upper edge runs from there. None: not known.
    std::optional<WorldPose> world;
    /// The region is taken, but whether the page was written is not known: it is being written, or
    /// whoever did that was stopped.
    bool is_reserved = false;
};

/// Checks one entry: name not empty, of UTF-8 without characters that act on a terminal; page at
/// least 1; scales in their range; world finite; and `validate(sheet)`. Throws BadArgument.
void validate(const SheetEntry& entry);

/// Whether some cell belongs to both. Different sections never overlap. The profiles anoto and
/// libdots agree on most of the plane, so they count as one; microdots is another.
bool overlap(const Sheet& a, const Sheet& b);

/// Reads a sheet file. Throws Error, naming the file and the key concerned: the file cannot be
/// read, is no sheet file or of another version, a key is missing, has the wrong type or a value
/// out of range, a name occurs twice, two regions overlap.
std::vector<SheetEntry> read_sheets(const std::filesystem::path& path);

/// How to wait for somebody else who is changing a sheet file.
struct SheetFileWait {
    double most_s = 60;
    /// Told once, if there is anything to wait for.
    std::function<void(const std::string&)> tell = [](const std::string&) {};
    /// Asked now and then; true gives up.
    std::function<bool()> stop = [] { return false; };
};

/// Exclusive use of a sheet file, to change it. Others that want to change it wait for the object's
/// end; who only reads is not kept waiting. Not for use by several threads at once.
class SheetFile {
  public:
    /// Waits for its turn, then reads the file; one that does not exist has no sheets. Throws Error
    /// as `read_sheets`, or if the file cannot be locked, also because somebody else has it for
    /// longer than `wait` allows.
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
    /// Returns what was added. Throws BadArgument: `validate`, a name that is taken, the plane is
    /// full, count below 1.
    std::vector<SheetEntry> allocate(const std::string& name, const Sheet& sheet, int count = 1);

    /// The same for one page with a name and number of its own.
    SheetEntry allocate(SheetEntry entry);

    /// Adds a sheet whose region was chosen by somebody else; it may touch others but not overlap.
    /// Throws BadArgument: `validate`, the name or the region is taken (and by which sheet).
    void add(const SheetEntry& entry);

    /// Puts `entry` in the place of the sheet of the same name.
    /// Throws BadArgument as `add`, or if there is no such sheet.
    void replace(const SheetEntry& entry);

    /// Takes the sheet of this name out, if there is one.
    void remove(const std::string& name);

    /// Writes the file, whole or not at all. Keys of the old file that this version does not know
    /// are kept. Throws Error: it cannot be written, or an editor changed it in the meantime.
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
    std::optional<std::string> text_;  ///< the file as it was read or saved; none if there was none
    std::vector<SheetEntry> sheets_;
};

/// Sheets that are entered before their pages are written: marked as reserved from then on, so that
/// nobody else gets their regions even if this program is killed, and without the mark once they
/// are confirmed. The file is not kept from others in between.
class SheetReservation {
  public:
    /// `enter` adds the sheets. Throws Error as SheetFile; nothing is reserved then.
    SheetReservation(const std::filesystem::path& path,
                     const std::function<void(SheetFile&)>& enter, const SheetFileWait& wait = {});
    /// What was not confirmed is taken out again, if that is possible; an untouched file becomes
    /// what it was.
    ~SheetReservation();
    SheetReservation(const SheetReservation&) = delete;
    SheetReservation& operator=(const SheetReservation&) = delete;

    /// The pages exist. Throws Error: the file cannot be changed, and the sheets stay reserved; or
    /// somebody took them out and gave their cells away.
    void confirm();

  private:
    void release();

    std::filesystem::path path_;
    SheetFileWait wait_;
    std::vector<SheetEntry> entries_;         ///< reserved, and not confirmed
    std::optional<std::string> text_before_;  ///< of the file; none if there was none
    std::optional<std::string> text_reserved_;
};

}  // namespace dotpose

#pragma GCC visibility pop
