/// Paths of the files that tests use. A separate source file defines them, so that the object files
/// of the tests do not depend on the location of the checkout.
#pragma once

#include <string>

namespace dotpose::test {

/// Returns the path of the checkout.
std::string source_dir();

/// Returns the path of a built program, or of a library that tests load.
std::string built(const std::string& name);

/// Returns the path of the built `dotpose` tool.
std::string tool_path();

}  // namespace dotpose::test
