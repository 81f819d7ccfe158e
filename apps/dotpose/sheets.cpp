// `dotpose sheets`: displays and modifies a sheet file.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/core.h>

#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/tools/draw.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "sheet_changes.hpp"
#include "sheet_reprint.hpp"
#include "sheet_text.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kSheetsExamples =
    "Examples:\n"
    "  dotpose sheets list\n"
    "  dotpose sheets show table --sheets lab.json\n"
    "  dotpose sheets place table --x 1250 --y -500 --yaw 90\n"
    "  dotpose sheets scale table --measured 48.5 --of 50\n"
    "  dotpose sheets offset table --right 9.6 --below 10.4\n"
    "  dotpose sheets reprint table -o table.pdf\n"
    "  dotpose sheets map -o map.svg\n\n"
    "dotpose sheets COMMAND --help has the options of each.\n";

constexpr const char* kFrames =
    "The pose is that of the top left corner of the page, and --yaw the direction in which its\n"
    "upper edge runs from there, counter-clockwise: a page that lies straight has yaw 0.\n\n"
    "Example:\n"
    "  dotpose sheets place table --x 1250 --y -500 --yaw 90\n";

constexpr const char* kScale =
    "Measure a long distance on the printed page with a steel rule, such as the ruler in the\n"
    "margin of a PDF, and give it with the distance that it should be. Printers scale x and y\n"
    "differently: --along x or --along y sets one of them. Scans (check-print --fit) and frames\n"
    "(calibrate --stitch) measure both more exactly.\n\n"
    "Examples:\n"
    "  dotpose sheets scale table --measured 48.5 --of 50\n"
    "  dotpose sheets scale table --measured 199.2 --of 200 --along y\n";

constexpr const char* kOffset =
    "Measure from the left and the upper edge of the page to the centre of the first column and\n"
    "the first row of dots. 'dotpose sheets show' prints the nominal distances.\n\n"
    "Example:\n"
    "  dotpose sheets offset table --right 9.6 --below 10.4\n";

struct SheetsArguments {
    std::string sheets = "sheets.json";
    double wait_s = SheetFileWait{}.max_s;
    std::string name;
    std::string new_name;
    std::string out;
    std::optional<double> x_mm;
    std::optional<double> y_mm;
    std::optional<double> yaw_deg;
    bool is_unknown = false;
    MeasuredLength length;
    double right_mm = 0;
    double below_mm = 0;

    SheetFileWait wait() const { return {wait_s, notify, interrupted}; }
};

/// Throws Error if the sheet file does not exist. Without this check, SheetFile would create the
/// file.
void require_there(const SheetsArguments& arguments) {
    std::error_code error;
    if (std::filesystem::exists(system::path_of(arguments.sheets), error)) return;
    throw Error(
        fmt::format("there is no sheet file {}: --sheets FILE names it, and 'dotpose print "
                    "--sheets FILE --name NAME' makes one",
                    arguments.sheets));
}

std::vector<SheetEntry> sheets_of(const SheetsArguments& arguments) {
    require_there(arguments);
    return read_sheets(system::path_of(arguments.sheets));
}

/// Locks the sheet file, calls `change` with the entry of the selected sheet, and saves the file.
template <typename Change>
void change_sheet(const SheetsArguments& arguments, const Change& change) {
    require_there(arguments);
    catch_interrupts();
    SheetFile file(system::path_of(arguments.sheets), arguments.wait());
    change(file, SheetEntry(named_sheet(file.sheets(), arguments.name, arguments.sheets)));
    file.save();
}

void place(const SheetsArguments& arguments) {
    const bool has_pose = arguments.x_mm && arguments.y_mm && arguments.yaw_deg;
    if (!has_pose && !arguments.is_unknown) {
        throw BadArgument("a place needs all of --x, --y and --yaw, or --unknown alone");
    }
    std::optional<PagePose> pose;
    if (has_pose) pose = {*arguments.x_mm, *arguments.y_mm, *arguments.yaw_deg};
    change_sheet(arguments, [&](SheetFile& file, SheetEntry entry) {
        entry = placed(entry, pose);
        file.replace(entry);
        fmt::print("{}: {}\n", printable(entry.name), world_text(entry));
    });
}

