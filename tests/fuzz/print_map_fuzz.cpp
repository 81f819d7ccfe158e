// Fuzzes `parse_print_map`, which must either return a valid map or throw Error. The fuzz target
// appends the correct checksum to each input, because almost all inputs with random checksums would
// be rejected.
#include <cstdlib>
#include <string>

#include "dotpose/files/print_map.hpp"
#include "reads_or_refuses.hpp"

namespace {

/// Computes the CRC-32 of IEEE 802.3 bit by bit.
std::uint32_t crc32_of(const std::string& bytes) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char byte : bytes) {
        crc ^= static_cast<std::uint8_t>(byte);
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320 : 0);
    }
    return ~crc;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace dotpose;
    std::string bytes(data, data + size);
    const std::uint32_t crc = crc32_of(bytes);
    for (int i = 0; i < 4; ++i)
        bytes += static_cast<char>(crc >> (8 * i) & 0xFF);
    try {
        const PrintMap map = parse_print_map(bytes);
        // `print_map_bytes` always writes version 2, so only maps of version 2 must be reproduced
        // exactly.
        const std::string written = print_map_bytes(map);
        const bool is_newest = bytes[8] != 1;
        if (is_newest ? written != bytes : print_map_bytes(parse_print_map(written)) != written)
            std::abort();
    } catch (const Error& error) {
        if (std::string(error.what()).empty()) std::abort();
    }
    return 0;
}
