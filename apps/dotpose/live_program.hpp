/// The program dotpose-live, which implements the commands that use cameras, videos and networks.
#pragma once

#include <string>

namespace dotpose::cli {

/// Replaces this process with dotpose-live, passing the same arguments. Returns only on failure,
/// with the value of errno.
int become_live();

/// Returns the second part of an error message such as "--web needs ...": the name dotpose-live and
/// the reason why the program cannot be started.
std::string live_program_text(int error_number);

}  // namespace dotpose::cli
