/// Fields in an output line of `dotpose watch`: the fields that `dotpose locate` also writes, and
/// the fields for the track.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "reading.hpp"

namespace dotpose::cli {

std::vector<Field> fields(const Reading& reading, Units units);

/// Returns the CSV header for a run. `empty` is a record without a fix. Its flags, such as
/// `has_sheets`, select the fields.
std::string csv_header_of_readings(const Record& empty, Units units);

}  // namespace dotpose::cli
