#include <algorithm>
#include <string>

#include <fmt/core.h>

#include "base/output_file.hpp"
#include "dotpose/tools/print.hpp"
#include "lower_case.hpp"
#include "writers.hpp"

namespace dotpose {

void print::write_png(RasterSize size, double dpi, const png::RowSource& rows,
                      base::OutputFile& file) {
    png::write({size.width_px, size.height_px, 1, dpi}, rows, file);
}

PrintFormat print_format(const std::filesystem::path& path) {
    const std::string ending = print::lower_case(path.extension().string());
    if (ending == ".txt") return PrintFormat::text;
    if (ending == ".svg") return PrintFormat::svg;
    if (ending == ".png") return PrintFormat::png;
    if (ending == ".pdf") return PrintFormat::pdf;
    if (ending == ".tif" || ending == ".tiff") return PrintFormat::tiff;
    throw BadArgument(
        fmt::format("'{}': the name must end in .pdf, .svg, .png, .tif or .txt", path.string()));
}

void write_sheet(const Sheet& sheet, const std::filesystem::path& path,
                 const PrintOptions& options) {
    write_sheets({&sheet, 1}, path, options);
}

void write_sheets(std::span<const Sheet> sheets, const std::filesystem::path& path,
                  const PrintOptions& options) {
    const PrintFormat format = print_format(path);
    if (sheets.empty()) throw BadArgument("there is no sheet to write");
    if (sheets.size() > 1 && format != PrintFormat::pdf) {
        throw BadArgument(fmt::format("'{}': only a .pdf can hold several pages", path.string()));
    }
    for (const Sheet& each : sheets) {
        validate(each);
        if (format != PrintFormat::text && format != PrintFormat::svg) {
            validate_resolution(each, options.dpi);
        }
    }
    const Sheet& sheet = sheets.front();
    base::OutputFile file(path);
    const auto rows = [&](const png::RowSink& sink) {
        print::rasterize(sheet, options.dpi, options.progress, sink);
    };
    switch (format) {
        case PrintFormat::text:
            print::write_text(sheet, options.progress, file);
            break;
        case PrintFormat::svg:
            print::write_svg(sheet, options.progress, file);
            break;
        case PrintFormat::png:
            print::write_png(print::raster_size(sheet, options.dpi), options.dpi, rows, file);
            break;
        case PrintFormat::tiff:
            print::write_tiff(print::raster_size(sheet, options.dpi), options.dpi, rows, file);
            break;
        case PrintFormat::pdf:
            print::write_pdf(sheets, options, file);
            break;
    }
    file.commit();
}

}  // namespace dotpose
