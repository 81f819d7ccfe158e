// The end of an MCAP file: a summary of the file with the offsets of its parts.
#pragma once

#include "mcap/chunk.hpp"

namespace dotpose::mcap {

/// Contents of the file that are listed in the summary. Schemas and channels are stored as encoded
/// records.
struct Contents {
    Bytes schemas;
    Bytes channels;
    std::uint16_t schema_count = 0;
    std::map<std::uint16_t, std::uint64_t> messages;  ///< number of messages in each channel
    std::vector<ChunkEntry> chunks;
};

/// Appends the data end record, the summary, the footer and the magic bytes to `out`. `place` is
/// the file offset of the first appended byte. `data` is the checksum of all bytes of the file
/// before `place`.
void append_end(Bytes& out, std::uint64_t place, const Contents& contents, const Crc32& data);

/// Appends the eight magic bytes that begin and end every file.
void append_magic(Bytes& out);

}  // namespace dotpose::mcap
