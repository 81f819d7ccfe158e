/// The files of the pages of `dotpose watch --web` and `dotpose fleet --web`, which CMake builds
/// from web/ and embeds.
#pragma once

#include <span>

#include "serve/server.hpp"

namespace dotpose::cli {

/// Return the files, or an empty span if the program was built without the pages.
std::span<const serve::Page> live_pages();
std::span<const serve::Page> fleet_pages();

}  // namespace dotpose::cli
