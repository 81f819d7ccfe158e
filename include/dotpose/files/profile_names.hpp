/// Names of profiles, as used in files, on the command line and in tables.
#pragma once

#include <optional>
#include <string_view>

#include "dotpose/code.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// Returns the name of a profile: anoto, libdots, microdots.
const char* name(Profile profile);

/// Returns the profile of a name, or none if there is no such profile.
std::optional<Profile> profile_by_name(std::string_view name);

}  // namespace dotpose

#pragma GCC visibility pop
