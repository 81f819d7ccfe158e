/// MCAP files: recordings of timed messages of any types, which Foxglove, Lichtblick, PlotJuggler
/// and `ros2 bag` read. https://mcap.dev/spec describes the format.
///
///     McapFile file("run.mcap");
///     const McapChannel poses = file.add_channel("/anna/pose", ros::type_of(pose));
///     file.write(poses, time_ns, ros::to_cdr(pose));
///     file.finish();
///
/// Messages are gathered in chunks. With every chunk, index and end of the file are written as
/// well, and the next chunk replaces them: also the file of a program that was killed is complete,
/// except for the messages of the chunk that it was gathering.
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

/// The quality of service that `ros2 bag play` offers the messages of a channel with. The default
/// suits every subscriber but those of /tf_static, which need the newest message of `depth` 1 kept
/// for subscribers that come later.
struct McapQuality {
    int depth = 100;
    bool is_transient_local = false;
};

/// When a chunk ends.
struct McapOptions {
    /// A chunk ends with the message that makes it longer or larger than this. Longer ones lose
    /// more of a run that is cut off; shorter ones make the index larger.
    std::int64_t chunk_ns = 1'000'000'000;
    std::size_t chunk_bytes = 4 << 20;
};

class McapFile {
  public:
    /// Creates the file or replaces an old one. Throws Error.
    explicit McapFile(const std::filesystem::path& path, const McapOptions& options = {});
    /// Writes what is left; call `finish` to learn whether that worked.
    ~McapFile();
    McapFile(const McapFile&) = delete;
    McapFile& operator=(const McapFile&) = delete;

    /// Adds a channel for messages of one type, in CDR.
    McapChannel add_channel(const std::string& topic, const ros::MessageType& type,
                            const McapQuality& quality = {});

    /// Appends a message. `time_ns` should not be below 0. Throws Error.
    void write(McapChannel channel, std::int64_t time_ns, std::span<const std::uint8_t> cdr);

    /// Writes all that is left and closes the file. Throws Error.
    void finish();

  private:
    class Writer;
    std::unique_ptr<Writer> writer_;
};

}  // namespace dotpose

#pragma GCC visibility pop
