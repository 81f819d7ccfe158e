/// Version of dotpose, as preprocessor macros. The build, the packages and the language bindings
/// read it from this header.
#pragma once

#include "dotpose/language.hpp"

/// Version as text.
#define DOTPOSE_VERSION "0.2.0"
/// Version as one number: 10000 * major + 100 * minor + patch.
#define DOTPOSE_VERSION_NUMBER 200
