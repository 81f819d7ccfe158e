/// Outputs of `dotpose watch`.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lines.hpp"
#include "mqtt_arguments.hpp"
#include "output_arguments.hpp"
#include "path_memory.hpp"
#include "reading.hpp"
#include "robot_output.hpp"
#include "state_output.hpp"
#include "video/screen.hpp"
#include "watch_tally.hpp"
#include "web_view.hpp"

namespace dotpose::cli {

struct OutputOptions {
    LineArguments lines;
    // Outputs with an empty path are not written.
    std::string log;              ///< CSV file of all frames
    std::string map;              ///< SVG file of the path, written at the end
    std::string packets;          ///< file or device for pose packets
    RobotOutputOptions messages;  ///< ROS messages
    PublishArguments publish;     ///< the broker, and the name of the robot
    std::string sheets;           ///< path of the sheet file
    video::ScreenOptions screen;
    std::optional<WebOptions> web;  ///< none if there is no page
};

/// Writes pose packets to a file or serial device.
class PacketOutput {
  public:
    /// Opens the file or device. Throws Error on failure. `write` also throws Error on failure, but
    /// ReaderLeft if the output is a pipe that its reader has closed.
    explicit PacketOutput(const std::string& path);
    ~PacketOutput();
    PacketOutput(const PacketOutput&) = delete;
    PacketOutput& operator=(const PacketOutput&) = delete;
    void write(const Reading& reading, CodeVariant code);

  private:
    std::string path_;
    int descriptor_;
};

class WatchOutputs {
  public:
    /// Throws Error if an output cannot be opened.
    WatchOutputs(const OutputOptions& options, const Follower& follower);

    /// Writes the outputs of a frame. Returns false if the user closed the window, or if no output
    /// is left because all readers closed their pipes. Throws Error if an output cannot be written.
    bool take(const capture::Frame& frame, const Reading& reading, const SourceState& source);

    /// Returns the camera that was calibrated in the page since the previous call, or none.
    std::optional<Camera> take_camera();

    /// Writes the map, completes the recording and sends the last states. Throws Error on failure.
    void finish();

    /// Returns the sheets if the page or another program changed them since the previous call.
    /// Returns none otherwise, and always without a page.
    std::optional<std::vector<SheetEntry>> take_changed_sheets();
    /// Shows the new sheets of the follower. `was_in_world` is true if the poses of the earlier
    /// frames are in world coordinates. If the poses of later frames are not in the same plane, the
    /// path begins again.
    void use_sheets(bool was_in_world);

    const WatchTally& tally() const { return tally_; }
    /// Returns the mean number of frames per second of real time.
    double rate() const;

  private:
    bool show(const capture::Frame& frame, const Reading& reading, std::int64_t dropped);
    void write_line(const std::string& line);
    void write_packet(const Reading& reading);
    bool is_anything_left() const;
    void draw_path() const;

    OutputOptions options_;
    const Follower& follower_;
    std::vector<draw::MapSheet> sheets_;
    std::optional<Lines> lines_;
    std::optional<Lines> log_;
    std::optional<PacketOutput> packets_;
    std::unique_ptr<ReadingSink> states_;
    std::optional<RobotOutput> messages_;
    video::Screen screen_;
    PathMemory path_;
    std::optional<WebView> web_;
    Track newest_;
    WatchTally tally_;
    std::chrono::steady_clock::time_point begun_;
};

}  // namespace dotpose::cli
