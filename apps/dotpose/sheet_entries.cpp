#include "sheet_entries.hpp"

#include <fmt/core.h>

#include "common.hpp"

namespace dotpose::cli {

void SheetEntryArguments::add_to(CLI::App& command) {
    CLI::Option* sheets = add_sheets_option(
        command, path_, "Sheet file to add the pages to, in free regions unless --origin");
    CLI::Option* name = command.add_option("--name", name_, "Name in the sheet file");
    name->type_name("NAME")->needs(sheets);
    sheets->needs(name);
    origin_ = command.get_option("--origin");
}

std::string SheetEntryArguments::page_name(Page page) const {
    return page.is_only ? name_ : fmt::format("{}-{}", name_, page.number);
}

Sheet SheetEntryArguments::enter(SheetFile& file, const Sheet& sheet, Page page) const {
    SheetEntry entry;
    entry.name = page_name(page);
    entry.page = page.number;
    entry.sheet = sheet;
    if (origin_->count() == 0) return file.allocate(entry).sheet;
    file.add(entry);
    return sheet;
}

std::string SheetEntryArguments::summary(Page page) const {
    return given() ? fmt::format(", sheet '{}' of {}", page_name(page), path_) : "";
}

}  // namespace dotpose::cli
