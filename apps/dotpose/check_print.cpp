#include "dotpose/tools/check_print.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "check_print_report.hpp"
#include "commands.hpp"
#include "common.hpp"
#include "dotpose/files/sheet_file.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/tools/flip.hpp"
#include "dotpose/tools/image_file.hpp"
#include "exit_codes.hpp"
#include "output_arguments.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "sheet_text.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

constexpr const char* kCheckPrintExamples =
    "Examples:\n"
    "  dotpose check-print scan.png\n"
    "  dotpose check-print scan.jpg --dpi 600 --spacing 0.508 --dot 0.085 --draw map.svg\n"
    "  dotpose check-print scan.png --fit --sheets sheets.json\n"
    "  dotpose print --test-page -o test.pdf    (print and scan it, then)\n"
    "  dotpose check-print test-scan.png\n\n"
    "Scan the whole page at 600 dpi, without sharpening. A photo shows bits and, from near,\n"
    "missing dots, but no scale: an image is a photo, whatever its resolution, if it shows\n"
    "perspective or a lens, or if its EXIF data have a camera's exposure. --dpi says that the\n"
    "page lies in the image as in a scan.\n"
    "Exit status: 0 no fault (with --fit, but for the scale that was written), 1 not checked, or\n"
    "nothing to fit, 3 faults.\n";

struct CheckPrintArguments {
    std::string scan;
    ReportArguments report;
    std::string picture;
    std::optional<double> dpi;
    int page = 1;
    int max_megapixels = kDefaultImagePixels / 1'000'000;
    bool flip = false;
    bool fit = false;
    std::string sheets;
    bool code_given = false;
    PatternArguments pattern;
};

void require_svg(const std::string& path) {
    const bool is_svg = path.size() > 4 && path.substr(path.size() - 4) == ".svg";
    if (is_svg) return;
    throw BadArgument(fmt::format("'{}': the name of the map must end in .svg", path));
}

/// Returns true if the scales along x and y are both within 25 % of 1. Printer drivers may cause
/// deviations of this size. Larger deviations are probably due to an incorrect scan resolution or
/// spacing.
bool is_plausible(const PrintScale& scale) {
    constexpr double kMaxDeviation = 0.25;
    return std::abs(scale.scale_x - 1) <= kMaxDeviation &&
           std::abs(scale.scale_y - 1) <= kMaxDeviation;
}

/// Throws Error unless the check determined a print scale that can be saved in a sheet file.
void require_scan(const std::string& scan, const PrintCheck& check) {
    constexpr const char* kRemedy = "; nothing was written: --fit needs a scan from a flatbed";
    if (check.camera) {
        throw Error(fmt::format(
            "{} is a photo, which has no scale of its own: lengths change by "
            "{:.1f} % across the page, and the lens displaces its corners by "
            "{:.1f} %{}",
            scan, 100 * check.camera->perspective, 100 * std::abs(check.camera->lens), kRemedy));
    }
    if (check.is_photo) {
        throw Error(
            fmt::format("{} is a photo, which has no scale of its own: its EXIF data have a "
                        "camera's exposure{}",
                        scan, kRemedy));
    }
    if (!check.fields.empty() && !check.resolution) {
        throw Error(fmt::format("{} states no plausible resolution, so its scale is not known{}",
                                scan, kRemedy));
    }
    for (const PrintField& field : check.fields) {
        if (!field.scale || is_plausible(*field.scale)) continue;
        throw Error(
            fmt::format("{}: the page would be printed at {:.0f} % of its size: the resolution or "
                        "the spacing is wrong; nothing was written",
                        scan, 100 * std::sqrt(field.scale->scale_x * field.scale->scale_y)));
    }
}

/// Returns a remark about the position of the dots on the page. The remark states how far the
/// printer driver can shift the dots by scaling the page. The actual shift cannot be measured,
/// because the scan does not show the edges of the paper.
std::string offset_remark(const SheetEntry& entry) {
    const Sheet& sheet = entry.sheet;
    // Returns the maximum shift of the first dot along one axis. Assumes that the driver scales the
    // page about a corner or about its centre, as most drivers do.
    const auto shift_mm = [](double scale, double first_mm, double side_mm) {
        return std::abs(1 - scale) * std::max(first_mm, std::abs(side_mm / 2 - first_mm));
    };
    return fmt::format(
        "the place of its dots on the page is not fitted: scaling alone shifts it by up to "
        "{:.1f} mm along x and {:.1f} mm along y; distances on the sheet are right; correct "
        "first_x_mm and first_y_mm in the file by a ruler",
        shift_mm(entry.print_scale_x, sheet.origin_x_mm, sheet.width_mm),
        shift_mm(entry.print_scale_y, sheet.origin_y_mm, sheet.height_mm));
}

