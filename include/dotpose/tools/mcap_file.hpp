/// MCAP files: recordings of timed messages of any types, for Foxglove, Lichtblick, PlotJuggler and
/// `ros2 bag`. Format: https://mcap.dev/spec.
///
///     McapFile file("run.mcap");
///     const McapChannel poses = file.add_channel("/anna/pose", ros::type_of(pose));
///     file.write(poses, time_ns, ros::to_cdr(pose));
///     file.finish();
///
/// Messages are collected in chunks. Each chunk is written with the index and the end of the file,
/// which the next chunk overwrites. The file of a killed program is therefore complete except for
/// the messages of the last chunk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "dotpose/tools/ros_messages.hpp"

#pragma GCC visibility push(default)

namespace dotpose {

/// The number of a channel in its file.
enum class McapChannel : std::uint16_t {};

/// The quality of service with which `ros2 bag play` offers the messages of a channel. The default
/// suits all topics except /tf_static, which needs `depth` 1 and the newest message kept for later
/// subscribers.
struct McapQuality {
    int depth = 100;
    bool is_transient_local = false;
};

/// Limits of a chunk.
struct McapOptions {
    /// A chunk ends with the message that exceeds these limits. Longer chunks lose more of a killed
    /// run; shorter chunks make the index larger.
    std::int64_t chunk_ns = 1'000'000'000;
    std::size_t chunk_bytes = 4 << 20;
};

class McapFile {
  public:
    /// Creates or replaces the file. Throws Error.
    explicit McapFile(const std::filesystem::path& path, const McapOptions& options = {});
    /// Writes the rest and ignores errors; call `finish` to check for errors.
    ~McapFile();
    McapFile(const McapFile&) = delete;
    McapFile& operator=(const McapFile&) = delete;

    /// Adds a channel for messages of one type, in CDR.
    McapChannel add_channel(const std::string& topic, const ros::MessageType& type,
                            const McapQuality& quality = {});

    /// Appends a message. `time_ns` should not be below 0. Throws Error.
    void write(McapChannel channel, std::int64_t time_ns, std::span<const std::uint8_t> cdr);

    /// Writes the rest and closes the file. Throws Error.
    void finish();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_;
};

}  // namespace dotpose

#pragma GCC visibility pop