void scale(const SheetsArguments& arguments) {
    change_sheet(arguments, [&](SheetFile& file, SheetEntry entry) {
        entry = scaled(entry, arguments.length);
        file.replace(entry);
        fmt::print("{}: print scale x {:.6g}, y {:.6g}\n", printable(entry.name),
                   entry.print_scale_x, entry.print_scale_y);
    });
}

void offset(const SheetsArguments& arguments) {
    change_sheet(arguments, [&](SheetFile& file, SheetEntry entry) {
        entry = with_offset(entry, arguments.right_mm, arguments.below_mm);
        file.replace(entry);
        fmt::print("{}: first intersection {:g} mm right of and {:g} mm below the corner\n",
                   printable(entry.name), entry.sheet.origin_x_mm, entry.sheet.origin_y_mm);
    });
}

void rename(const SheetsArguments& arguments) {
    change_sheet(arguments, [&](SheetFile& file, const SheetEntry& entry) {
        file.rename(entry.name, arguments.new_name);
        fmt::print("{} is now {}\n", printable(entry.name), printable(arguments.new_name));
    });
}

void remove(const SheetsArguments& arguments) {
    change_sheet(arguments, [&](SheetFile& file, const SheetEntry& entry) {
        file.remove(entry.name);
        fmt::print("{}\n", removal_text(entry.name));
    });
}

void reprint(const SheetsArguments& arguments) {
    RunFiles files;
    files.reads("--sheets", arguments.sheets);
    files.writes("-o", arguments.out, Content::own);
    const std::vector<SheetEntry> sheets = sheets_of(arguments);
    const SheetEntry& entry = named_sheet(sheets, arguments.name, arguments.sheets);
    reprint_sheet(entry, arguments.out);
    if (entry.is_reserved) {
        change_sheet(arguments, [](SheetFile& file, SheetEntry reserved) {
            reserved.is_reserved = false;
            file.replace(reserved);
        });
    }
    fmt::print("{}: {}, sheet '{}' of {}\n", printable(arguments.out), region_text(entry.sheet),
               printable(entry.name), printable(arguments.sheets));
}

void draw_map(const SheetsArguments& arguments) {
    RunFiles files;
    files.reads("--sheets", arguments.sheets);
    files.writes("-o", arguments.out, Content::svg);
    const std::vector<SheetEntry> sheets = sheets_of(arguments);
    const DocumentOutput output(arguments.out, ".svg");
    require_writable(output.path());
    draw_sheets(output.path(), sheets);
    output.finish();
}

using Arguments = std::shared_ptr<SheetsArguments>;

void add_out_option(Command& command, const Arguments& arguments, const std::string& help) {
    command.add_option("-o,--out", arguments->out, help)->type_name("FILE")->required();
}

/// Adds a subcommand with the options that are common to all subcommands.
Command& add_command(Command& sheets, const Arguments& arguments, const char* name,
                     const char* what, void (*run)(const SheetsArguments&)) {
    Command* command = sheets.add_subcommand(name, what)->group("Commands");
    add_sheets_option(*command, arguments->sheets, "Sheet file")->capture_default_str();
    command->callback([arguments, run] { run(*arguments); });
    return *command;
}

/// Adds a subcommand that takes the name of a single sheet as a positional argument.
Command& add_command_of_one(Command& sheets, const Arguments& arguments, const char* name,
                            const char* what, void (*run)(const SheetsArguments&)) {
    Command& command = add_command(sheets, arguments, name, what, run);
    command.add_option("name", arguments->name, "Name of the sheet")->type_name("NAME")->required();
    return command;
}

