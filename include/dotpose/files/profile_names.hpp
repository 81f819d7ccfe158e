/// The names of profiles, as files, the command line and tables have them.
#pragma once

#include <optional>
#include <string_view>

#include "dotpose/code.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// The name of a profile: anoto, libdots, microdots.
const char* name(Profile profile);

/// The profile of a name; `published` is the earlier name of libdots. None if there is no such.
std::optional<Profile> profile_by_name(std::string_view name);

}  // namespace dotpose

#pragma GCC visibility pop
