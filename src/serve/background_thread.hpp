// Settings for the threads that serve the web page while the main thread follows the robot.
#pragma once

namespace dotpose::serve {

/// Blocks all signals in the calling thread, because the main thread handles signals. Also lowers
/// the priority of the calling thread, because processing frames is more urgent than serving the
/// page.
void run_in_background();

}  // namespace dotpose::serve
