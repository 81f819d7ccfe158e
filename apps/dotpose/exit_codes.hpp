/// Exit statuses of the tool.
#pragma once

namespace dotpose::cli {

inline constexpr int kExitFailed = 1;
inline constexpr int kExitUsage = 2;
inline constexpr int kExitFaults = 3;  ///< a check found faults

}  // namespace dotpose::cli
