// Empty source file for the targets that build the precompiled headers of the tests. See
// tests/CMakeLists.txt.