/// Writes the measured print scale of each sheet in the scan to the sheet's entry in the sheet
/// file. Returns a report. `PrintField::sheet` is an index into `sheets`.
std::string fit_sheets(const std::string& path, const std::vector<SheetEntry>& sheets,
                       const PrintCheck& check) {
    SheetFile file(system::path_of(path), {.notify = notify, .stop = interrupted});
    std::string done;
    std::set<std::size_t> fitted;
    for (const PrintField& field : check.fields) {
        // Each visible part of a sheet is a separate field. Only the first field of a sheet is
        // used, because it is the largest.
        if (!field.scale || !field.sheet || !fitted.insert(*field.sheet).second) continue;
        // Reads the entry again, because another process may have changed the entry during the
        // check.
        const std::string& name = sheets[*field.sheet].name;
        const auto found = std::ranges::find(file.sheets(), name, &SheetEntry::name);
        if (found == file.sheets().end()) {
            throw Error(fmt::format("{} no longer has the sheet '{}'", path, name));
        }
        SheetEntry entry = *found;
        entry.print_scale_x = field.scale->scale_x;
        entry.print_scale_y = field.scale->scale_y;
        file.replace(entry);
        done += fmt::format("sheet '{}' of {}: print scale x {:.5f}, y {:.5f}; {}\n", entry.name,
                            path, entry.print_scale_x, entry.print_scale_y, offset_remark(entry));
    }
    if (done.empty()) {
        throw Error(fmt::format("{}: the scan shows none of its sheets with a known scale", path));
    }
    file.save();
    return done;
}

CheckPrintOptions options_of(const CheckPrintArguments& arguments,
                             const std::vector<SheetEntry>& sheets) {
    CheckPrintOptions options;
    options.pattern = arguments.pattern.pattern();
    std::optional<CodeVariant> code = arguments.pattern.expected_code();
    if (!arguments.sheets.empty() && !arguments.code_given) {
        code = common_code(arguments.sheets, sheets);
    }
    options.any_code = !code;
    if (code) options.pattern.code = *code;
    for (const SheetEntry& entry : sheets)
        options.sheets.push_back(entry.sheet);
    if (arguments.dpi) {
        options.resolution = Resolution{*arguments.dpi, *arguments.dpi};
        return options;
    }
    const ImageOrigin origin = read_origin(system::path_of(arguments.scan), arguments.page);
    options.is_photo = origin.is_photo;
    options.resolution = origin.resolution;
    return options;
}

int exit_status(const CheckPrintArguments& arguments, const PrintCheck& check) {
    if (check.fields.empty()) return kExitFailed;
    const bool has_fault = std::ranges::any_of(check.findings, [&](const Finding& finding) {
        const bool is_scale =
            finding.kind == FindingKind::scaled || finding.kind == FindingKind::uneven_scale;
        return finding.is_fault && !(arguments.fit && is_scale);
    });
    return has_fault ? kExitFaults : 0;
}

void require_apart(const CheckPrintArguments& arguments) {
    RunFiles files;
    files.reads("", arguments.scan);
    files.reads("--sheets", arguments.sheets);
    files.writes("-o", arguments.report.out, content_of(arguments.report));
    files.writes("--draw", arguments.picture, Content::svg);
}

/// Returns advice on how to check a scan that has too many pixels. The advice is part of an error
/// message.
std::string remedy_for(const ImageTooLarge& scan, const std::optional<Resolution>& resolution,
                       int max_megapixels) {
    const double megapixels = 1e-6 * scan.width_px * scan.height_px;
    const int needed = static_cast<int>(std::ceil(megapixels));
    std::string remedy;
    if (needed <= kMaxImagePixels / 1'000'000) {
        remedy = fmt::format("; --max-pixels {} reads it, which takes {:.1f} GB of memory", needed,
                             9e-3 * needed);
    }
    if (!resolution) return remedy + "; 600 dpi suffice, or 300 for large pages";
    const double dpi = std::sqrt(resolution->x_dpi * resolution->y_dpi);
    for (const int enough : {600, 400, 300}) {
        const double fraction = enough / dpi;
        if (enough >= dpi || megapixels * fraction * fraction > max_megapixels) continue;
        return remedy + fmt::format("; {} dpi instead of {:.0f} suffice", enough, dpi);
    }
    return remedy + "; or scan the page in parts";
}

