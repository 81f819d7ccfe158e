/// Version of dotpose, for the preprocessor too. The build, the packages and the other languages
/// take it from here.
#pragma once

/// The version as text.
#define DOTPOSE_VERSION "0.2.0"
/// The version as one number that grows: 10000 for each major, 100 for each minor version.
#define DOTPOSE_VERSION_NUMBER 200
