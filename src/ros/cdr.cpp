// Serialises messages as plain little-endian OMG CDR, with the encapsulation header of ROS 2.
#include <algorithm>
#include <bit>
#include <concepts>
#include <limits>

#include "dotpose/tools/ros_messages.hpp"

namespace dotpose::ros {
namespace {

/// Appends values. Each value is aligned to its size, relative to the end of the header.
class CdrWriter {
  public:
    void put(std::unsigned_integral auto value) {
        constexpr std::size_t kSize = sizeof value;
        while ((bytes_.size() - kHeader.size()) % kSize != 0)
            bytes_.push_back(0);
        for (std::size_t i = 0; i < kSize; ++i)
            bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
    void put(std::int32_t value) { put(static_cast<std::uint32_t>(value)); }
    void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void put(const std::string& text) {
        put_size(text.size() + 1);
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.push_back(0);
    }
    void put(const std::vector<std::uint8_t>& data) {
        put_size(data.size());
        bytes_.insert(bytes_.end(), data.begin(), data.end());
    }
    void put(const Covariance36& covariance) {
        for (const double value : covariance)
            put(value);
    }
    void put_size(std::size_t size) { put(static_cast<std::uint32_t>(size)); }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    /// Plain CDR, little endian, followed by two unused option bytes.
    static constexpr std::array<std::uint8_t, 4> kHeader = {0, 1, 0, 0};
    std::vector<std::uint8_t> bytes_{kHeader.begin(), kHeader.end()};
};

void put(CdrWriter& cdr, const Header& header) {
    cdr.put(header.stamp.sec);
    cdr.put(header.stamp.nanosec);
    cdr.put(header.frame_id);
}

void put(CdrWriter& cdr, const Vector3& vector) {
    cdr.put(vector.x);
    cdr.put(vector.y);
    cdr.put(vector.z);
}

void put(CdrWriter& cdr, const Quaternion& rotation) {
    cdr.put(rotation.x);
    cdr.put(rotation.y);
    cdr.put(rotation.z);
    cdr.put(rotation.w);
}

void put(CdrWriter& cdr, const PoseWithCovariance& pose) {
    put(cdr, pose.pose.position);
    put(cdr, pose.pose.orientation);
    cdr.put(pose.covariance);
}

void put(CdrWriter& cdr, const TwistWithCovariance& twist) {
    put(cdr, twist.twist.linear);
    put(cdr, twist.twist.angular);
    cdr.put(twist.covariance);
}

void put(CdrWriter& cdr, const TransformStamped& transform) {
    put(cdr, transform.header);
    cdr.put(transform.child_frame_id);
    put(cdr, transform.transform.translation);
    put(cdr, transform.transform.rotation);
}

void put(CdrWriter& cdr, const KeyValue& pair) {
    cdr.put(pair.key);
    cdr.put(pair.value);
}

template <typename Message>
void put(CdrWriter& cdr, const std::vector<Message>& sequence) {
    cdr.put_size(sequence.size());
    for (const Message& message : sequence)
        put(cdr, message);
}

void put(CdrWriter& cdr, const DiagnosticStatus& status) {
    cdr.put(status.level);
    cdr.put(status.name);
    cdr.put(status.message);
    cdr.put(status.hardware_id);
    put(cdr, status.values);
}

}  // namespace

Time ros_time(std::int64_t time_ns) {
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    constexpr std::int64_t kEarliest = std::numeric_limits<std::int32_t>::min() * kSecond_ns;
    constexpr std::int64_t kLatest =
        std::numeric_limits<std::int32_t>::max() * kSecond_ns + kSecond_ns - 1;
    const std::int64_t fitting = std::clamp(time_ns, kEarliest, kLatest);
    std::int64_t seconds = fitting / kSecond_ns;
    if (fitting % kSecond_ns < 0) --seconds;  // nanoseconds must not be negative
    return {static_cast<std::int32_t>(seconds),
            static_cast<std::uint32_t>(fitting - seconds * kSecond_ns)};
}

std::vector<std::uint8_t> to_cdr(const PoseWithCovarianceStamped& message) {
    CdrWriter cdr;
    put(cdr, message.header);
    put(cdr, message.pose);
    return cdr.take();
}

std::vector<std::uint8_t> to_cdr(const Odometry& message) {
    CdrWriter cdr;
    put(cdr, message.header);
    cdr.put(message.child_frame_id);
    put(cdr, message.pose);
    put(cdr, message.twist);
    return cdr.take();
}

std::vector<std::uint8_t> to_cdr(const TFMessage& message) {
    CdrWriter cdr;
    put(cdr, message.transforms);
    return cdr.take();
}

std::vector<std::uint8_t> to_cdr(const DiagnosticArray& message) {
    CdrWriter cdr;
    put(cdr, message.header);
    put(cdr, message.status);
    return cdr.take();
}

std::vector<std::uint8_t> to_cdr(const CompressedImage& message) {
    CdrWriter cdr;
    put(cdr, message.header);
    cdr.put(message.format);
    cdr.put(message.data);
    return cdr.take();
}

}  // namespace dotpose::ros
