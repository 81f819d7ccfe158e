/// The machine that a run was measured on.
#pragma once

#include <string>

namespace dotpose::bench {

/// 1, 5 and 15 minutes ago: processes that wanted to run.
std::string load_average();

/// Processor, caches, compiler, library, as a list.
std::string machine_list();

}  // namespace dotpose::bench
