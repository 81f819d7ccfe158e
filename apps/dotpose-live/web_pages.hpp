/// Files of the web pages that `dotpose watch --web` and `dotpose fleet --web` serve. CMake builds
/// the files from web/ and embeds them.
#pragma once

#include <span>

#include "serve/server.hpp"

namespace dotpose::cli {

/// Return the files, or an empty span if the program was built without the pages.
std::span<const serve::Page> live_pages();
std::span<const serve::Page> fleet_pages();

}  // namespace dotpose::cli
