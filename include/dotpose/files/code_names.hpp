/// Names of code variants, as used in files, on the command line and in tables.
#pragma once

#include <optional>
#include <string_view>

#include "dotpose/code.hpp"
#include "dotpose/export.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Returns the name of a code variant: "anoto", "libdots" or "microdots".
const char* name(CodeVariant code);

/// Returns the code variant with the given name, or none if there is no such variant.
std::optional<CodeVariant> code_by_name(std::string_view name);

}  // namespace dotpose

DOTPOSE_END_EXPORT