void add_wait_option(Command& command, const Arguments& arguments) {
    command
        .add_option("--wait", arguments->wait_s,
                    "Maximum time to wait for other programs that change the sheet file")
        ->type_name("SECONDS")
        ->capture_default_str()
        ->check(Range(0.0, 86'400.0));
}

void add_scale(Command& sheets, const Arguments& arguments) {
    Command& command = add_command_of_one(sheets, arguments, "scale",
                                          "Enter the true length of the printed page", scale);
    command.footer(kScale);
    add_wait_option(command, arguments);
    const auto add = [&](const char* flag, double& length_mm, const char* help) {
        command.add_option(flag, length_mm, help)
            ->type_name("MM")
            ->required()
            ->check(Range(1e-3, 1e6));
    };
    add("--measured", arguments->length.measured_mm, "Length measured on the page");
    add("--of", arguments->length.nominal_mm, "Length that it should be");
    command.add_option("--along", arguments->length.along, "Direction: x, y or both")
        ->type_name("NAME")
        ->capture_default_str()
        ->check(one_of(kDirections));
}

void add_offset(Command& sheets, const Arguments& arguments) {
    Command& command = add_command_of_one(sheets, arguments, "offset",
                                          "Enter where the dots are on the printed page", offset);
    command.footer(kOffset);
    add_wait_option(command, arguments);
    const auto add = [&](const char* flag, double& distance_mm, const char* help) {
        command.add_option(flag, distance_mm, help)->type_name("MM")->required();
    };
    add("--right", arguments->right_mm, "Distance of the first intersection from the left edge");
    add("--below", arguments->below_mm, "Distance of the first intersection from the upper edge");
}

void add_place(Command& sheets, const Arguments& arguments) {
    Command& command = add_command_of_one(sheets, arguments, "place",
                                          "Enter the pose of a sheet in the world", place);
    command.footer(kFrames);
    add_wait_option(command, arguments);
    Option* unknown = command.add_flag("--unknown", arguments->is_unknown,
                                       "The pose of the page is no longer known");
    const auto add = [&](const char* flag, std::optional<double>& value, const char* unit,
                         const char* help) {
        command.add_option(flag, value, help)->type_name(unit)->excludes(unknown);
    };
    add("--x", arguments->x_mm, "MM", "x of the page's top left corner in the world");
    add("--y", arguments->y_mm, "MM", "y of this corner; y points up if x points right");
    add("--yaw", arguments->yaw_deg, "DEG", "Direction of the page's upper edge");
}

}  // namespace

void add_sheets(Command& app, int& /*exit_code*/) {
    const auto arguments = std::make_shared<SheetsArguments>();
    Command* command = app.add_subcommand("sheets", "Show and change a sheet file");
    command->footer(kSheetsExamples);
    command->require_subcommand(1);
    add_command(*command, arguments, "list", "List all sheets", [](const SheetsArguments& given) {
        fmt::print("{}", list_text(sheets_of(given)));
    });
    add_command_of_one(
        *command, arguments, "show", "Show all properties of a sheet",
        [](const SheetsArguments& given) {
            fmt::print("{}", sheet_text(named_sheet(sheets_of(given), given.name, given.sheets)));
        });
    add_place(*command, arguments);
    add_scale(*command, arguments);
    add_offset(*command, arguments);
    Command& renaming = add_command_of_one(*command, arguments, "rename", "Rename a sheet", rename);
    renaming.add_option("new_name", arguments->new_name, "New name")->type_name("NAME")->required();
    add_wait_option(renaming, arguments);
    add_wait_option(
        add_command_of_one(*command, arguments, "remove", "Remove a sheet from the file", remove),
        arguments);
    Command& reprinting = add_command_of_one(*command, arguments, "reprint",
                                             "Print the same page of a sheet again", reprint);
    add_out_option(reprinting, arguments, "File to write: .pdf, .svg, .png, .tif or .txt");
    add_wait_option(reprinting, arguments);
    add_out_option(
        add_command(*command, arguments, "map", "Draw the sheets in the world", draw_map),
        arguments, "Picture to draw (SVG), or - for standard output");
}

}  // namespace dotpose::cli
