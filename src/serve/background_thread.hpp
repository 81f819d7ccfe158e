// Threads that serve the page, beside the main thread that follows the robot.
#pragma once

namespace dotpose::serve {

/// Blocks all signals in this thread, because the main thread handles them, and lowers its
/// priority, because frames are more urgent than the page.
void run_in_background();

}  // namespace dotpose::serve
