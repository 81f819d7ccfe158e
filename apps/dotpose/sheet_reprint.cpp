#include "sheet_reprint.hpp"

#include <fmt/core.h>

#include "common.hpp"
#include "dotpose/tools/print.hpp"
#include "progress.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

PrintOptions options_of(const SheetPrint& print) {
    PrintOptions options;
    options.dpi = print.dpi;
    options.drawing = drawing_by_name(print.dots).value();
    options.labels = print.has_labels;
    options.name = print.title;
    options.command = print.command;
    options.page_count = print.pages;
    return options;
}

/// Returns the most likely print options for a page whose entry contains no options.
PrintOptions likely_options(const SheetEntry& entry) {
    PrintOptions options;
    options.name = entry.name;
    options.page_count = entry.page;
    return options;
}

}  // namespace

PrintOptions reprint_options(const SheetEntry& entry) {
    if (entry.print && !entry.print->document.empty()) {
        throw Error(
            fmt::format("the dots of '{}' were laid over the document {}, which the sheet file "
                        "does not contain; lay them over it again: {}",
                        entry.name, entry.print->document, entry.print->command));
    }
    PrintOptions options = entry.print ? options_of(*entry.print) : likely_options(entry);
    options.first_page = entry.page;
    return options;
}

void reprint_sheet(const SheetEntry& entry, const std::string& out) {
    PrintOptions options = reprint_options(entry);
    if (!entry.print) {
        notify(
            fmt::format("note: the entry of '{}', from an earlier version, does not say how its "
                        "page was printed: the dots are the same, labels may differ, and a .pdf "
                        "is for {:g} dpi",
                        entry.name, options.dpi));
    }
    catch_interrupts();
    ProgressLine line("printing " + out);
    options.progress = [&line](int done, int total) {
        line.update(done, total);
        return !interrupted();
    };
    write_sheet(entry.sheet, system::path_of(out), options);
}

}  // namespace dotpose::cli
