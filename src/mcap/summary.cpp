#include "mcap/summary.hpp"

namespace dotpose::mcap {
namespace {

void append_statistics(Bytes& out, const Contents& contents) {
    std::uint64_t messages = 0;
    for (const auto& [channel, count] : contents.messages)
        messages += count;
    std::uint64_t first_ns = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t last_ns = 0;
    for (const ChunkEntry& chunk : contents.chunks) {
        first_ns = std::min(first_ns, chunk.first_ns);
        last_ns = std::max(last_ns, chunk.last_ns);
    }
    append_record(out, Op::statistics, [&](Members& statistics) {
        constexpr std::uint32_t kNone = 0;
        statistics.put(messages);
        statistics.put(contents.schema_count);
        statistics.put(static_cast<std::uint32_t>(contents.messages.size()));
        statistics.put(kNone);  // attachments
        statistics.put(kNone);  // metadata
        statistics.put(static_cast<std::uint32_t>(contents.chunks.size()));
        statistics.put(contents.chunks.empty() ? 0 : first_ns);
        statistics.put(last_ns);
        statistics.put(contents.messages);
    });
}

void append_chunk_index(Bytes& out, const ChunkEntry& entry) {
    append_record(out, Op::chunk_index, [&](Members& index) {
        index.put(entry.first_ns);
        index.put(entry.last_ns);
        index.put(entry.start);
        index.put(entry.length);
        index.put(entry.index_starts);
        index.put(entry.index_length);
        index.put(std::string_view());  // no compression
        index.put(entry.size);
        index.put(entry.size);
    });
}

/// Appends groups of records of the same type, and stores the offset of each group.
class Summary {
  public:
    Summary(Bytes& out, std::uint64_t place) : out_(out), base_(place - out.size()) {}

    /// Returns the offset of the next record in the file.
    std::uint64_t here() const { return base_ + out_.size(); }

    template <typename Append>
    void group(Op op, Append append) {
        const std::uint64_t start = here();
        append(out_);
        if (here() > start) groups_.push_back({op, start, here() - start});
    }

    void append_offsets() const {
        for (const Group& group : groups_) {
            append_record(out_, Op::summary_offset, [&group](Members& offset) {
                offset.put(static_cast<std::uint8_t>(group.op));
                offset.put(group.start);
                offset.put(group.length);
            });
        }
    }

  private:
    struct Group {
        Op op;
        std::uint64_t start;
        std::uint64_t length;
    };
    Bytes& out_;
    std::uint64_t base_;
    std::vector<Group> groups_;
};

}  // namespace

void append_magic(Bytes& out) {
    constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
    out.insert(out.end(), kMagic.begin(), kMagic.end());
}

void append_end(Bytes& out, std::uint64_t place, const Contents& contents, const Crc32& data) {
    Summary summary(out, place);
    append_record(out, Op::data_end, [&data](Members& end) { end.put(data.value()); });
    const std::uint64_t summary_start = summary.here();
    const std::size_t summary_at = out.size();
    summary.group(Op::schema, [&](Bytes& bytes) { Members(bytes).put_raw(contents.schemas); });
    summary.group(Op::channel, [&](Bytes& bytes) { Members(bytes).put_raw(contents.channels); });
    summary.group(Op::statistics, [&](Bytes& bytes) { append_statistics(bytes, contents); });
    summary.group(Op::chunk_index, [&](Bytes& bytes) {
        for (const ChunkEntry& chunk : contents.chunks)
            append_chunk_index(bytes, chunk);
    });
    const std::uint64_t offsets_start = summary.here();
    summary.append_offsets();
    append_record(out, Op::footer, [&](Members& footer) {
        footer.put(summary_start);
        footer.put(offsets_start);
        footer.put(std::uint32_t{0});
    });
    // The checksum covers the summary and the part of the footer before the checksum.
    constexpr std::size_t kCrcBytes = sizeof(std::uint32_t);
    const std::size_t crc_at = out.size() - kCrcBytes;
    const std::uint32_t crc = crc32(std::span(out).subspan(summary_at, crc_at - summary_at));
    out.resize(crc_at);
    Members(out).put(crc);
    append_magic(out);
}

}  // namespace dotpose::mcap
