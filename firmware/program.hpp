/// Program of every target, to be run after memory is set up.
#pragma once

/// Locates the frames in the file at `path`, and prints `stack N`, where N is the maximum stack
/// usage in bytes. Returns the exit status of `locate_frames`, or 1 with a message if the stack has
/// overflown.
int run_program(const char* path);
