/// Program of every target. It runs after the memory has been set up.
#pragma once

/// Locates the frames in the file at `path` and prints `stack N`, where N is the maximum stack
/// usage in bytes. Returns the exit status of `locate_frames`, or 1 with a message after a stack
/// overflow.
int run_program(const char* path);
