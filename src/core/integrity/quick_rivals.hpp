// Quick rivals: an upper estimate of the summed odds of all rivals that takes a thousandth of the
// work of `rivals_log2`, and integers only. Where it is far below doubt, nobody needs to know more.
// docs/integrity.md derives it.
#pragma once

#include "core/integrity/contest.hpp"

namespace dotpose::core {

/// In 2^-8 powers of two; 0 where so little work does not tell, or shows that it is above a limit.
int quick_rivals_log2_q8(const Contest& contest, int limit_q8 = 0);

}  // namespace dotpose::core
