/// The program dotpose-live, which implements commands for cameras, videos and networks.
#pragma once

#include <string>

namespace dotpose::cli {

/// Replaces this process with dotpose-live, with the same arguments. Returns only on failure, with
/// the value of errno.
int become_live();

/// Returns the end of a sentence which states that dotpose-live is needed: its name, and the reason
/// why it cannot be started.
std::string live_program_text(int error_number);

}  // namespace dotpose::cli
