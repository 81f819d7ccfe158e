/// The program that every target runs after its memory has been set up.
#pragma once

/// Locates the frames in the file at `path` and prints `stack N`, where N is the maximum stack
/// usage in bytes. Returns the exit status of `locate_frames`. After a stack overflow, prints a
/// message and returns 1.
int run_program(const char* path);
