/// One output line of `dotpose locate`: what one image told.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dotpose/code_evidence.hpp"
#include "dotpose/fix.hpp"
#include "dotpose/tools/sheet_file.hpp"
#include "fields.hpp"

namespace dotpose::cli {

struct Record {
    std::string file;
    Fix fix;
    CodeReading reading;         ///< profile and other places; its fix is that of the image centre
    bool code_is_given = false;  ///< by the user or the sheets
    double spacing_mm = 0;       ///< not a number if it is not known; then nothing is given in mm
    bool has_sheets = false;     ///< sheets were searched: their fields are wanted
    std::optional<SheetPlace> place;  ///< on one of them
    double elapsed_us = 0;            ///< of `dotpose::locate` alone
    std::string advice;               ///< on what would help where there is no fix; may be empty
    int width_px = 0;
    int height_px = 0;
    int min_dots = 0;          ///< fewest that are worth a try
    int max_p_wrong_log2 = 0;  ///< what may be wrong with more than 2^this is refused
};

/// A warning where the user gave a profile and another one explains the frame; else empty.
std::string warning(const Record& record);

/// Why there is no fix, with the numbers that matter; empty if there is one.
std::string reason(const Record& record);

/// The list of fields, in the order of the output.
std::vector<Field> fields(const Record& record);

/// Lines with their line break. JSON holds the fields that mean something, CSV has all columns. In
/// JSON, bytes of a file name that are no UTF-8 are replaced.
std::string json_line(const Record& record);
std::string csv_header(bool has_sheets);
std::string csv_line(const Record& record);

}  // namespace dotpose::cli
