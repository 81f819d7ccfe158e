/// Where the readings of `dotpose watch` go.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fields.hpp"
#include "frame_locator.hpp"
#include "lines.hpp"
#include "path_memory.hpp"
#include "publish/mqtt.hpp"
#include "video/screen.hpp"

namespace dotpose::cli {

struct OutputOptions {
    RecordFormat format = RecordFormat::jsonl;
    std::string out;                           ///< file instead of standard output
    std::string log;                           ///< CSV of all frames; empty: none
    std::string map;                           ///< SVG of the path, written at the end; empty: none
    std::string packets;                       ///< file or device for pose packets; empty: none
    std::string robot = "robot";               ///< its name on the broker
    std::optional<publish::MqttOptions> mqtt;  ///< broker; none: nothing is published
    double mqtt_rate_hz = 0;                   ///< most messages a second; 0: one for each frame
    std::string world_map;                     ///< name of the world of the sheets
    video::ScreenOptions screen;
};

/// Counts of a run.
struct WatchTally {
    std::int64_t frames = 0;
    std::int64_t fixes = 0;
    std::int64_t lost = 0;
    std::int64_t kidnapped = 0;

    void count(const Reading& reading);
};

/// Pose packets to a file or serial device.
class PacketOutput {
  public:
    /// Throws Error if it cannot be opened; `write`, if it cannot be written (ReaderLeft).
    explicit PacketOutput(const std::string& path);
    ~PacketOutput();
    PacketOutput(const PacketOutput&) = delete;
    PacketOutput& operator=(const PacketOutput&) = delete;
    void write(const Reading& reading, Profile profile);

  private:
    std::string path_;
    int descriptor_;
};

/// The robot's state to a broker.
class StateOutput {
  public:
    /// Throws Error if the broker refuses the connection.
    explicit StateOutput(const OutputOptions& options);
    /// Says that the robot is lost, and waits a little until all is sent.
    ~StateOutput();
    StateOutput(const StateOutput&) = delete;
    StateOutput& operator=(const StateOutput&) = delete;

    void take(const Reading& reading);

  private:
    std::string robot_;
    std::string world_map_;
    std::int64_t period_us_;
    std::int64_t next_us_;
    std::uint64_t messages_ = 0;
    publish::MqttPublisher publisher_;
};

class WatchOutputs {
  public:
    /// Throws Error if something cannot be opened.
    WatchOutputs(const OutputOptions& options, const FrameLocator& locator);

    /// Throws Error. False if the user closed the window, or nobody reads any output any more.
    bool take(const video::Frame& frame, const Reading& reading, std::int64_t dropped);

    /// Writes what is written at the end. Throws Error.
    void finish();

    const WatchTally& tally() const { return tally_; }
    /// Frames per second of all frames so far, on the clock of the wall.
    double rate() const;

  private:
    bool show(const video::Frame& frame, const Reading& reading, std::int64_t dropped);
    void write_line(const std::string& line);
    void write_packet(const Reading& reading);
    bool is_anything_left() const;

    OutputOptions options_;
    const FrameLocator& locator_;
    std::vector<draw::MapSheet> sheets_;
    std::optional<Lines> lines_;
    std::optional<Lines> log_;
    std::optional<PacketOutput> packets_;
    std::optional<StateOutput> states_;
    video::Screen screen_;
    PathMemory path_;
    Track newest_;
    WatchTally tally_;
    std::chrono::steady_clock::time_point begun_;
};

}  // namespace dotpose::cli
