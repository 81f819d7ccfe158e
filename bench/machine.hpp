/// Describes the machine on which a run was measured.
#pragma once

#include <string>

namespace dotpose::bench {

/// Returns the load averages of the last 1, 5 and 15 minutes.
std::string load_average();

/// Returns a Markdown list of processor, caches, compiler and library.
std::string machine_list();

}  // namespace dotpose::bench
