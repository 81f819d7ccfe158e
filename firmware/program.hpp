/// What every bare-metal target runs once its memory is set up.
#pragma once

/// Locates the frames in the file at `path`, then prints `stack N`: the most bytes of stack that
/// were in use. Returns the exit status.
int run_program(const char* path);
