#include "calibrate_print_map.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/core.h>

#include "common.hpp"
#include "dotpose/files/write_file.hpp"
#include "dotpose/tools/draw.hpp"
#include "dotpose/tools/flat_field.hpp"
#include "dotpose/tools/print_mapping.hpp"
#include "live_sources.hpp"
#include "progress.hpp"
#include "run_files.hpp"
#include "system/path.hpp"
#include "terminal_text.hpp"

namespace dotpose::cli {
namespace {

void require_apart(const PrintMapArguments& arguments, const Sources& sources) {
    RunFiles files;
    sources.add_files(files);
    files.reads("--sheets", arguments.sheets);
    files.reads("--camera", arguments.camera_path);
    files.updates("-o", arguments.out, Content::own);
    files.writes("--draw", arguments.picture, Content::svg);
}

/// Returns the map at `out` (option -o), or an empty map if the file does not exist.
PrintMap earlier_map(const std::string& out) {
    std::error_code failed;
    if (!std::filesystem::exists(system::path_of(out), failed)) return {};
    try {
        PrintMap map = read_print_map(system::path_of(out));
        notify(fmt::format("{} exists: the frames update it", out));
        return map;
    } catch (const Error& error) {
        throw Error(
            fmt::format("{}; -o replaces only a print map: name another file", error.what()));
    }
}

/// Adds all frames from the sources to the map.
void add_frames(const PrintMapArguments& arguments, Sources& sources, PrintMapping& mapping) {
    capture::SourceOptions options = arguments.sources.options;
    options.notify = notify;
    options.stop = interrupted;
    options.open_live = open_live;
    options.on_unreadable = [](const std::string&, const Error& error) { notify(error.what()); };
    std::optional<FlatFieldCorrection> correction;
    if (arguments.camera && !arguments.camera->flat_field.empty())
        correction.emplace(*arguments.camera);
    const auto frames = sources.open(options);
    const std::int64_t images = sources.number_of_images();
    ProgressLine line("reading frames");
    capture::Frame frame;
    for (std::int64_t i = 0; frames->next(frame); ++i) {
        line.update(i, images > 0 ? images : frames->length());
        if (frame.image.pixels.empty()) continue;
        mapping.add(correction ? correction->corrected(frame.image.view()).view()
                               : frame.image.view());
    }
    if (take_ctrl_c()) notify("no more frames are read; Ctrl-C once more ends without a result");
    if (interrupted()) throw Error("interrupted; no map was written");
}

std::string report_of(const PrintMapResult& result) {
    std::string text;
    std::size_t i = 0;
    for (const MapPage& map : result.map.pages) {
        if (i == result.pages.size()) break;
        if (map.name != result.pages[i].name) continue;
        const MappedPage& page = result.pages[i++];
        text += fmt::format(
            "page        {}: {} of {} frames\n"
            "dots        {} of {} seen, {:.1f} times each; {:.2f} % of the measurements not used\n"
            "distortion  {:.1f} um rms, slow over the page\n"
            "jitter      {:.1f} um rms, of each dot\n"
            "noise       {:.2f} um rms, of a dot in a frame\n"
            "error       {}\n"
            "camera      {}\n",
            page.name, page.frames, result.frames, page.seen, page.dots,
            static_cast<double>(page.observations) /
                static_cast<double>(std::max<std::size_t>(page.seen, 1)),
            100 * static_cast<double>(page.outliers) / static_cast<double>(page.observations),
            1000 * page.slow_mm, 1000 * page.jitter_mm, 1000 * page.noise_mm,
            page.error_mm > 0
                ? fmt::format("{:.3f} um, of the place of a view on the page", 1000 * page.error_mm)
                : "not known, because the earlier map does not contain it",
            page.is_rigid ? "at constant height" : "at changing heights");
        if (page.seen < page.dots) {
            text +=
                fmt::format("            {} dots were not seen: frames there are not corrected\n",
                            page.dots - page.seen);
        }
    }
    return text;
}

}  // namespace

void make_print_map(const PrintMapArguments& arguments) {
    if (arguments.sheets.empty())
        throw BadArgument("--print-map needs --sheets FILE, the sheet file of the printed pages");
    if (arguments.out.empty() || arguments.out == kStandardOutput)
        throw BadArgument("--print-map needs -o FILE, the file of the map");
    Sources sources(arguments.sources);
    require_apart(arguments, sources);
    require_writable(system::path_of(arguments.out));
    PrintMapping mapping({.sheets = read_sheets(system::path_of(arguments.sheets)),
                          .camera = arguments.camera,
                          .earlier = earlier_map(arguments.out)});
    catch_interrupts();
    add_frames(arguments, sources, mapping);
    PrintMapResult result;
    {
        ProgressLine line("solving the map");
        result = mapping.solve([&](double fraction) {
            line.update(static_cast<std::int64_t>(1000 * fraction), 1000);
            return !interrupted();
        });
    }
    write_file(system::path_of(arguments.out), print_map_bytes(result.map));
    if (!arguments.picture.empty())
        draw_print_map(system::path_of(arguments.picture), result.map.pages.front());
    std::fputs(for_standard_output(report_of(result)).c_str(), stdout);
}

}  // namespace dotpose::cli
