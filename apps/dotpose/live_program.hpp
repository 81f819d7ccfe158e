/// The program dotpose-live, which implements commands for cameras, videos and networks.
#pragma once

#include <string>

namespace dotpose::cli {

/// Replaces this process with dotpose-live and its arguments. Returns only if that fails, with the
/// value of errno.
int become_live();

/// Returns the end of a sentence about something that needs dotpose-live: the name of the program,
/// and the reason why it cannot be started.
std::string live_program_text(int error_number);

}  // namespace dotpose::cli
