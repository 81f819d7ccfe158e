// Empty source of the targets that own the precompiled headers of the tests. See
// tests/CMakeLists.txt.
