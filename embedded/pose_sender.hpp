/// PoseSender: what a device does with every frame, on any board. It takes the rows as the camera
/// delivers them, looks where the pattern is expected, follows the movement, sends the pose as a
/// packet, and says when the next frame is wanted.
///
///     static PoseSender sender;
///     for (;;) sender.send_next();
///
/// No heap; all of its memory, about 15 KB for frames of 188 x 120 px, is in the object.
#pragma once

#include <cstdint>

#include <dotpose/frame_pacer.hpp>
#include <dotpose/locate.hpp>
#include <dotpose/track.hpp>

#include "board.hpp"

class PoseSender {
  public:
    explicit PoseSender(const dotpose::Options& options = {},
                        const dotpose::PacerOptions& pacing = {})
        : locator_(memory_, options), tracker_(device_tracking()), pacer_(pacing) {}

    /// Takes a frame from the board and sends its packet.
    void send_next();

  private:
    static dotpose::TrackOptions device_tracking();
    dotpose::Status begin(const board::Frame& frame);
    dotpose::Fix locate(const board::Frame& frame);
    void follow(const dotpose::Fix& fix, std::int64_t time_us);

    dotpose::DeviceMemoryFor<board::kMostWidth_px, board::kMostHeight_px> memory_;
    dotpose::DeviceLocator locator_;
    dotpose::Tracker tracker_;
    dotpose::FramePacer pacer_;
    dotpose::Fix seen_;           ///< of the newest frame, if that has a pose
    dotpose::Sighting sighting_;  ///< the same, as the tracker took it
    std::uint16_t sequence_ = 0;  ///< counts frames
    std::int64_t next_us_ = 0;    ///< when the next frame is wanted
};
