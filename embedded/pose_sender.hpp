/// Processes camera frames on any board. For each frame, PoseSender reads the rows from the camera,
/// locates the pattern with a prediction, sends the pose as a packet, updates the tracker, and
/// determines the time of the next frame.
///
///     static PoseSender sender;
///     for (;;) sender.send_next();
///
/// The object contains all memory, about 15 KB for frames of 188 x 120 px. PoseSender does not use
/// the heap.
#pragma once

#include <cstdint>

#include <dotpose/frame_pacer.hpp>
#include <dotpose/locate.hpp>
#include <dotpose/track.hpp>

#include "board.hpp"

class PoseSender {
  public:
    explicit PoseSender(const dotpose::DeviceOptions& options = {},
                        const dotpose::PacerOptions& pacing = {})
        : locator_(memory_, options), tracker_(device_tracking()), pacer_(pacing) {}

    /// Reads a frame from the board, locates it and sends its packet.
    void send_next();

  private:
    static dotpose::TrackOptions device_tracking();
    dotpose::Status begin(const board::Frame& frame);
    dotpose::Fix locate(const board::Frame& frame);
    void follow(const dotpose::Fix& fix, std::int64_t time_us);

    dotpose::DeviceMemoryFor<board::kMaxWidth_px, board::kMaxHeight_px> memory_;
    dotpose::DeviceLocator locator_;
    dotpose::Tracker tracker_;
    dotpose::FramePacer pacer_;
    dotpose::Fix seen_;           ///< fix of the newest frame, initially not ok
    dotpose::Sighting sighting_;  ///< sighting computed from the newest fix with status ok
    std::uint16_t sequence_ = 0;  ///< number of frames so far, modulo 2^16
    std::int64_t next_us_ = 0;    ///< earliest time of the next frame
};
