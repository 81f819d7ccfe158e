/// Files of the pages of `dotpose watch --web` and `dotpose fleet --web`, built from web/ and
/// embedded by CMake.
#pragma once

#include <span>

#include "serve/server.hpp"

namespace dotpose::cli {

/// Return the files, or none if this program was built without the pages.
std::span<const serve::Page> live_pages();
std::span<const serve::Page> fleet_pages();

}  // namespace dotpose::cli
