/// MCAP files: recordings of timestamped messages of any type, for Foxglove, Lichtblick,
/// PlotJuggler and `ros2 bag`. Format: https://mcap.dev/spec.
///
///     McapFile file("run.mcap");
///     const McapChannel poses = file.add_channel("/anna/pose", ros::type_of(pose));
///     file.write(poses, time_ns, ros::to_cdr(pose));
///     file.finish();
///
/// Messages are collected in chunks. Each chunk is written together with the index and the end
/// record of the file, which the next chunk overwrites. The file is therefore complete at any time.
/// If the program is killed, only the messages of the chunk in progress are lost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "dotpose/export.hpp"
#include "dotpose/tools/ros_messages.hpp"

DOTPOSE_BEGIN_EXPORT

namespace dotpose {

/// Number that identifies a channel within its file.
enum class McapChannel : std::uint16_t {};

/// Quality of service with which `ros2 bag play` publishes the messages of a channel. The default
/// suits all topics except /tf_static, which needs a `depth` of 1 and `is_transient_local` to keep
/// the latest message for later subscribers.
struct McapQuality {
    int depth = 100;
    bool is_transient_local = false;
};

/// Limits on the size and duration of the chunks in a file.
struct McapOptions {
    /// A chunk is written when its size reaches `chunk_bytes`. It is also written when its messages
    /// span `chunk_ns`, provided that the chunk is at least as large as the index at the end of the
    /// file. With longer chunks, more messages are lost if the program is killed. Shorter chunks
    /// make the index larger.
    std::int64_t chunk_ns = 1'000'000'000;
    std::size_t chunk_bytes = 4 << 20;
};

class McapFile {
  public:
    /// Creates or replaces the file. Throws Error if the file cannot be created.
    explicit McapFile(const std::filesystem::path& path, const McapOptions& options = {});
    /// Writes the remaining messages and ignores errors. Call `finish` to detect errors.
    ~McapFile();
    McapFile(const McapFile&) = delete;
    McapFile& operator=(const McapFile&) = delete;

    /// Adds a channel for CDR messages of one type.
    McapChannel add_channel(const std::string& topic, const ros::MessageType& type,
                            const McapQuality& quality = {});

    /// Appends a message. A negative `time_ns` is written as 0. Throws Error if writing fails.
    void write(McapChannel channel, std::int64_t time_ns, std::span<const std::uint8_t> cdr);

    /// Writes the remaining messages and closes the file. Throws Error if writing fails.
    void finish();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_;
};

}  // namespace dotpose

DOTPOSE_END_EXPORT
