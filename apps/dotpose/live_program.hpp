/// The program dotpose-live, which implements the commands that use cameras, videos and networks.
#pragma once

#include <string>

namespace dotpose::cli {

/// Replaces this process with dotpose-live, passing the same arguments. Returns only on failure,
/// with the value of errno.
int become_live();

/// Returns the end of an error message that begins with, for example, "--web needs". The text names
/// dotpose-live, the reason why it cannot be started, and the remedy.
std::string live_program_text(int error_number);

}  // namespace dotpose::cli