/// Reads the scan and mirrors it if --flip is given. Throws Error if the scan cannot be read.
GreyImage read_scan(const CheckPrintArguments& arguments, const CheckPrintOptions& options) {
    std::string note;
    try {
        GreyImage scan = read_image(system::path_of(arguments.scan),
                                    arguments.max_megapixels * 1'000'000, note, arguments.page);
        if (!note.empty()) notify(note);
        if (arguments.flip) flip(scan);
        return scan;
    } catch (const ImageTooLarge& error) {
        throw Error(error.what() + remedy_for(error, options.resolution, arguments.max_megapixels));
    }
}

int run(const CheckPrintArguments& arguments) {
    if (!arguments.picture.empty()) require_svg(arguments.picture);
    require_apart(arguments);
    std::vector<SheetEntry> sheets;
    if (!arguments.sheets.empty()) sheets = read_sheets(system::path_of(arguments.sheets));
    CheckPrintOptions options = options_of(arguments, sheets);
    const GreyImage scan = read_scan(arguments, options);
    const int pages = count_pages(system::path_of(arguments.scan));
    catch_interrupts();
    PrintCheck check;
    {
        ProgressLine line("checking " + arguments.scan);
        options.progress = [&line](int done, int total) {
            line.update(done, total);
            return !interrupted();
        };
        check = check_print(scan.view(), options);
    }
    if (!arguments.picture.empty() && !check.fields.empty()) {
        draw_distortion(system::path_of(arguments.picture), scan.view(), check);
    }
    const CheckedScan checked{arguments.scan, arguments.page, pages,
                              scan.width_px,  scan.height_px, sheets};
    write_report(arguments.report, arguments.report.as_json ? json_report(checked, check)
                                                            : text_report(checked, check));
    if (arguments.fit) {
        require_scan(arguments.scan, check);
        std::fputs(fit_sheets(arguments.sheets, sheets, check).c_str(), stderr);
    }
    return exit_status(arguments, check);
}

}  // namespace

void add_check_print(Command& app, int& exit_code) {
    const auto arguments = std::make_shared<CheckPrintArguments>();
    Command* command =
        app.add_subcommand("check-print", "Check a printed sheet with a scan or photo of it");
    command->footer(kCheckPrintExamples);
    command->add_option("scan", arguments->scan, "PNG, TIFF, JPEG, WebP, HEIC, BMP or PGM file")
        ->type_name("SCAN")
        ->required();
    command->add_option("--dpi", arguments->dpi, "Resolution of the scan")
        ->type_name("N")
        ->default_str("as the file states")
        ->check(Range(1.0, 100'000.0));
    command->add_option("--page", arguments->page, "Page of a TIFF file with several pages")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(1, 1'000'000));
    command
        ->add_option(
            "--max-pixels", arguments->max_megapixels,
            "Maximum number of pixels of the scan, in millions; each million takes 9 MB of memory")
        ->type_name("N")
        ->capture_default_str()
        ->check(Range(1, kMaxImagePixels / 1'000'000));
    add_flip_option(*command, arguments->flip);
    arguments->pattern.add_to(*command, PatternArguments::Use::expected);
    add_report_options(*command, arguments->report);
    add_draw_option(*command, arguments->picture, "Also draw a map of the distortion (.svg)");
    Option* fit = command->add_flag(
        "--fit", arguments->fit, "Write the scale found into the sheet file, for true millimetres");
    Option* sheets =
        add_sheets_option(*command, arguments->sheets, "Sheet file with the sheets on the scan");
    fit->needs(sheets);
    for (const char* own : {"--spacing", "--displacement", "--dot"})
        sheets->excludes(command->get_option(own));
    command->callback([arguments, command, &exit_code] {
        arguments->code_given = command->count("--code") > 0;
        exit_code = run(*arguments);
    });
}

}  // namespace dotpose::cli
