// Sends the pose of every camera frame over the serial line. On a computer, `dotpose listen
// /dev/ttyUSB0` prints the poses. board.cpp implements the three functions declared in board.hpp.
#include <dotpose_device.hpp>

#include "pose_sender.hpp"

static PoseSender sender;

void setup() {}

void loop() {
    sender.send_next();
}
