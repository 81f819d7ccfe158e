/// The fields of an output line of `dotpose watch`: those of `dotpose locate` and those of the
/// tracker.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "reading.hpp"

namespace dotpose::cli {

/// Returns "lost", "moving" or "stationary".
std::string state_name(const Track& track);

/// Returns the names of events separated by blanks, for example "fix kidnapped"; empty if there is
/// none.
std::string event_names(const TrackEvents& events);

std::vector<Field> fields(const Reading& reading, Units units);

/// Returns the header line of a run with or without sheets.
std::string csv_header_of_readings(bool has_sheets, Units units);

}  // namespace dotpose::cli
