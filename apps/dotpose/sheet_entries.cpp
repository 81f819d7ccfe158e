#include "sheet_entries.hpp"

#include <utility>

#include <fmt/core.h>

#include "common.hpp"
#include "progress.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {

void SheetEntryArguments::add_to(Command& command) {
    Option* sheets = add_sheets_option(
        command, path_,
        "Sheet file to which the pages are added, in free regions unless --origin is given");
    Option* name = command.add_option("--name", name_, "Name in the sheet file");
    name->type_name("NAME")->needs(sheets);
    sheets->needs(name);
    command
        .add_option("--wait", wait_s_,
                    "Maximum time to wait for other programs that change the sheet file")
        ->type_name("SECONDS")
        ->capture_default_str()
        ->needs(sheets)
        ->check(Range(0.0, 86'400.0));
    origin_ = command.get_option("--origin");
}

std::string SheetEntryArguments::page_name(Page page) const {
    return page.is_only ? name_ : fmt::format("{}-{}", name_, page.number);
}

void SheetEntryArguments::reserve(const std::function<void(SheetFile&)>& enter_all,
                                  std::optional<SheetReservation>& reservation) const {
    reservation.emplace(system::path_of(path_), enter_all,
                        SheetFileWait{wait_s_, notify, interrupted});
}

void SheetEntryArguments::confirm(SheetReservation& reservation, const std::string& out) const {
    try {
        reservation.confirm();
    } catch (const Error& error) {
        throw Error(fmt::format("{}; {} is complete, and its region is marked as reserved",
                                error.what(), out));
    }
}

Sheet SheetEntryArguments::enter(SheetFile& file, const Sheet& sheet, Page page,
                                 SheetPrint print) const {
    SheetEntry entry;
    entry.name = page_name(page);
    entry.page = page.number;
    entry.sheet = sheet;
    if (origin_->count() == 0) {
        entry = file.allocate(entry);
    } else {
        file.add(entry);
    }
    print.command = with_origin(print.command, entry.sheet.origin);
    entry.print = std::move(print);
    file.replace(entry);
    return entry.sheet;
}

std::string SheetEntryArguments::with_origin(const std::string& command, Cell origin) {
    return fmt::format("{} --origin {},{}", command, origin.x, origin.y);
}

std::set<std::string> SheetEntryArguments::options_of_entering() {
    return {"--sheets", "--name", "--wait", "--pages", "--origin"};
}

std::string SheetEntryArguments::summary(Page page) const {
    return given() ? fmt::format(", sheet '{}' of {}", page_name(page), path_) : "";
}

}  // namespace dotpose::cli
