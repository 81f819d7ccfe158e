// Sends the pose of every camera frame over the serial line. `dotpose listen /dev/ttyUSB0` prints
// the poses on a computer. board.cpp contains the three functions of the board.
#include <dotpose_device.hpp>

#include "pose_sender.hpp"

static PoseSender sender;

void setup() {}

void loop() {
    sender.send_next();
}
