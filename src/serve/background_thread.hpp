// Settings for the threads that serve the web page while the main thread follows the robot.
#pragma once

namespace dotpose::serve {

/// Blocks all signals in this thread, because the main thread handles them. Also lowers the
/// priority of this thread, because frames are more urgent than the page.
void run_in_background();

}  // namespace dotpose::serve
