/// One writer per file format. Each takes a validated sheet, writes everything into `file` and
/// leaves the commit to the caller. All throw Error when writing fails or progress says stop.
#pragma once

#include <span>

#include "dotpose/print.hpp"
#include "output_file.hpp"

namespace dotpose::print {

void write_text(const Sheet& sheet, const Progress& progress, OutputFile& file);
void write_svg(const Sheet& sheet, const Progress& progress, OutputFile& file);
void write_png(const Sheet& sheet, double dpi, const Progress& progress, OutputFile& file);
void write_tiff(const Sheet& sheet, double dpi, const Progress& progress, OutputFile& file);
void write_pdf(std::span<const Sheet> sheets, const PrintOptions& options, OutputFile& file);

/// Reports one more finished row; throws Error if the caller wants to stop.
void report(const Progress& progress, int rows_done, int rows);

}  // namespace dotpose::print
