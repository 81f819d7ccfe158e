// The end of an MCAP file: the summary of its contents, with offsets.
#pragma once

#include "mcap/chunk.hpp"

namespace dotpose::mcap {

/// Contents of the file, for the summary. Schemas and channels are stored as records.
struct Contents {
    Bytes schemas;
    Bytes channels;
    std::uint16_t schema_count = 0;
    std::map<std::uint16_t, std::uint64_t> messages;  ///< number of messages in each channel
    std::vector<ChunkEntry> chunks;
};

/// Appends the end of the data, the summary and the footer to `out`. `place` is the offset of the
/// appended bytes in the file. `data` is the checksum of all previous bytes.
void append_end(Bytes& out, std::uint64_t place, const Contents& contents, const Crc32& data);

/// Appends the eight bytes with which a file begins and ends.
void append_magic(Bytes& out);

}  // namespace dotpose::mcap
