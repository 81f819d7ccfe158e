// The program of a device, for any board that fills in board.hpp.
#include "pose_sender.hpp"

int main() {
    static PoseSender sender;
    for (;;)
        sender.send_next();
}
