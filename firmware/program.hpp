/// The program that every target runs after its memory is set up.
#pragma once

/// Locates the frames in the file at `path`, and prints `stack N`, where N is the largest number of
/// bytes of the stack that were in use. Returns the exit status.
int run_program(const char* path);
