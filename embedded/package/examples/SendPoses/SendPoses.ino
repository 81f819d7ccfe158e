// Sends the pose of every camera frame over the serial line: `dotpose listen /dev/ttyUSB0` prints
// them on a computer. board.cpp has the three functions that a board needs.
#include <dotpose_device.hpp>

#include "pose_sender.hpp"

static PoseSender sender;

void setup() {}

void loop() {
    sender.send_next();
}
