// Records of an MCAP file. A record contains a type byte, the length of its members, and the
// members. Integers are little-endian, and there is no padding.
#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dotpose::mcap {

using Bytes = std::vector<std::uint8_t>;

/// Type of a record, stored in its first byte.
enum class Op : std::uint8_t {
    header = 0x01,
    footer = 0x02,
    schema = 0x03,
    channel = 0x04,
    message = 0x05,
    chunk = 0x06,
    message_index = 0x07,
    chunk_index = 0x08,
    statistics = 0x0B,
    summary_offset = 0x0E,
    data_end = 0x0F,
};

/// Appends the members of a record to a buffer.
class Members {
  public:
    explicit Members(Bytes& bytes) : bytes_(bytes) {}

    void put(std::unsigned_integral auto value) {
        for (std::size_t i = 0; i < sizeof value; ++i)
            bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
    void put(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size()));
        bytes_.insert(bytes_.end(), text.begin(), text.end());
    }
    /// Appends bytes without their length.
    void put_raw(std::span<const std::uint8_t> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    /// Appends a map, preceded by its size in bytes.
    template <typename Value>
    void put(const std::map<std::uint16_t, Value>& map) {
        put(static_cast<std::uint32_t>(map.size() * (sizeof(std::uint16_t) + sizeof(Value))));
        for (const auto& [key, value] : map) {
            put(key);
            put(value);
        }
    }
    void put(const std::map<std::string, std::string>& map) {
        Bytes entries;
        Members members(entries);
        for (const auto& [key, value] : map) {
            members.put(std::string_view(key));
            members.put(std::string_view(value));
        }
        put(static_cast<std::uint32_t>(entries.size()));
        put_raw(entries);
    }

  private:
    Bytes& bytes_;
};

/// Appends a record. `fill` appends its members.
template <typename Fill>
void append_record(Bytes& bytes, Op op, Fill fill) {
    Members members(bytes);
    members.put(static_cast<std::uint8_t>(op));
    const std::size_t length_at = bytes.size();
    members.put(std::uint64_t{0});
    fill(members);
    const std::uint64_t length = bytes.size() - length_at - sizeof(std::uint64_t);
    for (std::size_t i = 0; i < sizeof length; ++i)
        bytes[length_at + i] = static_cast<std::uint8_t>(length >> (8 * i));
}

}  // namespace dotpose::mcap
