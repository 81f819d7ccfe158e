/// Fields of an output line of `dotpose watch`: the fields of `dotpose locate`, and the fields of
/// the tracker.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "reading.hpp"

namespace dotpose::cli {

std::vector<Field> fields(const Reading& reading, Units units);

/// Returns the CSV header of a run. `empty` is a record without a fix. Its flags, such as
/// `has_sheets`, select the fields of the run.
std::string csv_header_of_readings(const Record& empty, Units units);

}  // namespace dotpose::cli
