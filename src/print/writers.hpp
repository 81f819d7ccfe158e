/// Writers for the file formats. Each writer writes the complete contents of a file. The caller
/// must then commit the file (see base::OutputFile). All writers throw Error if writing fails or
/// `progress` returns false.
#pragma once

#include <span>

#include "base/output_file.hpp"
#include "dotpose/tools/print.hpp"
#include "png/png.hpp"
#include "raster.hpp"

namespace dotpose::print {

void write_text(const Sheet& sheet, const Progress& progress, base::OutputFile& file);
void write_svg(const Sheet& sheet, const Progress& progress, base::ByteSink& file);

void write_png(RasterSize size, double dpi, const png::RowSource& rows, base::OutputFile& file);
void write_tiff(RasterSize size, double dpi, const png::RowSource& rows, base::OutputFile& file);

void write_pdf(std::span<const Sheet> sheets, const PrintOptions& options, base::OutputFile& file);
void write_pdf_page(const PrintPage& page, const PrintOptions& options, base::OutputFile& file);
void write_svg_page(const PrintPage& page, const Progress& progress, base::ByteSink& file);

/// Reports the number of finished rows. Throws Error if `progress` returns false.
void report(const Progress& progress, int rows_done, int rows);

}  // namespace dotpose::print
