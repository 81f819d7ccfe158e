// The end of an MCAP file: its contents and their offsets.
#pragma once

#include "mcap/chunk.hpp"

namespace dotpose::mcap {

/// Schemas and channels, as records for chunks and summary.
struct Contents {
    Bytes schemas;
    Bytes channels;
    std::uint16_t schema_count = 0;
    std::map<std::uint16_t, std::uint64_t> messages;  ///< number of messages by channel
    std::vector<ChunkEntry> chunks;
};

/// Appends the end of the data, summary and footer to `out`, which will be at the offset `place` in
/// the file. `data` is the checksum of all bytes before.
void append_end(Bytes& out, std::uint64_t place, const Contents& contents, const Crc32& data);

/// Appends the eight bytes that begin and end a file.
void append_magic(Bytes& out);

}  // namespace dotpose::mcap
