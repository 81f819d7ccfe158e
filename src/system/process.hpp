/// The running program: its arguments, standard streams and signals.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dotpose/export.hpp"

// These declarations are exported because several libraries use them.
DOTPOSE_BEGIN_EXPORT

namespace dotpose::system {

/// Returns the arguments of `main` in UTF-8. Switches the standard streams to binary mode, and
/// prepares a Windows console for UTF-8 and colours.
std::vector<std::string> start_program(int argc, char** argv);

/// Returns the folder that contains the program, or an empty path if it is unknown.
std::filesystem::path program_folder();

/// Returns true if the stream is a terminal.
bool is_terminal(std::FILE* stream);

/// Waits up to 100 ms for bytes from a file, a pipe or a device. Returns the number of bytes read,
/// or 0 at the end of the file. Returns nullopt if no bytes arrive within this time, or if a signal
/// interrupts the wait. Throws std::system_error if reading fails.
std::optional<std::size_t> read_available(int descriptor, void* data, std::size_t max_bytes);

/// Sets the handler for signals that ask the program to exit: Ctrl-C, SIGTERM and a closed
/// terminal. System calls interrupted by these signals are restarted.
void on_end_signals(void (*handler)(int signal_number));

/// Makes writes to a pipe without a reader fail with EPIPE instead of terminating the program.
void ignore_broken_pipes();

}  // namespace dotpose::system

DOTPOSE_END_EXPORT
