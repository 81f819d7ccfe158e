/// The program dotpose-live, which implements the commands that use cameras, videos and networks.
#pragma once

#include <string>

namespace dotpose::cli {

/// Replaces this process with dotpose-live, passing the same arguments. Returns only on failure,
/// with the value of errno.
int become_live();

/// Returns the end of an error message such as "--web needs ...": the name of the program
/// dotpose-live and the reason why it cannot be started.
std::string live_program_text(int error_number);

}  // namespace dotpose::cli
