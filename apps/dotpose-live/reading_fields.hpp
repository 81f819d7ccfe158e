/// One output line of `dotpose watch`: the raw pose of `dotpose locate`, and what the tracker made
/// of it.
#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "frame_locator.hpp"

namespace dotpose::cli {

/// lost, moving or stationary.
std::string state_name(const Track& track);

/// "fix kidnapped", for example; empty: none.
std::string event_names(const TrackEvents& events);

std::vector<Field> fields(const Reading& reading);

/// The header of a run with or without sheets.
std::string csv_header_of_readings(bool has_sheets);

}  // namespace dotpose::cli
