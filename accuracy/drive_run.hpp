/// Tracks a robot in the simulated drive from the tests, in the same way as `dotpose watch`.
#pragma once

#include <functional>

#include "../tests/drive_errors.hpp"
#include "dotpose/tools/follower.hpp"

namespace dotpose::tables {

/// Callback for each processed frame. `index` is the index of the frame in the drive.
using TakeFrame =
    std::function<void(int index, const test::DriveState& truth, const Followed& followed)>;

/// Processes every `step`-th frame of the drive. If `map` is not empty, corrects the positions with
/// it. Ctrl-C ends the run early.
void follow_drive(const test::Drive& drive, const test::DriveCamera& camera, int step,
                  const TakeFrame& take, const PrintMap& map = {});

}  // namespace dotpose::tables
