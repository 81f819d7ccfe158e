// Main program of a device. It runs on any board that implements board.hpp.
#include "pose_sender.hpp"

int main() {
    static PoseSender sender;
    for (;;)
        sender.send_next();
}
