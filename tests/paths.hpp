/// Where the files are that tests use. In a source of its own, so that objects of tests do not
/// depend on where the checkout is.
#pragma once

#include <string>

namespace dotpose::test {

/// Returns the path of the checkout.
std::string source_dir();

/// Returns the path of a built program or of a library that tests load.
std::string built(const std::string& name);

/// Returns the path of the built tool `dotpose`.
std::string tool_path();

}  // namespace dotpose::test
