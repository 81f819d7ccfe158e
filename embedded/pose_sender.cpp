#include "pose_sender.hpp"

#include <dotpose/pose_packet.hpp>

using namespace dotpose;

/// Returns options for the tracker. The tracker needs standard deviations for the poses, but fixes
/// from DeviceLocator have no covariance. The options therefore contain the measured errors from
/// docs/firmware.md.
TrackOptions PoseSender::device_tracking() {
    TrackOptions options;
    options.min_sigma_mm = 0.0012F;
    options.min_sigma_rad = 0.0004F;
    return options;
}

/// Begins a frame with the prediction from the tracker, or without a prediction if the previous
/// frame gave no pose. The pose may have been missing because of a wrong prediction: the rows of a
/// frame are not stored, so a frame that does not confirm its prediction cannot be located again
/// without the prediction.
Status PoseSender::begin(const board::Frame& frame) {
    if (seen_.status != Status::ok) return locator_.begin(frame.width_px, frame.height_px);
    const Prediction expected =
        tracker_.predict(frame.time_us, seen_, sighting_, locator_.options());
    return locator_.begin(frame.width_px, frame.height_px, expected);
}

Fix PoseSender::locate(const board::Frame& frame) {
    Status begun = begin(frame);
    // If the prediction cannot be used, for example because the robot was lifted, the frame is
    // located without a prediction.
    if (begun == Status::not_tracked) begun = locator_.begin(frame.width_px, frame.height_px);
    // Reads all rows even if the frame was refused, to stay synchronised with the camera.
    for (int row = 0; row < frame.height_px; ++row) {
        const std::uint8_t* pixels = board::next_row();
        if (begun == Status::ok) locator_.push_row(pixels);
    }
    return locator_.finish();
}

void PoseSender::follow(const Fix& fix, std::int64_t time_us) {
    const bool ok = fix.status == Status::ok;
    seen_ = fix;
    if (ok) sighting_ = sighting_of(fix, time_us);
    tracker_.update(time_us, ok ? &sighting_ : nullptr);
}

void PoseSender::send_next() {
    const board::Frame frame = board::start_frame(next_us_);
    const Fix fix = locate(frame);
    const PacketBytes bytes = encode(make_packet(fix, locator_.options().code, sequence_++,
                                                 static_cast<std::uint32_t>(frame.time_us)));
    board::send(bytes.data(), bytes.size());
    follow(fix, frame.time_us);
    next_us_ = pacer_.next_frame_us(fix, frame.time_us);
}
