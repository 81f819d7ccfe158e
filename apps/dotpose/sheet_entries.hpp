/// The options --sheets FILE, --name NAME and --wait SECONDS, for commands that print pages and add
/// them to a sheet file.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "command_line.hpp"
#include "dotpose/files/sheet_file.hpp"

namespace dotpose::cli {

class SheetEntryArguments {
  public:
    /// Adds the options. The --origin option must already have been added to the command.
    void add_to(Command& command);

    /// Returns true if a sheet file is given. `reserve`, `enter` and `confirm` require one.
    bool given() const { return !path_.empty(); }
    const std::string& path() const { return path_; }
    const std::string& name() const { return name_; }

    struct Page {
        int number = 1;  ///< page number, starting at 1
        bool is_only = true;
    };

    /// Returns the sheet name of a page: NAME, or NAME-NUMBER if there are several pages.
    std::string page_name(Page page) const;

    /// Reserves the regions of all pages before any page is written. `enter_all` must call `enter`
    /// for every page.
    void reserve(const std::function<void(SheetFile&)>& enter_all,
                 std::optional<SheetReservation>& reservation) const;

    /// Adds a page and its print settings to the file. Places the page in the next free region
    /// unless the user gave --origin. `print.command` must not contain --origin, because this
    /// function appends it. Returns the sheet with its new origin.
    Sheet enter(SheetFile& file, const Sheet& sheet, Page page, SheetPrint print) const;

    /// Returns `command` with --origin appended. The result reprints the page with this origin.
    static std::string with_origin(const std::string& command, Cell origin);

    /// Returns the options to omit from a command that reprints a page. The options for the sheet
    /// file are omitted because they would add the page again under a name that is already in use.
    /// The options --pages and --origin are omitted because they are set for each page separately.
    static std::set<std::string> options_of_entering();

    /// Records that the reserved pages have been written to `out`. Throws Error if the sheet file
    /// cannot be changed.
    void confirm(SheetReservation& reservation, const std::string& out) const;

    /// Returns ", sheet 'NAME' of FILE", or an empty string if there is no sheet file.
    std::string summary(Page page) const;

  private:
    std::string path_;
    std::string name_;
    double wait_s_ = SheetFileWait{}.max_s;
    const Option* origin_ = nullptr;
};

}  // namespace dotpose::cli
