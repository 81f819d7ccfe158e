#include "packet_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dotpose/tools/follower.hpp"

namespace dotpose::cli {
namespace {

/// Returns the fix in a packet, without a covariance.
Fix fix_of(const PosePacket& packet) {
    Fix fix;
    fix.status = packet.status;
    fix.spacing_nm = 0;
    if (packet.status != Status::ok) return fix;
    fix.cell = packet.cell;
    fix.fraction_x_q16 = packet.fraction_x_q16;
    fix.fraction_y_q16 = packet.fraction_y_q16;
    fix.theta_bam = packet.theta_bam16 * (1 << 16);
    fix.section = packet.section;
    fix.p_wrong_log2 = -packet.certainty;
    return fix;
}

/// Sets the covariance of a fix to a diagonal matrix, computed from the standard deviation in the
/// packet.
void set_covariance(const PosePacket& packet, Fix& fix) {
    // For the smallest view, 8 x 8 dots, the standard deviation of the angle in rad is sqrt(6) / 8
    // times the standard deviation of the position in spacings. With more dots, the angle is more
    // accurate, so this factor is an upper bound.
    constexpr float kAngleFromPosition = 0.306F;
    constexpr float kThetaStep_rad = 9.6e-5F;  // one unit of PosePacket::theta_bam16
    const float sigma = std::max<float>(packet.deviation_q12, 1) / 4096;
    const float sigma_rad = kAngleFromPosition * sigma + kThetaStep_rad;
    fix.covariance[0][0] = fix.covariance[1][1] = sigma * sigma;
    fix.covariance[2][2] = sigma_rad * sigma_rad;
}

TrackOptions options_of(double spacing_mm) {
    TrackOptions options;
    if (std::isfinite(spacing_mm)) options.spacing_mm = static_cast<float>(spacing_mm);
    return options;
}

}  // namespace

PacketFollower::PacketFollower(std::vector<SheetEntry> sheets, double spacing_mm)
    : sheets_(std::move(sheets)),
      spacing_mm_(spacing_mm),
      is_in_world_(std::ranges::any_of(
          sheets_, [](const SheetEntry& entry) { return entry.world.has_value(); })),
      tracker_(options_of(spacing_mm)) {
    if (sheets_.empty()) return;
    spacing_mm_ = sheets_.front().sheet.pattern.spacing_mm;
    for (const SheetEntry& entry : sheets_) {
        if (entry.sheet.pattern.spacing_mm != spacing_mm_) {
            spacing_mm_ = std::numeric_limits<double>::quiet_NaN();
        }
    }
}

Record PacketFollower::record_of(const PosePacket& packet) const {
    Record record;
    record.fix = fix_of(packet);
    record.reading.code = packet.code;
    record.code_is_given = true;
    record.has_sheets = has_sheets();
    record.place = find_sheet(sheets_, packet.code, record.fix);
    record.spacing_mm = record.place ? record.place->entry->sheet.pattern.spacing_mm : spacing_mm_;
    if (std::isfinite(record.spacing_mm)) {
        record.fix.spacing_nm = static_cast<std::int32_t>(std::lround(record.spacing_mm * 1e6));
    }
    record.elapsed_us = std::numeric_limits<double>::quiet_NaN();
    return record;
}

std::optional<Reading> PacketFollower::follow(const PosePacket& packet) {
    if (!advance(packet)) return std::nullopt;
    Reading reading;
    reading.index = readings_++;
    reading.time_us = time_us_;
    reading.record = record_of(packet);
    reading.plane = is_in_world_ ? Plane::sheet_world : Plane::pattern;
    Fix fix = reading.record.fix;
    std::optional<Sighting> sighting;
    if (fix.status == Status::ok && fix.spacing_nm > 0) {
        set_covariance(packet, fix);
        const auto& place = reading.record.place;
        if (!is_in_world_) sighting = sighting_of(fix, time_us_);
        if (is_in_world_ && place) sighting = world_sighting(fix, *place, time_us_);
    }
    reading.track = tracker_.update(time_us_, sighting ? &*sighting : nullptr);
    return reading;
}

/// Advances `time_us_` to the time of a packet. Returns false if the packet is not newer than all
/// previous packets.
bool PacketFollower::advance(const PosePacket& packet) {
    constexpr std::int64_t kRestart_us = 1'000'000;
    if (newest_) {
        const int step = packets_since(newest_->sequence, packet.sequence);
        if (is_late(step)) return false;
        const auto elapsed_us = static_cast<std::int32_t>(packet.time_us - newest_->time_us);
        // A clock that went backwards indicates a restart of the device. The time since the
        // previous packet is then unknown and is assumed to be kRestart_us.
        time_us_ += elapsed_us > 0 ? elapsed_us : kRestart_us;
    }
    newest_ = packet;
    return true;
}

}  // namespace dotpose::cli
