#include "sheet_print.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "common.hpp"
#include "sheet_entries.hpp"

namespace dotpose::cli {
namespace {

Sheet layout_of(const NewPage& page) {
    SheetOptions options;
    options.paper = paper_by_name(page.paper);
    if (page.is_landscape) options.paper = landscape(options.paper);
    options.pattern.spacing_mm = page.spacing_mm;
    options.pattern.displacement_mm = options.pattern.dot_mm = page.spacing_mm / 6;
    options.margin_mm = default_margin_mm(PrintFormat::pdf, options.paper);
    return make_sheet(options);
}

/// Returns the command that prints the page, without --origin.
std::string command_of(const NewPage& page) {
    std::string command = fmt::format("dotpose print -o {} --paper {}", pdf_name(page.name),
                                      quoted_for_shell(page.paper));
    if (page.is_landscape) command += " --landscape";
    if (page.spacing_mm != kDefaultSpacing_mm)
        command += fmt::format(" --spacing {}", page.spacing_mm);
    return command;
}

}  // namespace

double default_margin_mm(PrintFormat format, const Paper& paper) {
    constexpr double kWithLabels_mm = 10;
    constexpr double kSmallPage_mm = 60;
    const bool is_small = std::min(paper.width_mm, paper.height_mm) < kSmallPage_mm;
    return format == PrintFormat::pdf && !is_small ? kWithLabels_mm : SheetOptions{}.margin_mm;
}

std::string pdf_name(const std::string& sheet) {
    constexpr std::size_t kMaxLength = 60;
    constexpr const char* kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    std::string name = sheet.substr(0, kMaxLength);
    for (std::size_t at = name.find_first_not_of(kPlain); at != std::string::npos;
         at = name.find_first_not_of(kPlain, at))
        name[at] = '_';
    // Replaces a leading hyphen, because a name that starts with a hyphen would be parsed as an
    // option.
    if (name.starts_with('-')) name.front() = '_';
    return name + ".pdf";
}

SheetEntry enter_page(SheetFile& file, const NewPage& page) {
    SheetEntry entry;
    entry.name = page.name;
    entry.sheet = layout_of(page);
    entry = file.allocate(entry);
    SheetPrint print;
    print.title = page.name;
    print.command = SheetEntryArguments::with_origin(command_of(page), entry.sheet.origin);
    entry.print = print;
    file.replace(entry);
    return entry;
}

}  // namespace dotpose::cli
