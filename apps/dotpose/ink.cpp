#include "dotpose/tools/ink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/degrees.hpp"
#include "dotpose/files/error.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/write_file.hpp"
#include "print/lower_case.hpp"
#include "run_files.hpp"
#include "run_log.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kInkExamples =
    "Examples:\n"
    "  dotpose watch 0 --camera pen.yaml --pose space --sheets sheets.json --log run.csv\n"
    "  dotpose ink run.csv --sheets sheets.json -o page.svg\n"
    "  dotpose ink run.csv -o page.inkml\n"
    "  dotpose locate --camera pen.yaml --pose space frames/ > run.json\n"
    "  dotpose ink run.json --fps 200 -o page.svg\n\n"
    "The camera file needs tip_mm, from 'dotpose calibrate --pivot'. If the pen wrote on several\n"
    "pages, each page gets its own file, such as page-NAME.svg.\n";

struct InkArguments {
    std::string log;
    std::string out;
    std::string sheets;
    double fps = 0;  ///< frame rate, or 0 if not given
};

std::string extension_of(const std::string& out) {
    return print::lower_case(system::path_of(out).extension().string());
}

/// Reads the pen tip from row `index` of the log. Returns a default sample, whose standard
/// deviations are 0, if the row contains no tip or the tip is not on a sheet.
InkSample sample_of(const LogCells& row, std::int64_t index, double fps) {
    if (row.number("tip_x_pattern_m")) throw Error("its lengths are in m; write it in --units mm");
    InkSample sample;
    const bool has_sheets = row.has("sheet");
    const auto x_mm = row.number(has_sheets ? "tip_x_sheet_mm" : "tip_x_mm");
    if (!x_mm) return {};
    if (has_sheets) sample.page = row.text("sheet");
    sample.x_mm = *x_mm;
    sample.y_mm = row.required(has_sheets ? "tip_y_sheet_mm" : "tip_y_mm");
    sample.height_mm = row.required("tip_height_mm");
    sample.sigma_x_mm = row.required("sigma_tip_x_mm");
    sample.sigma_y_mm = row.required("sigma_tip_y_mm");
    sample.sigma_height_mm = row.required("sigma_tip_height_mm");
    sample.tilt_rad = row.number("camera_tilt_deg").value_or(0) / kDegrees;
    sample.azimuth_rad = row.number("camera_azimuth_deg").value_or(0) / kDegrees;
    const auto t_s = row.number("t_s");
    if (!t_s && fps == 0) throw Error("t_s is missing: give the rate of the frames with --fps");
    sample.t_s = t_s ? *t_s : static_cast<double>(index) / fps;
    return sample;
}

/// Reads the pen tip from every row that contains one. Throws Error if there is no such row.
std::vector<InkSample> read_samples(const InkArguments& arguments) {
    // No column is required, not even the time column, because the output of `locate` does not
    // contain times.
    LogReader log(system::path_of(arguments.log), {});
    std::vector<InkSample> samples;
    std::int64_t index = 0;
    const auto parse = [&](const LogCells& row) {
        const InkSample sample = sample_of(row, index++, arguments.fps);
        if (sample.sigma_x_mm > 0 && !samples.empty() && sample.t_s <= samples.back().t_s)
            throw Error("its time is not later than that of the row before");
        return sample;
    };
    while (const auto sample = log.next(parse)) {
        if (sample->sigma_x_mm > 0) samples.push_back(*sample);
    }
    if (!samples.empty()) return samples;
    throw Error(
        fmt::format("{}: no frame has the tip of a pen: use watch or locate with --pose space and "
                    "a camera file with tip_mm (dotpose calibrate --pivot)",
                    arguments.log));
}

/// Sets the size of each page to the size of its sheet in the sheet file.
void set_sizes(const std::string& sheets, std::vector<InkPage>& pages) {
    if (sheets.empty()) return;
    const std::vector<SheetEntry> entries = read_sheets(system::path_of(sheets));
    for (InkPage& page : pages) {
        const auto entry = std::ranges::find(entries, page.name, &SheetEntry::name);
        if (entry == entries.end())
            throw Error(fmt::format("{} has no sheet '{}'", sheets, printable(page.name)));
        page.width_mm = entry->sheet.width_mm;
        page.height_mm = entry->sheet.height_mm;
    }
}

/// Returns the output path of a page: the path given to -o, with the page name inserted before the
/// extension if there are several pages.
std::string path_of_page(const std::string& out, const std::string& page, bool is_only) {
    if (is_only) return out;
    std::string name = page;
    std::ranges::replace_if(
        name, [](char c) { return c == '/' || c == '\\' || c == ':'; }, '_');
    const std::filesystem::path path = system::path_of(out);
    const std::string file = path.stem().string() + "-" + name + path.extension().string();
    return (path.parent_path() / system::path_of(file)).string();
}

double length_mm(const InkPage& page) {
    double sum_mm = 0;
    for (const InkStroke& stroke : page.strokes) {
        for (std::size_t i = 1; i < stroke.size(); ++i)
            sum_mm += std::hypot(stroke[i].x_mm - stroke[i - 1].x_mm,
                                 stroke[i].y_mm - stroke[i - 1].y_mm);
    }
    return sum_mm;
}

void run(const InkArguments& arguments) {
    const bool is_ink_ml = extension_of(arguments.out) == ".inkml";
    if (!is_ink_ml && extension_of(arguments.out) != ".svg")
        throw BadArgument("-o needs a name that ends in .svg or .inkml");
    const Content content = is_ink_ml ? Content::own : Content::svg;
    RunFiles files;
    files.reads("", arguments.log);
    files.reads("--sheets", arguments.sheets);
    files.writes("-o", arguments.out, content);
    std::vector<InkPage> pages = ink_of(read_samples(arguments));
    if (pages.empty()) throw Error(arguments.log + ": the pen did not touch the paper");
    set_sizes(arguments.sheets, pages);
    std::set<std::string> written;
    for (const InkPage& page : pages) {
        const std::string path = path_of_page(arguments.out, page.name, pages.size() == 1);
        if (pages.size() > 1) files.require_free("-o", path);
        if (!written.insert(path).second)
            throw Error(fmt::format("two pages would be written to {}", printable(path)));
        write_file(system::path_of(path), is_ink_ml ? ink_ml(page) : ink_svg(page));
        fmt::print("{}: {} strokes, {:.1f} mm\n", printable(path), page.strokes.size(),
                   length_mm(page));
    }
}

}  // namespace

void add_ink(Command& app, int&) {
    const auto arguments = std::make_shared<InkArguments>();
    Command* command =
        app.add_subcommand("ink", "Draw what a pen wrote, from the log of watch or locate");
    command->footer(kInkExamples);
    command
        ->add_option("log", arguments->log,
                     "Log of dotpose watch --log (CSV), or lines of watch or locate (JSON)")
        ->type_name("FILE")
        ->required();
    command
        ->add_option("-o,--out", arguments->out,
                     "File to write: NAME.svg, or NAME.inkml for InkML of the W3C")
        ->type_name("FILE")
        ->required();
    add_sheets_option(*command, arguments->sheets, "Sheet file with the sizes of the pages");
    command->add_option("--fps", arguments->fps, "Rate of the frames, for lines of locate")
        ->type_name("N")
        ->check(Range(1e-3, 1e6));
    command->callback([arguments] { run(*arguments); });
}

}  // namespace dotpose::cli
