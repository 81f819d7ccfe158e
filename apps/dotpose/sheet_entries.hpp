/// The options --sheets FILE, --name NAME and --wait SECONDS of commands that print pages and add
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
    /// Adds the options. The command must already have the option --origin.
    void add_to(Command& command);

    /// Returns true if a sheet file is given. The functions below require a sheet file.
    bool given() const { return !path_.empty(); }
    const std::string& path() const { return path_; }
    const std::string& name() const { return name_; }

    struct Page {
        int number = 1;  ///< page number, counted from 1
        bool is_only = true;
    };

    /// Returns the name of a page in the file: NAME, or NAME-NUMBER if there are several pages.
    std::string page_name(Page page) const;

    /// Reserves the regions of all pages before any page is written. `enter_all` must call `enter`
    /// for each page.
    void reserve(const std::function<void(SheetFile&)>& enter_all,
                 std::optional<SheetReservation>& reservation) const;

    /// Adds a page and its print settings to the file. If the user did not give --origin, the page
    /// is placed in the next free region. `print.command` must not contain --origin, because this
    /// function adds it. Returns the sheet with its new origin.
    Sheet enter(SheetFile& file, const Sheet& sheet, Page page, SheetPrint print) const;

    /// Appends --origin to `command`, so that the command prints the dots of one page.
    static std::string with_origin(const std::string& command, Cell origin);

    /// Returns the options that must be omitted from a command that reprints a page. They concern
    /// the entry in the sheet file, which already exists: with them, the command would try to add
    /// the page again, under a name that is in use.
    static std::set<std::string> options_of_entering();

    /// Marks the reserved pages as written to `out`. Throws Error if the file cannot be changed.
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
