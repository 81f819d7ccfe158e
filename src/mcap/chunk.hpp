// A chunk of an MCAP file: consecutive messages with an index for each channel.
#pragma once

#include <algorithm>
#include <limits>

#include "mcap/crc32.hpp"
#include "mcap/record.hpp"

namespace dotpose::mcap {

/// Summary entry of a chunk.
struct ChunkEntry {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::uint64_t start = 0;                              ///< offset of the chunk in the file
    std::uint64_t length = 0;                             ///< length of the chunk record in bytes
    std::map<std::uint16_t, std::uint64_t> index_starts;  ///< offset of each channel's index
    std::uint64_t index_length = 0;                       ///< total length of the indexes in bytes
    /// Total length of the records in the chunk, in bytes.
    std::uint64_t size = 0;
};

/// Collects message records and writes them as a chunk.
class Chunk {
  public:
    bool is_empty() const { return records_.empty(); }
    std::size_t size() const { return records_.size(); }
    /// Returns the time from the earliest to the latest message, in ns.
    std::uint64_t duration_ns() const { return is_timeless() ? 0 : last_ns_ - first_ns_; }

    /// Returns the records, so that the caller can append schemas and channels before the messages
    /// that use them.
    Bytes& records() { return records_; }

    void add_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time_ns,
                     std::span<const std::uint8_t> data) {
        index_[channel].push_back({time_ns, records_.size()});
        append_record(records_, Op::message, [&](Members& message) {
            message.put(channel);
            message.put(sequence);
            message.put(time_ns);  // log time
            message.put(time_ns);  // publish time
            message.put_raw(data);
        });
        first_ns_ = std::min(first_ns_, time_ns);
        last_ns_ = std::max(last_ns_, time_ns);
    }

    /// Appends the chunk and its indexes to `out`, and begins a new chunk. `place` is the file
    /// offset of the first appended byte.
    ChunkEntry append_to(Bytes& out, std::uint64_t place) {
        ChunkEntry entry;
        entry.first_ns = is_timeless() ? 0 : first_ns_;
        entry.last_ns = last_ns_;
        entry.start = place;
        entry.size = records_.size();
        const std::size_t begin = out.size();
        append_record(out, Op::chunk, [&](Members& chunk) {
            chunk.put(entry.first_ns);
            chunk.put(entry.last_ns);
            chunk.put(std::uint64_t{records_.size()});
            chunk.put(crc32(records_));
            chunk.put(std::string_view());  // no compression
            chunk.put(std::uint64_t{records_.size()});
            chunk.put_raw(records_);
        });
        entry.length = out.size() - begin;
        for (const auto& [channel, messages] : index_) {
            entry.index_starts[channel] = place + (out.size() - begin);
            append_index(out, channel, messages);
        }
        entry.index_length = out.size() - begin - entry.length;
        *this = Chunk();
        return entry;
    }

  private:
    struct IndexedMessage {
        std::uint64_t time_ns = 0;
        std::uint64_t offset = 0;  ///< offset of the message within the records
    };

    bool is_timeless() const { return index_.empty(); }

    static void append_index(Bytes& out, std::uint16_t channel,
                             const std::vector<IndexedMessage>& messages) {
        append_record(out, Op::message_index, [&](Members& index) {
            index.put(channel);
            index.put(static_cast<std::uint32_t>(messages.size() * 2 * sizeof(std::uint64_t)));
            for (const IndexedMessage& message : messages) {
                index.put(message.time_ns);
                index.put(message.offset);
            }
        });
    }

    Bytes records_;
    std::map<std::uint16_t, std::vector<IndexedMessage>> index_;
    std::uint64_t first_ns_ = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t last_ns_ = 0;
};

}  // namespace dotpose::mcap
