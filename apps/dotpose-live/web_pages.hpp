/// Files of the page of `dotpose watch --web`, built from web/ and embedded by CMake.
#pragma once

#include <span>

#include "serve/server.hpp"

namespace dotpose::cli {

/// Returns the files, or none if this program was built without the page.
std::span<const serve::Page> live_pages();

}  // namespace dotpose::cli
