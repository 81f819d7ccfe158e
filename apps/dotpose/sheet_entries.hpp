/// --sheets FILE --name NAME --wait SECONDS: entering what is printed in a sheet file.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "dotpose/tools/sheet_file.hpp"

namespace dotpose::cli {

class SheetEntryArguments {
  public:
    /// To be called after the command's --origin has been added.
    void add_to(CLI::App& command);

    /// Whether there is a sheet file at all; the others ask for one.
    bool given() const { return !path_.empty(); }
    const std::string& path() const { return path_; }
    const std::string& name() const { return name_; }

    /// A page of the document.
    struct Page {
        int number = 1;  ///< from 1
        bool is_only = true;
    };

    /// What the file calls a page: NAME, or NAME-NUMBER if there are others.
    std::string page_name(Page page) const;

    /// Reserves the regions of all pages that `enter_all` enters, before any is written.
    void reserve(const std::function<void(SheetFile&)>& enter_all,
                 std::optional<SheetReservation>& reservation) const;

    /// Adds a page to the file, in the next free region unless the user chose an origin. Returns
    /// the sheet where it stands now.
    Sheet enter(SheetFile& file, const Sheet& sheet, Page page) const;

    /// The pages at `out` are written: so says the file from now on. Throws Error.
    void confirm(SheetReservation& reservation, const std::string& out) const;

    /// ", sheet 'NAME' of FILE"; empty if there is no sheet file.
    std::string summary(Page page) const;

  private:
    std::string path_;
    std::string name_;
    double wait_s_ = SheetFileWait{}.most_s;
    const CLI::Option* origin_ = nullptr;
};

}  // namespace dotpose::cli
